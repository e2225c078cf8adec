//! Every back end against the brute-force oracle.

mod narrow;
mod recording;
mod suite;

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, follow};
use rayon::prelude::*;

use crate::common::adapter;
use suite::instantiate;

/// The CPU path, f64.
fn cpu(jobs: &[Job], schedule: &Schedule) -> Vec<Verdict> {
    Cpu.run(jobs, schedule, &Unwatched).expect("nothing stops the CPU path")
}

/// What the GPU computes, in f32 on the CPU.
fn twin(jobs: &[Job], schedule: &Schedule) -> Vec<Verdict> {
    jobs.par_iter().map(|job| follow::<f32>(job, schedule)).collect()
}

/// The GPU, f32: a hardware adapter or a software one. That there is none is a failure.
fn gpu(jobs: &[Job], schedule: &Schedule) -> Vec<Verdict> {
    adapter::gpu().run(jobs, schedule, &Unwatched).expect("the adapter finishes")
}

instantiate!(cpu_f64, crate::against_oracle::cpu, FINE, penetration: 1e-12, defect: 1e-6);
instantiate!(cpu_f32, crate::against_oracle::twin, COARSE, penetration: 1e-5, defect: 2e-2);
instantiate!(gpu_f32, crate::against_oracle::gpu, COARSE, penetration: 1e-5, defect: 2e-2);
