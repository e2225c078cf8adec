//! Every back end against the brute-force oracle.

#[path = "../common/mod.rs"]
mod common;

mod suite;

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, follow};
use rayon::prelude::*;

/// The CPU path, f64.
fn cpu(jobs: &[Job], schedule: &Schedule) -> Vec<Verdict> {
    Cpu.run(jobs, schedule, &Unwatched).expect("nothing stops the CPU path")
}

/// What the GPU computes, in f32 on the CPU.
fn twin(jobs: &[Job], schedule: &Schedule) -> Vec<Verdict> {
    jobs.par_iter().map(|job| follow::<f32>(job, schedule)).collect()
}

instantiate!(cpu_f64, crate::cpu, FINE, penetration: 1e-12, defect: 1e-6);
instantiate!(cpu_f32, crate::twin, COARSE, penetration: 1e-5, defect: 3e-3);
