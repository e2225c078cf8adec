//! What the kernel `follow` reads and writes.

use crate::analysis::{self, Counts, Measures, Regime};
use crate::control::MOST_COMPONENTS;
use crate::model::vector::MOST;
use crate::model::{StateVector, System};

shared_struct! {
    /// How long a trajectory is followed; lengths in forcing periods.
    pub struct Schedule {
        pub transient: u32,
        pub observe: u32,
        pub max_period: u32,
        pub fixed_periods: u32,
    }
}

impl Schedule {
    /// A schedule as the shader reads it.
    ///
    /// # Panics
    /// If it observes nothing: such an observation never ends.
    pub fn new(schedule: &analysis::Schedule) -> Self {
        assert!(schedule.observe > 0, "an observation takes at least one forcing period");
        Schedule {
            transient: schedule.transient,
            observe: schedule.observe,
            max_period: schedule.max_period,
            fixed_periods: u32::from(schedule.fixed_periods),
        }
    }
}

shared_struct! {
    /// What the kernel `follow` is told.
    pub struct Dispatch {
        pub schedule: Schedule,
        /// Trajectories in this dispatch.
        pub count: u32,
        /// Moves that each of them may make.
        pub budget: u32,
        /// 1 in the first dispatch of a tile, which begins the trajectories; 0 in those that resume them.
        pub begin: u32,
        /// Invocations in one row of workgroups.
        pub row: u32,
    }
}

/// What the shaders write for an exponent that was not measured: a NaN need not survive a driver.
pub const NOT_MEASURED: f32 = -3e38;

shared_struct! {
    /// What a trajectory settled on.
    pub struct Verdict {
        pub regime: u32,
        pub n: u32,
        pub symmetric: u32,
        pub lyapunov: f32,
        pub impacts_per_stop: [u32; MOST],
        pub state: [f32; MOST_COMPONENTS],
        pub impacts: u32,
        pub impacts_total: u32,
        pub peak_impact_velocity: f32,
        pub periods: u32,
        pub returning: u32,
        pub observed: u32,
        pub power: f32,
        pub contact: f32,
    }
}

/// A number that a shader wrote; NaN for one that was not measured.
fn measured(value: f32) -> f32 {
    if value == NOT_MEASURED { f32::NAN } else { analysis::reported(value) }
}

impl Verdict {
    /// The state x1 … xn, v1 … vn.
    fn state_of(&self, system: &System) -> StateVector {
        let mut state = StateVector::zeros(system.coordinates());
        for (value, &from) in state.iter_mut().zip(&self.state) {
            *value = f64::from(from);
        }
        state
    }

    /// The verdict on a trajectory of a system with its values widened; a code that no regime has counts as failed.
    pub fn widen(&self, system: &System) -> analysis::Verdict {
        let regime = u8::try_from(self.regime).ok().and_then(Regime::from_repr).unwrap_or(Regime::Failed);
        analysis::Verdict {
            regime,
            n: self.n as u16,
            counts: Counts::in_order(&self.impacts_per_stop.map(|count| count as u16), system.label_order()),
            symmetric: self.symmetric != 0,
            lyapunov: measured(self.lyapunov),
            state: self.state_of(system),
            impacts: self.impacts,
            impacts_total: self.impacts_total,
            peak_impact_velocity: self.peak_impact_velocity,
            periods: self.periods,
            returning: self.returning as u16,
            measures: Measures {
                observed: self.observed,
                power: measured(self.power),
                contact: measured(self.contact),
            },
        }
    }
}
