//! How long the processor prepares a cell of a plane, its system and its start, before a back end is given them, and puts what
//! comes back into its place.
//!
//! Four planes of 800 × 600 cells of the paper's oscillator, of which cells have more or less in common: along a column the
//! flow, and all but the gap; the flow; nothing. A back end that follows nothing is given them, so that what is measured is what
//! a fast one would wait for, and room for the results; its own constants, of each flow once, come on top.
//!
//! ```text
//! cargo run --release --example preparing -- [REPEATS]
//! ```
//!
//! The number of threads is RAYON_NUM_THREADS, all cores by default.

use std::time::Instant;

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Job, Result, Unwatched, Watch};
use impact_atlas::plane::{Plane, Reached, Start};
use impact_atlas::sweep::sweep;
use mimalloc::MiMalloc;
use rayon::prelude::*;

/// That of the program.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// Follows nothing.
#[derive(Debug)]
struct Idle;

impl Backend for Idle {
    fn name(&self) -> &'static str {
        "idle"
    }

    fn adapter(&self) -> String {
        "none".to_owned()
    }

    fn tile(&self) -> usize {
        1 << 15
    }

    fn run(&self, jobs: &[Job], _: &Schedule, watch: &dyn Watch) -> Result<Vec<Verdict>> {
        watch.finished(jobs.len() as u64);
        let nothing =
            |job: &Job| Verdict { regime: Regime::NoImpact, ..Verdict::unresolved(job.system.coordinates()) };
        Ok(jobs.par_iter().map(nothing).collect())
    }
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let repeats = std::env::args().nth(1).map_or(Ok(3), |text| text.parse::<u32>())?;
    let omega = "omega=0.5:4.4:800";
    println!("{:<10} {:<40} {:>14}", "start", "plane", "µs for a cell");
    for start in [Start::Rest, Start::Symmetric] {
        for y in ["delta=0.02:0.6:600", "r=0.3:0.95:600", "zeta=0.02:0.6:600", "mu_m=0.1:0.9:600"] {
            let schedule = Schedule { transient: 1, observe: 1, max_period: 1, fixed_periods: true };
            let plane = Plane::of_paper(omega, y, start, schedule)?;
            let mut fastest = f64::INFINITY;
            for _ in 0..repeats.max(1) {
                let began = Instant::now();
                sweep(&plane, &Idle, &Unwatched)?;
                fastest = fastest.min(began.elapsed().as_secs_f64());
            }
            let each = 1e6 * fastest / plane.cells() as f64;
            println!("{:<10} {:<40} {each:>14.2}", start.to_string(), format!("{omega} × {y}"));
        }
    }
    Ok(())
}
