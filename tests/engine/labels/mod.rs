//! Labels held to the truth: motions beside their bifurcations, transient chaos, and a plane continued by the oracle.

mod certified;
mod continued;
mod exponents;
mod mirrored;
mod named;

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, decide};
use impact_atlas::model::{Parameters, System};
use impact_atlas::plane::Start;

/// What the command line does by default, with a transient of so many forcing periods.
fn schedule(transient: u32) -> Schedule {
    Schedule { transient, observe: 150, max_period: 32, fixed_periods: false }
}

/// A system on its symmetric motion, nudged.
fn job(parameters: Parameters) -> Job {
    let system = System::new(parameters).unwrap();
    let start = Start::Symmetric.state(&system);
    Job { system, start }
}

/// The same system, a thousandth beside the motion that it settles on.
fn beside(job: &Job) -> Job {
    let start = decided(&Cpu, job, 300).state;
    moved(&Job { start, ..job.clone() }, 1e-3)
}

/// The same system with a start at which the first coordinate is so much faster.
fn moved(job: &Job, by: f64) -> Job {
    let mut start = job.start;
    start[2] += by;
    Job { start, ..job.clone() }
}

fn at(omega: f64, delta: f64) -> Parameters {
    Parameters { omega, delta, ..Parameters::default() }
}

fn decided(backend: &dyn Backend, job: &Job, transient: u32) -> Verdict {
    decide(backend, std::slice::from_ref(job), &schedule(transient), &Unwatched).unwrap()[0]
}
