//! How many trajectories, and impacts, a back end follows in a second.
//!
//! Five workloads, every cell from rest:
//!
//! - `plane`: ω from 1 to 5 and δ from 0.1 to 0.6 in equal steps, 200 forcing periods without early finish;
//! - `observed`: the same, all of its periods observed: a tangent vector goes along with every trajectory;
//! - `figure`: the plane of the paper's Fig. 5, ω from 0.5 to 4.4 and δ from 0.02 to 0.6, by the default schedule but without
//!   longer looks;
//! - `chaos`: ω from 1.37 to 1.65 and δ from 0.207 to 0.232, where nearly all motion is chaotic, 200 forcing periods without
//!   early finish, all of them observed;
//! - `chatter`: ω from 0.2 to 0.6 and δ from 0.1 to 0.6, 200 forcing periods without early finish.
//!
//! In f32 the end states of `plane` are compared with the CPU path's f64, cell by cell where the motion is regular (its
//! largest Lyapunov exponent is below zero); the f64 path itself is held to an independent oracle by the tests.
//!
//! ```text
//! cargo run --release --example throughput -- [cpu|sixteen|four|one|gpu|exact|f32] [SIDE] [REPEATS] \
//!     [--only=WORKLOAD] [--json]
//! ```
//!
//! SIDE is the cells along either axis (32 by default; 1024 for a million-cell plane). `cpu` follows as many trajectories
//! side by side as the processor has room for, `sixteen`, `four` and `one` that many where it has room for them. The number of
//! threads is RAYON_NUM_THREADS, all cores by default. `exact` is the GPU with arithmetic that no driver changes, `f32` the
//! CPU in the GPU's precision: their end states have the same bits. Preparing the cells' constants is part of the time, and is
//! measured by itself too.
//!
//! Lanes of the processor say how much of their room was used, and how many contacts were not certain; an adapter's time is
//! split into what the processor prepares, transfers, dispatches (with the kernel's own time, where the adapter has a clock)
//! and reads back.

use std::collections::BTreeMap;
use std::time::Instant;

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{
    Backend, BackendError, Cpu, CpuSingle, Gpu, Job, Spent, Unwatched, follow_counted,
};
use impact_atlas::dynamics::Usage;
use impact_atlas::model::{ByFlow, Flights, Flows, Parameters, Width};
use mimalloc::MiMalloc;
use serde::Serialize;

/// That of the program.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

const PERIODS: u32 = 200;

/// A plane of cells and how long each is followed.
struct Workload {
    name: &'static str,
    omega: [f64; 2],
    delta: [f64; 2],
    schedule: Schedule,
}

/// What one workload took.
#[derive(Serialize)]
struct Measured {
    workload: &'static str,
    cells: usize,
    impacts: u64,
    /// Of the fastest run.
    seconds: f64,
    /// Of preparing the constants of all cells, which is part of it.
    preparing_seconds: f64,
    trajectories_per_second: f64,
    impacts_per_second: f64,
    /// Cells by regime.
    regimes: BTreeMap<String, usize>,
    /// How well the lanes were used; none where trajectories are followed one by one or by another adapter.
    lanes: Option<Lanes>,
    /// Where the time of the fastest run went; on an adapter.
    spent: Option<Spent>,
    /// Median, 95th percentile and largest distance of regular end states from f64; none for f64 itself.
    end_states_off: Option<[f64; 3]>,
}

/// How well the lanes were used.
#[derive(Serialize)]
struct Lanes {
    /// The share of the room for steps of flight that was used.
    steps: f64,
    /// The share of the room for contacts that was used.
    contacts: f64,
    /// The share of the contacts that lanes came to which were not certain.
    fallbacks: f64,
    /// The share of all impacts that were followed one trajectory at a time: chatter, sticking, and what follows a fallback.
    alone: f64,
}

/// What a run gives, and what it tells of itself.
struct Told {
    verdicts: Vec<Verdict>,
    usage: Usage,
    spent: Option<Spent>,
}

