//! What is asked of every cell of a plane, and what comes out of one.

use std::collections::BTreeMap;
use std::fmt::Debug;

use serde::Serialize;

use super::axis::Axis;
use super::error::PlaneError;
use crate::analysis::{Counts, Measures, Regime, Schedule, Verdict};
use crate::control::{ControlQuantity, ControlSchedule, NEVER, Outcome, Scheme, SectionValues};
use crate::model::StateVector;

/// What is asked of every cell of a plane: to be followed by a [`Schedule`], or under [`Control`].
pub trait Task: Clone + Debug + PartialEq + Send + Sync {
    /// What comes out of a cell.
    type Cell: Reached;

    /// The largest number of cells in one plane.
    const LARGEST: u64;

    /// Checks what is asked, with what the axes vary of it.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    fn check(&self, axes: [&Axis; 2]) -> Result<(), PlaneError>;

    /// What files say of it, beside the axes, the parameters and the start.
    fn written(&self) -> impl Serialize;
}

/// What became of a cell, whatever was asked of it.
pub trait Reached: Clone + Debug + PartialEq + Send + Sync {
    /// The motion that it settled on.
    fn verdict(&self) -> &Verdict;

    /// Where that motion is met: its state at forcing phase 0, or under control its point on σ.
    fn place(&self) -> &[f64];

    /// What stands for a cell of so many coordinates that nothing could be done with: zeros, and no motion.
    fn unresolved(coordinates: usize) -> Self;

    /// What stands for a cell that would begin beyond a stop: no motion, and nothing measured.
    fn inadmissible(start: StateVector) -> Self;
}

impl Reached for Verdict {
    fn verdict(&self) -> &Verdict {
        self
    }

    fn place(&self) -> &[f64] {
        &self.state
    }

    fn unresolved(coordinates: usize) -> Self {
        Verdict {
            regime: Regime::Unresolved,
            n: 0,
            counts: Counts::default(),
            symmetric: false,
            lyapunov: f32::NAN,
            state: StateVector::zeros(coordinates),
            impacts: 0,
            impacts_total: 0,
            peak_impact_velocity: 0.0,
            periods: 0,
            returning: 0,
            measures: Measures::default(),
        }
    }

    fn inadmissible(start: StateVector) -> Self {
        Verdict {
            regime: Regime::Inadmissible,
            state: start,
            peak_impact_velocity: f32::NAN,
            measures: Measures { observed: 0, power: f32::NAN, contact: f32::NAN },
            ..Verdict::unresolved(start.coordinates())
        }
    }
}

impl Reached for Outcome {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    fn place(&self) -> &[f64] {
        &self.section
    }

    fn unresolved(coordinates: usize) -> Self {
        Outcome {
            verdict: Verdict::unresolved(coordinates),
            section: SectionValues::from_slice(&vec![0.0; 2 * coordinates])
                .expect("a system has 1 to 4 coordinates"),
            period: 0,
            iterates: 0,
            converged_at: NEVER,
            signal: 0.0,
            runaway: false,
            escapes: 0,
            effort: 0.0,
        }
    }

    fn inadmissible(start: StateVector) -> Self {
        Outcome {
            verdict: Verdict::inadmissible(start),
            signal: f32::NAN,
            effort: f32::NAN,
            ..Outcome::unresolved(start.coordinates())
        }
    }
}

/// The most cells whose results are held at once; more go into a store.
pub(super) const LARGEST_AT_ONCE: u64 = 1 << 26;

impl Task for Schedule {
    type Cell = Verdict;

    const LARGEST: u64 = 1 << 31;

    fn check(&self, axes: [&Axis; 2]) -> Result<(), PlaneError> {
        if let Some(setting) = axes.into_iter().find_map(Axis::control) {
            return Err(PlaneError::NoControl(setting.name));
        }
        Ok(self.check()?)
    }

    fn written(&self) -> impl Serialize {
        BTreeMap::from([("schedule", self)])
    }
}

/// Every cell is controlled by a method.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Control {
    /// The method; axes over its settings override those.
    #[serde(rename = "control")]
    pub scheme: Scheme,
    /// When, and for how long, in iterates on σ.
    #[serde(rename = "iterates")]
    pub schedule: ControlSchedule,
}

impl Control {
    /// The scheme with one setting changed.
    fn varied(&self, setting: ControlQuantity, value: f64) -> Result<Scheme, PlaneError> {
        let (name, method) = (setting.name, self.scheme.method().name);
        self.scheme.with(setting, value).ok_or(PlaneError::NoSuchSetting { name, method })
    }
}

impl Task for Control {
    type Cell = Outcome;

    const LARGEST: u64 = LARGEST_AT_ONCE;

    fn check(&self, axes: [&Axis; 2]) -> Result<(), PlaneError> {
        self.schedule.check()?;
        self.scheme.check()?;
        for axis in axes {
            let Some(setting) = axis.control() else { continue };
            for value in [axis.first, axis.last] {
                self.varied(setting, value)?.check()?;
            }
        }
        Ok(())
    }

    fn written(&self) -> impl Serialize {
        self
    }
}
