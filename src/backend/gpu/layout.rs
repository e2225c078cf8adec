//! What lies in the GPU's buffers, byte for byte as the shaders declare it.

use bytemuck::{Pod, Zeroable};

use crate::analysis::{self, Regime};
use crate::control::{self, Controller};
use crate::model::{self, Real};

/// Terms of the kick polynomial in f32: up to the order of a flight.
pub const KICK_TERMS: usize = <f32 as Real>::ORDER + 1;

/// `Flight` in shaders/model/flight.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Flight {
    pub phi: [[f32; 4]; 4],
    pub gamma_sin: [f32; 4],
    pub gamma_cos: [f32; 4],
    pub bound: [f32; 4],
    pub forced: [f32; 4],
    pub h: f32,
    pub inverse_h: f32,
    pub turn_sin: f32,
    pub turn_cos: f32,
    pub omega: f32,
    pub delta: f32,
    pub r: f32,
    pub coupling_damping: f32,
    pub inverse_mass: f32,
    pub ground_stiffness: f32,
    pub ground_damping: f32,
    pub force1: f32,
    pub force2: f32,
    pub bound_forcing: f32,
    pub rate: f32,
    pub reach: f32,
    pub mass: f32,
    pub ground: f32,
    pub compliance: f32,
    pub linear_exponent: f32,
    pub steps: u32,
    pub unused: [u32; 3],
}

impl Flight {
    /// The constants of a cell, rounded to f32.
    pub fn new(flight: &model::Flight<f32>) -> Self {
        Flight {
            phi: flight.phi,
            gamma_sin: flight.gamma_sin,
            gamma_cos: flight.gamma_cos,
            bound: flight.bound,
            forced: flight.forced,
            h: flight.h,
            inverse_h: flight.inverse_h,
            turn_sin: flight.turn_sin,
            turn_cos: flight.turn_cos,
            omega: flight.omega,
            delta: flight.delta,
            r: flight.r,
            coupling_damping: flight.coupling_damping,
            inverse_mass: flight.inverse_mass,
            ground_stiffness: flight.ground_stiffness,
            ground_damping: flight.ground_damping,
            force1: flight.force1,
            force2: flight.force2,
            bound_forcing: flight.bound_forcing,
            rate: flight.rate,
            reach: flight.reach,
            mass: flight.mass,
            ground: flight.ground,
            compliance: flight.compliance,
            linear_exponent: flight.linear_exponent,
            steps: flight.steps,
            unused: [0; 3],
        }
    }
}

/// `Kick` in shaders/model/flight.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Kick {
    pub terms: [[f32; 4]; KICK_TERMS],
}

impl Kick {
    /// The kick polynomial of a cell.
    pub fn new(flight: &model::Flight<f32>) -> Self {
        Kick { terms: std::array::from_fn(|k| flight.kick[k]) }
    }
}

/// `Schedule` in shaders/analysis/observer.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Schedule {
    pub transient: u32,
    pub observe: u32,
    pub max_period: u32,
    pub fixed_periods: u32,
}

impl Schedule {
    /// A schedule as the shader reads it.
    pub fn new(schedule: &analysis::Schedule) -> Self {
        Schedule {
            transient: schedule.transient,
            observe: schedule.observe,
            max_period: schedule.max_period,
            fixed_periods: u32::from(schedule.fixed_periods),
        }
    }
}

/// `Dispatch` in shaders/kernels/follow.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Dispatch {
    pub schedule: Schedule,
    pub count: u32,
    pub budget: u32,
    pub begin: u32,
    pub row: u32,
}

/// `TraceDispatch` in shaders/kernels/trace.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TraceDispatch {
    pub schedule: Schedule,
    pub count: u32,
    pub budget: u32,
    pub begin: u32,
    pub row: u32,
    pub section: u32,
    pub reading: u32,
    pub capacity: u32,
    pub unused: u32,
}

/// `Rebounds` in shaders/analysis/section.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Rebounds {
    pub last: f32,
    pub run: u32,
    pub longest: u32,
}

/// `Trace` in shaders/analysis/trace.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Trace {
    pub rebounds: Rebounds,
    pub passages: u32,
}

/// `Verdict` in shaders/analysis/observer.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Verdict {
    pub regime: u32,
    pub n: u32,
    pub p: u32,
    pub q: u32,
    pub symmetric: u32,
    pub lyapunov: f32,
    pub state: [f32; 4],
    pub impacts: u32,
    pub impacts_total: u32,
    pub peak_impact_velocity: f32,
    pub periods: u32,
}