type Runner = Box<dyn Fn(&[Job], &Schedule) -> Result<Told, BackendError>>;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (flags, words): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let json = flags.iter().any(|flag| flag == "--json");
    let only = flags.iter().find_map(|flag| flag.strip_prefix("--only="));
    let path = words.first().map_or("cpu", String::as_str);
    let side: u32 = words.get(1).map_or(Ok(32), |text| text.parse())?;
    let repeats: u32 = words.get(2).map_or(Ok(3), |text| text.parse())?;
    let (what, runner) = runner(path)?;
    let mut measured = Vec::new();
    for workload in workloads() {
        if only.is_none_or(|name| name == workload.name) {
            measured.push(measure(&workload, side, repeats, path, &runner)?);
        }
    }
    if measured.is_empty() {
        let names = workloads().map(|workload| workload.name).join(", ");
        return Err(format!("`{}` is no workload: choose one of {names}", only.unwrap_or_default()).into());
    }
    if json {
        let report = serde_json::json!({
            "path": path, "what": what, "threads": rayon::current_num_threads(), "workloads": measured,
        });
        println!("{report:#}");
        return Ok(());
    }
    println!("{what}, {} threads", rayon::current_num_threads());
    println!(
        "{:<9} {:>8} {:>9} {:>9} {:>14} {:>11}",
        "workload", "cells", "seconds", "preparing", "trajectories/s", "impacts/s"
    );
    for row in &measured {
        println!(
            "{:<9} {:>8} {:>9.4} {:>9.4} {:>14.0} {:>11.3e}",
            row.workload,
            row.cells,
            row.seconds,
            row.preparing_seconds,
            row.trajectories_per_second,
            row.impacts_per_second
        );
    }
    for Measured { workload, lanes, .. } in &measured {
        if let Some(Lanes { steps, contacts, fallbacks, alone }) = lanes {
            println!(
                "{workload}: lanes stepping {:.0} %, in contacts {:.0} %; contacts not certain {:.2} %; impacts one at a time {:.1} %",
                100.0 * steps,
                100.0 * contacts,
                100.0 * fallbacks,
                100.0 * alone
            );
        }
    }
    for Measured { workload, spent, .. } in &measured {
        if let Some(Spent { preparing, transferring, dispatching, kernel, reading, dispatches }) = spent {
            let kernel = kernel.map_or("not told".to_owned(), |kernel| format!("{kernel:.4} s"));
            println!(
                "{workload}: prepared in {preparing:.4} s, transferred in {transferring:.4} s, {dispatches} dispatches in \
                 {dispatching:.4} s (kernel {kernel}), read back in {reading:.4} s"
            );
        }
    }
    for Measured { workload, end_states_off, .. } in &measured {
        if let Some([median, most, largest]) = end_states_off {
            println!(
                "{workload}: regular end states against f64: median {median:.1e}, 95 % {most:.1e}, largest {largest:.1e}"
            );
        }
    }
    Ok(())
}

/// How many trajectories one core follows at once.
fn width(path: &str) -> Result<Width, String> {
    let lanes = match path {
        "sixteen" => 16,
        "four" => 4,
        "one" => 1,
        _ => return Ok(Width::widest()),
    };
    let found = Width::available().find(|width| width.lanes::<f64>() == lanes);
    found.ok_or_else(|| format!("this processor does not follow {lanes} side by side: choose cpu or one"))
}

/// What computes, and how it is run.
fn runner(path: &str) -> Result<(String, Runner), Box<dyn std::error::Error>> {
    Ok(match path {
        "cpu" | "sixteen" | "four" | "one" => {
            let width = width(path)?;
            let what = format!("{}, {}", Cpu.adapter(), width.description::<f64>());
            (
                what,
                Box::new(move |jobs, schedule| {
                    let (verdicts, usage) = follow_counted::<f64>(jobs, schedule, &Unwatched, width)?;
                    Ok(Told { verdicts, usage, spent: None })
                }),
            )
        }
        "gpu" | "exact" => {
            let gpu = if path == "gpu" { Gpu::open(None)? } else { Gpu::open_exact(None)? };
            let adapter = gpu.adapter();
            let run = move |jobs: &[Job], schedule: &Schedule| {
                gpu.spent();
                let verdicts = gpu.run(jobs, schedule, &Unwatched)?;
                Ok(Told { verdicts, usage: Usage::default(), spent: Some(gpu.spent()) })
            };
            (adapter, Box::new(run))
        }
        "f32" => {
            let width = Width::widest();
            let what = format!("{}, {}", CpuSingle.adapter(), width.description::<f32>());
            let run = move |jobs: &[Job], schedule: &Schedule| {
                let (verdicts, usage) = follow_counted::<f32>(jobs, schedule, &Unwatched, width)?;
                Ok(Told { verdicts, usage, spent: None })
            };
            (what, Box::new(run))
        }
        other => {
            return Err(
                format!("`{other}` is no path: choose cpu, sixteen, four, one, gpu, exact or f32").into()
            );
        }
    })
}

