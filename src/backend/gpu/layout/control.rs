//! What the kernel `control_trajectories` reads and writes.

use bytemuck::{Pod, Zeroable};

use super::follow::Verdict;
use super::record::Record;
use crate::control::{self, Controller};
use crate::model;

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
    pub max_period: u32,
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
    pub push: [f32; 2],
    pub drive_sin: [f32; 4],
    pub drive_cos: [f32; 4],
}

impl Control {
    /// A controller as the shader reads it, on a cell with these constants.
    pub fn new(controller: &Controller<f64>, system: &model::System, flight: &model::Flight<f64, 2>) -> Self {
        let mut control = Control { period: 1, ..Control::zeroed() };
        match Controller::<f32>::rounded(controller) {
            Controller::None(_) => control.method = METHOD_NONE,
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
                let drive = model::Drive::on(sine.coordinate, system, flight, 1.0).round::<f32>();
                control.push = drive.push;
                control.drive_sin = std::array::from_fn(|i| drive.gamma_sin.get(i));
                control.drive_cos = std::array::from_fn(|i| drive.gamma_cos.get(i));
                control.drive_bound = drive.bound[0];
            }
            Controller::Pulse(pulse) => {
                control.method = METHOD_PULSE;
                control.period = pulse.period;
                control.seed = pulse.seed;
                control.noise = pulse.noise;
                control.point = std::array::from_fn(|i| pulse.target[i]);
            }
            Controller::Delay(delay) => {
                control.method = METHOD_DELAY;
                control.delay = delay.delay;
                control.gains = std::array::from_fn(|i| delay.gains[i]);
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
    pub fn widen(&self, system: &model::System) -> control::Outcome {
        control::Outcome {
            verdict: self.verdict.widen(system),
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
