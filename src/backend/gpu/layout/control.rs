//! What the kernel `control_trajectories` reads and writes.

use super::follow::Verdict;
use super::record::Record;
use crate::control::{self, Controller, Sine, Surface};
use crate::model::vector::MOST;
use crate::model::{self, System};

shared_struct! {
    /// When control is switched on, and how long a trajectory is followed; lengths in iterates.
    pub struct ControlSchedule {
        pub start: u32,
        pub iterates: u32,
        pub observed: u32,
        pub fixed_iterates: u32,
    }
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

shared_struct! {
    /// What the kernel `control_trajectories` is told.
    pub struct ControlDispatch {
        pub schedule: ControlSchedule,
        /// Trajectories in this dispatch.
        pub count: u32,
        /// Moves that each of them may make.
        pub budget: u32,
        /// 1 in the first dispatch of a tile, which begins the trajectories; 0 in those that resume them.
        pub begin: u32,
        /// Invocations in one row of workgroups.
        pub row: u32,
        /// The largest number of iterates in one period that is looked for.
        pub max_period: u32,
    }
}

/// Codes of the methods.
pub const METHOD_NONE: u32 = 0;
pub const METHOD_SINE: u32 = 1;
pub const METHOD_PULSE: u32 = 2;
pub const METHOD_DELAY: u32 = 3;

/// `Control` in shaders/control/method.wgsl: a controller as the shader reads it, on a cell.
pub struct Control {
    method: u32,
    convention: u32,
    component: u32,
    delay: u32,
    period: u32,
    seed: u32,
    /// B, α, Δ, γ, φ, the target and E.
    numbers: [f32; 7],
    point: Vec<f32>,
    gains: Vec<f32>,
    push: Vec<f32>,
    drive: [Vec<f32>; 2],
    bound: Vec<f32>,
}

impl Control {
    /// The words of a controller on a system.
    pub fn words(controller: &Controller<f64>, system: &System) -> Vec<u32> {
        match system.plant().n {
            1 => Control::words_of::<1>(controller, system),
            2 => Control::words_of::<2>(controller, system),
            3 => Control::words_of::<3>(controller, system),
            _ => Control::words_of::<4>(controller, system),
        }
    }

    fn words_of<const N: usize>(controller: &Controller<f64>, system: &System) -> Vec<u32> {
        let flight = model::Flight::<f64, N>::new(system);
        let surface = Surface::new(system, &flight, controller.stop());
        Control::new(controller, system, &flight).written(&surface)
    }

    fn new<const N: usize>(
        controller: &Controller<f64>,
        system: &System,
        flight: &model::Flight<f64, N>,
    ) -> Self {
        let none = || vec![0.0; 2 * N];
        let mut control = Control {
            method: METHOD_NONE,
            convention: 0,
            component: 0,
            delay: 0,
            period: 1,
            seed: 0,
            numbers: [0.0; 7],
            point: none(),
            gains: none(),
            push: vec![0.0; N],
            drive: [none(), none()],
            bound: vec![0.0; flight.count],
        };
        match Controller::<f32>::rounded(controller) {
            Controller::None(_) => {}
            Controller::Sine(sine) => {
                control.method = METHOD_SINE;
                control.convention = sine.convention as u32;
                control.component = sine.component as u32;
                let Sine { amplitude, weight, dead_band, ratio, phase, target, .. } = sine;
                control.numbers = [amplitude, weight, dead_band, ratio, phase, target, 0.0];
                let drive = model::Drive::on(sine.coordinate, system, flight, 1.0).round::<f32>();
                control.push = drive.push.to_vec();
                control.drive = [&drive.gamma_sin, &drive.gamma_cos].map(|gamma| gamma.values().collect());
                control.bound = drive.bound[..flight.count].to_vec();
            }
            Controller::Pulse(pulse) => {
                control.method = METHOD_PULSE;
                control.period = pulse.period;
                control.seed = pulse.seed;
                control.numbers[6] = pulse.noise;
                control.point = pulse.target.to_vec();
            }
            Controller::Delay(delay) => {
                control.method = METHOD_DELAY;
                control.delay = delay.delay;
                control.gains = delay.gains.to_vec();
            }
        }
        control
    }

    /// The members in the order of the shader's declaration, on the section of a surface.
    fn written(&self, surface: &Surface) -> Vec<u32> {
        let Control { method, convention, component, delay, period, seed, .. } = *self;
        let end = [surface.stop.index(), surface.end.normal, surface.end.side, surface.eliminated];
        let mirror = surface.mirror.map_or([MOST as u32; MOST], |mirror| mirror.map(|stop| stop.0.into()));
        let numbers = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        let mut words = vec![method, convention, component, delay, period, seed];
        words.extend(end.map(|place| place as u32));
        words.extend(numbers(&self.numbers));
        words.extend(mirror);
        let [drive_sin, drive_cos] = &self.drive;
        for values in [&self.point, &self.gains, &self.push, drive_sin, drive_cos, &self.bound] {
            words.extend(numbers(values));
        }
        words
    }
}

shared_struct! {
    /// What became of a controlled trajectory.
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
    pub fn widen(&self, system: &System) -> control::Outcome {
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