fn workloads() -> [Workload; 5] {
    let fixed =
        |transient| Schedule { transient, observe: PERIODS - transient, max_period: 32, fixed_periods: true };
    let default = Schedule { transient: 400, observe: 200, max_period: 32, fixed_periods: false };
    [
        Workload { name: "plane", omega: [1.0, 5.0], delta: [0.1, 0.6], schedule: fixed(PERIODS - 1) },
        Workload { name: "observed", omega: [1.0, 5.0], delta: [0.1, 0.6], schedule: fixed(0) },
        Workload { name: "figure", omega: [0.5, 4.4], delta: [0.02, 0.6], schedule: default },
        Workload { name: "chaos", omega: [1.37, 1.65], delta: [0.207, 0.232], schedule: fixed(0) },
        Workload { name: "chatter", omega: [0.2, 0.6], delta: [0.1, 0.6], schedule: fixed(PERIODS - 1) },
    ]
}

fn measure(
    workload: &Workload,
    side: u32,
    repeats: u32,
    path: &str,
    runner: &Runner,
) -> Result<Measured, Box<dyn std::error::Error>> {
    let jobs = jobs(workload, side)?;
    let mut told = Told { verdicts: Vec::new(), usage: Usage::default(), spent: None };
    let mut seconds = f64::INFINITY;
    for _ in 0..repeats.max(1) {
        let began = Instant::now();
        let again = runner(&jobs, &workload.schedule)?;
        let took = began.elapsed().as_secs_f64();
        if took < seconds {
            (seconds, told) = (took, again);
        }
    }
    let Told { verdicts, usage, spent } = told;
    let began = Instant::now();
    std::hint::black_box(Flights::<f64, 2>::of(ByFlow::of(&jobs, |job| &job.system)));
    let preparing_seconds = began.elapsed().as_secs_f64();
    let mut regimes = BTreeMap::new();
    for verdict in &verdicts {
        *regimes.entry(verdict.regime.name().to_owned()).or_insert(0) += 1;
    }
    let impacts: u64 = verdicts.iter().map(|verdict| u64::from(verdict.impacts_total)).sum();
    let in_f32 = workload.name == "plane" && matches!(path, "gpu" | "f32");
    Ok(Measured {
        workload: workload.name,
        cells: jobs.len(),
        impacts,
        seconds,
        preparing_seconds,
        trajectories_per_second: jobs.len() as f64 / seconds,
        impacts_per_second: impacts as f64 / seconds,
        regimes,
        lanes: (usage.step_slots > 0).then(|| Lanes {
            steps: usage.share_of_steps(),
            contacts: usage.share_of_contacts(),
            fallbacks: usage.share_of_fallbacks(),
            alone: 1.0 - usage.contacts as f64 / impacts.max(1) as f64,
        }),
        spent,
        end_states_off: if in_f32 { Some(errors(&jobs, &verdicts)?) } else { None },
    })
}

fn jobs(workload: &Workload, side: u32) -> Result<Vec<Job>, Box<dyn std::error::Error>> {
    let value = |[first, last]: [f64; 2], i: u32| first + (last - first) * f64::from(i) / f64::from(side - 1);
    let flows = Flows::default();
    let mut jobs = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let (omega, delta) = (value(workload.omega, column), value(workload.delta, row));
            let system = flows.system(Parameters { omega, delta, ..Parameters::default() }.into())?;
            jobs.push(Job { system, start: [0.0; 4].into() });
        }
    }
    Ok(jobs)
}

/// How far the end states are from f64 where the motion is regular: median, 95th percentile, largest.
fn errors(jobs: &[Job], verdicts: &[Verdict]) -> Result<[f64; 3], BackendError> {
    let halves =
        Schedule { transient: PERIODS / 2, observe: PERIODS / 2, max_period: 32, fixed_periods: true };
    let reference = Cpu.run(jobs, &halves, &Unwatched)?;
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
    Ok([quantile(0.5), quantile(0.95), quantile(1.0)])
}