impl Verdict {
    /// What the buffer holds until the shader has written a verdict: no regime has this code.
    pub const PENDING: Verdict = Verdict {
        regime: u32::MAX,
        n: 0,
        p: 0,
        q: 0,
        symmetric: 0,
        lyapunov: 0.0,
        state: [0.0; 4],
        impacts: 0,
        impacts_total: 0,
        peak_impact_velocity: 0.0,
        periods: 0,
    };

    /// Whether the shader has not written it yet.
    pub fn is_pending(&self) -> bool {
        self.regime == Self::PENDING.regime
    }

    /// The verdict with its values widened; a code that no regime has counts as failed.
    pub fn widen(&self) -> analysis::Verdict {
        let regime = u8::try_from(self.regime).ok().and_then(Regime::from_code).unwrap_or(Regime::Failed);
        analysis::Verdict {
            regime,
            n: self.n as u16,
            p: self.p as u16,
            q: self.q as u16,
            symmetric: self.symmetric != 0,
            lyapunov: self.lyapunov,
            state: self.state.map(f64::from),
            impacts: self.impacts,
            impacts_total: self.impacts_total,
            peak_impact_velocity: self.peak_impact_velocity,
            periods: self.periods,
        }
    }
}

/// What a kernel writes for a trajectory when it is done.
pub trait Record: Pod {
    /// What the buffer holds until then.
    const PENDING: Self;

    /// Whether the shader has not written it yet.
    fn is_pending(&self) -> bool;
}

impl Record for Verdict {
    const PENDING: Self = Verdict::PENDING;

    fn is_pending(&self) -> bool {
        Verdict::is_pending(self)
    }
}

/// `ControlSchedule` in shaders/control/controlled.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ControlSchedule {
    pub start: u32,
    pub iterates: u32,
    pub observed: u32,
    pub fixed_iterates: u32,
}

impl ControlSchedule {
    /// A schedule as the shader reads it.
    pub fn new(schedule: &control::ControlSchedule) -> Self {
        ControlSchedule {
            start: schedule.from,
            iterates: schedule.iterates,
            observed: schedule.observed(),
            fixed_iterates: u32::from(schedule.fixed),
        }
    }
}

/// `ControlDispatch` in shaders/kernels/control.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ControlDispatch {
    pub schedule: ControlSchedule,
    pub count: u32,
    pub budget: u32,
    pub begin: u32,
    pub row: u32,
}

/// Codes of the methods.
pub const METHOD_NONE: u32 = 0;
pub const METHOD_SINE: u32 = 1;
pub const METHOD_PULSE: u32 = 2;
pub const METHOD_DELAY: u32 = 3;

/// `Control` in shaders/control/method.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Control {
    pub method: u32,
    pub convention: u32,
    pub component: u32,
    pub delay: u32,
    pub period: u32,
    pub seed: u32,
    pub amplitude: f32,
    pub weight: f32,
    pub dead_band: f32,
    pub ratio: f32,
    pub phase: f32,
    pub wanted: f32,
    pub noise: f32,
    pub drive_bound: f32,
    pub point: [f32; 4],
    pub gains: [f32; 4],
    pub drive_sin: [f32; 4],
    pub drive_cos: [f32; 4],
}

impl Control {
    /// A controller as the shader reads it, on a cell with these constants.
    pub fn new(controller: &Controller<f64>, system: &model::System, flight: &model::Flight<f64>) -> Self {
        let mut control = Control { period: 1, ..Control::zeroed() };
        match Controller::<f32>::rounded(controller) {
            Controller::None => control.method = METHOD_NONE,
            Controller::Sine(sine) => {
                control.method = METHOD_SINE;
                control.convention = sine.convention as u32;
                control.component = sine.component as u32;
                control.amplitude = sine.amplitude;
                control.weight = sine.weight;
                control.dead_band = sine.dead_band;
                control.ratio = sine.ratio;
                control.phase = sine.phase;
                control.wanted = sine.target;
                let drive = model::Drive::new(system, flight, 1.0).round::<f32>();
                control.drive_sin = drive.gamma_sin;
                control.drive_cos = drive.gamma_cos;
                control.drive_bound = drive.bound;
            }
            Controller::Pulse(pulse) => {
                control.method = METHOD_PULSE;
                control.period = pulse.period;
                control.seed = pulse.seed;
                control.noise = pulse.noise;
                control.point = pulse.target.components;
            }
            Controller::Delay(delay) => {
                control.method = METHOD_DELAY;
                control.delay = delay.delay;
                control.gains = delay.gains;
            }
        }
        control
    }
}

