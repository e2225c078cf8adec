//! How many trajectories, and impacts, a back end follows in a second.
//!
//! The workload is fixed: ω from 1 to 5 and δ from 0.1 to 0.6 in equal steps, every cell from rest, 200 forcing
//! periods without early finish. In f32 the end states are compared with the CPU path's f64, cell by cell where the motion
//! is regular (its largest Lyapunov exponent is below zero); the f64 path itself is held to an independent oracle by the
//! tests.
//!
//! ```text
//! cargo run --release --example throughput -- [cpu|gpu|f32] [SIDE] [REPEATS]
//! ```
//!
//! SIDE is the cells along either axis (32 by default; 1024 for a million-cell plane). The number of threads of the
//! CPU path is RAYON_NUM_THREADS, all cores by default. `f32` is the CPU in the GPU's precision.

use std::time::Instant;

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, BackendError, Cpu, Gpu, Job, Unwatched, follow};
use impact_atlas::model::{Parameters, System};
use rayon::prelude::*;

const PERIODS: u32 = 200;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "cpu".to_owned());
    let side: u32 = arguments.next().map_or(Ok(32), |text| text.parse())?;
    let repeats: u32 = arguments.next().map_or(Ok(5), |text| text.parse())?;
    let jobs = jobs(side)?;
    let schedule = schedule(PERIODS - 1);
    let runner: Box<dyn Fn() -> Result<Vec<Verdict>, BackendError>> = match path.as_str() {
        "cpu" => {
            println!("{}, {} threads", Cpu.adapter(), rayon::current_num_threads());
            Box::new(|| Cpu.run(&jobs, &schedule, &Unwatched))
        }
        "gpu" => {
            let gpu = Gpu::open(None)?;
            println!("{}", gpu.adapter());
            let jobs = &jobs;
            Box::new(move || gpu.run(jobs, &schedule, &Unwatched))
        }
        "f32" => {
            println!("{} f32, {} threads", std::env::consts::ARCH, rayon::current_num_threads());
            Box::new(|| Ok(jobs.par_iter().map(|job| follow::<f32>(job, &schedule)).collect()))
        }
        other => return Err(format!("`{other}` is no path: choose cpu, gpu or f32").into()),
    };
    let mut verdicts = Vec::new();
    let mut fastest = f64::INFINITY;
    for _ in 0..repeats.max(1) {
        let began = Instant::now();
        verdicts = runner()?;
        fastest = fastest.min(began.elapsed().as_secs_f64());
    }
    let impacts: u64 = verdicts.iter().map(|verdict| u64::from(verdict.impacts_total)).sum();
    println!(
        "{} trajectories of {PERIODS} periods, {impacts} impacts, fastest of {repeats}: {fastest:.3} s",
        jobs.len()
    );
    println!("{:.0} trajectories/s", jobs.len() as f64 / fastest);
    println!("{:.3e} impacts/s", impacts as f64 / fastest);
    if path != "cpu" {
        report_errors(&jobs, &verdicts)?;
    }
    Ok(())
}

fn schedule(transient: u32) -> Schedule {
    Schedule { transient, observe: PERIODS - transient, max_period: 32, fixed_periods: true }
}

fn jobs(side: u32) -> Result<Vec<Job>, Box<dyn std::error::Error>> {
    let value = |first: f64, last: f64, i: u32| first + (last - first) * f64::from(i) / f64::from(side - 1);
    let mut jobs = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let omega = value(1.0, 5.0, column);
            let delta = value(0.1, 0.6, row);
            let system = System::new(Parameters { omega, delta, ..Parameters::default() })?;
            jobs.push(Job { system, start: [0.0; 4].into() });
        }
    }
    Ok(jobs)
}

/// How far the end states are from f64 where the motion is regular.
fn report_errors(jobs: &[Job], verdicts: &[Verdict]) -> Result<(), BackendError> {
    let reference = Cpu.run(jobs, &schedule(PERIODS / 2), &Unwatched)?;
    let mut errors: Vec<f64> = reference
        .iter()
        .zip(verdicts)
        .filter(|(reference, _)| reference.lyapunov < 0.0)
        .map(|(reference, verdict)| {
            let pairs = reference.state.iter().zip(verdict.state.iter());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    let quantile = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    println!(
        "end states of {} regular cells against f64: median {:.1e}, 95th percentile {:.1e}, largest {:.1e}",
        errors.len(),
        quantile(0.5),
        quantile(0.95),
        quantile(1.0)
    );
    Ok(())
}
