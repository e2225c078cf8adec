//! Suppressing chaos at ω = 2.83, δ = 0.1: what each method reaches, held to theory and to the paper.

mod delay;
mod force;
pub(crate) mod maps;
mod ogy;
mod options;
mod plants;
mod pulse;
mod resting;
mod sine;

use std::sync::LazyLock;

use impact_atlas::backend::Gpu;
use impact_atlas::control::methods::{Convention, DelaySetting, Sign, SineSetting};
use impact_atlas::control::{
    ControlSchedule, Outcome, Return, Scheme, SectionValues, Target, Witness, control,
};
use impact_atlas::dynamics::Stop;
use impact_atlas::model::{Parameters, System};

use crate::common::adapter::open;

/// The device of this suite: the kernel of control takes a software adapter seconds to compile, for each shape of a system.
pub fn gpu() -> &'static Gpu {
    static GPU: LazyLock<Gpu> = LazyLock::new(open);
    &GPU
}

/// The unstable 1-2-1 fixed point (v1+, x2, v2, τ), found outside this project.
pub const FIXED_POINT: [f64; 4] = [-0.41959403, -0.02899702, 0.02903494, 1.80721094];

/// The 1-1-1 motion at the paper's reference, ω = 3.7.
pub const TARGET: Target = Target { reference: 3.7, given: SectionValues::new([None; 4]), own: 0 };

/// The system that is controlled: chaotic at ω = 2.83.
pub fn system() -> System {
    System::new(Parameters { omega: 2.83, ..Parameters::default() }).unwrap()
}

/// Keeps every return.
#[derive(Default)]
pub struct Returns(pub Vec<Return<f64>>);

impl Witness<f64> for Returns {
    fn returned(&mut self, met: &Return<f64>) {
        self.0.push(*met);
    }
}

/// Runs a scheme from iterate 2000 on.
pub fn run(scheme: &Scheme, iterates: u32, start: [f64; 4]) -> (Outcome, Vec<Return<f64>>) {
    let system = system();
    let controller = scheme.resolve(&system).unwrap();
    let schedule =
        ControlSchedule { from: 2000, iterates, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let mut returns = Returns::default();
    let outcome = control::<f64, _>(&system, &start, &controller, &schedule, &mut returns).unwrap();
    (outcome, returns.0)
}

/// Delayed feedback of one return, with a gain and its sign.
pub fn delay(gain: f64, sign: Sign) -> Scheme {
    Scheme::Delay(DelaySetting { stop: Stop::A, gains: SectionValues::new([gain; 4]), delay: 1, sign })
}

/// The sine force of a convention, with its amplitude, its weight α and its dead band.
pub fn sine(convention: Convention, amplitude: f64, alpha: f64, dead_band: f64) -> Scheme {
    Scheme::Sine(SineSetting {
        stop: Stop::A,
        coordinate: 0,
        convention,
        amplitude,
        alpha,
        dead_band,
        gamma: 1.0,
        phase: 0.0,
        component: 3,
        target: TARGET,
    })
}

/// The largest difference of a component.
pub fn away(a: impl AsRef<[f64]>, b: impl AsRef<[f64]>) -> f64 {
    a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Starts that differ in x2.
pub fn starts(count: u32) -> impl Iterator<Item = [f64; 4]> {
    (0..count).map(|k| [0.0, 0.01 * f64::from(k), 0.0, 0.0])
}