/// `Outcome` in shaders/control/controlled.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Outcome {
    pub verdict: Verdict,
    pub period: u32,
    pub iterates: u32,
    pub converged_at: u32,
    pub signal: f32,
    pub runaway: u32,
    pub escapes: u32,
    pub effort: f32,
}

impl Record for Outcome {
    const PENDING: Self = Outcome {
        verdict: Verdict::PENDING,
        period: 0,
        iterates: 0,
        converged_at: 0,
        signal: 0.0,
        runaway: 0,
        escapes: 0,
        effort: 0.0,
    };

    fn is_pending(&self) -> bool {
        self.verdict.is_pending()
    }
}

impl Outcome {
    /// The outcome with its values widened.
    pub fn widen(&self) -> control::Outcome {
        control::Outcome {
            verdict: self.verdict.widen(),
            period: self.period,
            iterates: self.iterates,
            converged_at: self.converged_at,
            signal: self.signal,
            runaway: self.runaway != 0,
            escapes: self.escapes,
            effort: self.effort,
        }
    }
}

/// Bytes of `Controlled` in shaders/control/controlled.wgsl, which only the shader reads and writes.
pub const CONTROLLED_BYTES: u64 = 4 * (16 + 4 + 3 + 80 + 36 + 7 + 8 + 21);

/// Bytes of `Observer` in shaders/analysis/observer.wgsl, which only the shader reads and writes.
pub const OBSERVER_BYTES: u64 = 4 * (16 + 4 + 12 + 7 + 8 + 9);

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use super::super::shader;
    use super::*;

    /// The members of a shader's struct, with their offsets, and its size in an array.
    fn declared(name: &str) -> (Vec<(String, u32)>, u32) {
        let declares = |source: String| {
            let module = naga::front::wgsl::parse_str(&source).unwrap();
            let there = module.types.iter().any(|(_, ty)| ty.name.as_deref() == Some(name));
            there.then_some(module)
        };
        let sources = [shader::follow_source(), shader::trace_source(), shader::control_source()];
        let module = sources.into_iter().find_map(declares).unwrap();
        let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
        let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
        (members.iter().map(|m| (m.name.clone().unwrap(), m.offset)).collect(), *span)
    }

    macro_rules! assert_layout {
        ($name:ident { $($field:ident),+ $(,)? }) => {
            let (members, span) = declared(stringify!($name));
            let here: Vec<(String, u32)> =
                vec![$((stringify!($field).to_owned(), offset_of!($name, $field) as u32)),+];
            assert_eq!(members, here);
            assert_eq!(span as usize, size_of::<$name>());
        };
    }

    #[test]
    fn structs_lie_as_the_shaders_declare_them() {
        assert_layout!(Flight {
            phi,
            gamma_sin,
            gamma_cos,
            bound,
            forced,
            h,
            inverse_h,
            turn_sin,
            turn_cos,
            omega,
            delta,
            r,
            coupling_damping,
            inverse_mass,
            ground_stiffness,
            ground_damping,
            force1,
            force2,
            bound_forcing,
            rate,
            reach,
            mass,
            ground,
            compliance,
            linear_exponent,
            steps,
            unused,
        });
        assert_layout!(Kick { terms });
        assert_layout!(Schedule { transient, observe, max_period, fixed_periods });
        assert_layout!(Dispatch { schedule, count, budget, begin, row });
        assert_layout!(Verdict {
            regime,
            n,
            p,
            q,
            symmetric,
            lyapunov,
            state,
            impacts,
            impacts_total,
            peak_impact_velocity,
            periods,
        });
        assert_layout!(TraceDispatch {
            schedule,
            count,
            budget,
            begin,
            row,
            section,
            reading,
            capacity,
            unused
        });
        assert_layout!(Rebounds { last, run, longest });
        assert_layout!(Trace { rebounds, passages });
        assert_layout!(ControlSchedule { start, iterates, observed, fixed_iterates });
        assert_layout!(ControlDispatch { schedule, count, budget, begin, row });
        assert_layout!(Control {
            method,
            convention,
            component,
            delay,
            period,
            seed,
            amplitude,
            weight,
            dead_band,
            ratio,
            phase,
            wanted,
            noise,
            drive_bound,
            point,
            gains,
            drive_sin,
            drive_cos,
        });
        assert_layout!(Outcome { verdict, period, iterates, converged_at, signal, runaway, escapes, effort });
        assert_eq!(u64::from(declared("Observer").1), OBSERVER_BYTES);
        assert_eq!(u64::from(declared("Controlled").1), CONTROLLED_BYTES);
    }
}
