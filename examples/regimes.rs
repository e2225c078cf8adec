//! Where the time of a region map goes: the plane of the paper's Fig. 5, its cells timed regime by regime.
//!
//! ```text
//! cargo run --release --example regimes -- [COLUMNS] [ROWS] [REPEATS] [--json]
//! ```
//!
//! 190 × 130 cells by default, on the CPU path. The number of threads is RAYON_NUM_THREADS, all cores by default. Cells that
//! are looked at a second time are timed with that look.

use std::time::Instant;

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, BackendError, Cpu, Job, Unwatched, decide};
use impact_atlas::model::Flows;
use impact_atlas::plane::{Plane, Start};
use mimalloc::MiMalloc;
use serde::Serialize;

/// That of the program.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// What the cells of one regime took.
#[derive(Serialize)]
struct Measured {
    regime: &'static str,
    cells: usize,
    /// Of the fastest run.
    seconds: f64,
    microseconds_a_cell: f64,
    /// Forcing periods that were followed, a cell on average.
    periods: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (flags, words): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let number = |i: usize, usual: u32| words.get(i).map_or(Ok(usual), |text| text.parse());
    let (columns, rows, repeats) = (number(0, 190)?, number(1, 130)?, number(2, 3)?.max(1));
    let (x, y) = (format!("omega=0.2:5:{columns}"), format!("delta=0.02:0.8:{rows}"));
    let schedule = Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false };
    let plane = Plane::of_paper(&x, &y, Start::Symmetric, schedule)?;
    let (jobs, making) = fastest(repeats, || made(&plane))?;
    let (verdicts, whole) = fastest(repeats, || followed(&jobs, &plane.task))?;
    let mut measured = Vec::new();
    for regime in Regime::ALL {
        let among: Vec<usize> = (0..jobs.len()).filter(|&i| verdicts[i].regime == regime).collect();
        if among.is_empty() {
            continue;
        }
        let chosen: Vec<Job> = among.iter().map(|&i| jobs[i].clone()).collect();
        let (again, seconds) = fastest(repeats, || followed(&chosen, &plane.task))?;
        assert!(again.iter().zip(&among).all(|(verdict, &i)| *verdict == verdicts[i]), "the same verdicts");
        let cells = among.len();
        let periods = again.iter().map(|verdict| f64::from(verdict.periods)).sum::<f64>() / cells as f64;
        let microseconds_a_cell = 1e6 * seconds / cells as f64;
        measured.push(Measured { regime: regime.name(), cells, seconds, microseconds_a_cell, periods });
    }
    if flags.iter().any(|flag| flag == "--json") {
        let report = serde_json::json!({
            "what": Cpu.adapter(), "threads": rayon::current_num_threads(), "cells": jobs.len(),
            "making_seconds": making, "following_seconds": whole, "regimes": measured,
        });
        println!("{report:#}");
        return Ok(());
    }
    println!("{}, {} threads", Cpu.adapter(), rayon::current_num_threads());
    println!(
        "{} cells made in {making:.2} s ({:.2} µs a cell), followed in {whole:.2} s",
        jobs.len(),
        1e6 * making / jobs.len() as f64
    );
    println!("{:<24} {:>7} {:>8} {:>10} {:>14}", "regime", "cells", "seconds", "µs a cell", "periods a cell");
    for Measured { regime, cells, seconds, microseconds_a_cell, periods } in &measured {
        println!("{regime:<24} {cells:>7} {seconds:>8.3} {microseconds_a_cell:>10.1} {periods:>14.1}");
    }
    Ok(())
}

/// The same thing done several times: the last result, and the seconds of the fastest run.
fn fastest<R, E>(repeats: u32, what: impl Fn() -> Result<R, E>) -> Result<(R, f64), E> {
    let timed = || {
        let began = Instant::now();
        what().map(|result| (result, began.elapsed().as_secs_f64()))
    };
    let mut best = timed()?;
    for _ in 1..repeats {
        let (result, seconds) = timed()?;
        best = (result, seconds.min(best.1));
    }
    Ok(best)
}

/// The system and the start of every cell.
fn made(plane: &Plane) -> Result<Vec<Job>, Box<dyn std::error::Error>> {
    let flows = Flows::default();
    let mut jobs = Vec::new();
    for row in 0..plane.y.count {
        for column in 0..plane.x.count {
            let system = flows.system(plane.parameters_at(column, row))?;
            let start = plane.start_at(column, row).state(&system);
            jobs.push(Job { system, start });
        }
    }
    Ok(jobs)
}

fn followed(jobs: &[Job], schedule: &Schedule) -> Result<Vec<Verdict>, BackendError> {
    let mut verdicts = Vec::with_capacity(jobs.len());
    for tile in jobs.chunks(1 << 14) {
        verdicts.extend(decide(&Cpu, tile, schedule, &Unwatched)?);
    }
    Ok(verdicts)
}
