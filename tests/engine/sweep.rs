//! Whole planes, cut up in different ways.

use impact_atlas::analysis::{Probe, Regime, Schedule, Trace, Verdict};
use impact_atlas::backend::{Backend, BackendError, Cpu, Job, Unwatched, Watch, follow};
use impact_atlas::model::{Flows, Parameters};
use impact_atlas::plane::{Plane, Start};
use impact_atlas::sweep::sweep;

use crate::common::adapter::gpu;

/// A back end with another tile.
#[derive(Debug)]
struct Tiled<'a>(usize, &'a dyn Backend);

impl Backend for Tiled<'_> {
    fn name(&self) -> &'static str {
        self.1.name()
    }

    fn adapter(&self) -> String {
        self.1.adapter()
    }

    fn tile(&self) -> usize {
        self.0
    }

    fn run(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Verdict>, BackendError> {
        self.1.run(jobs, schedule, watch)
    }

    fn trace(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        probe: Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<Trace>, BackendError> {
        self.1.trace(jobs, schedule, probe, capacity, watch)
    }
}

/// What chaos is observed for: half an observation, or all of it, and what the longer look adds.
#[test]
fn chaos_is_observed_in_both_looks() {
    let schedule = Schedule { transient: 100, observe: 140, max_period: 16, fixed_periods: false };
    let plane = Plane::of_paper("omega=1.37:1.65:8", "delta=0.207:0.232:6", Start::Rest, schedule).unwrap();
    let whole = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let flows = Flows::default();
    let mut chaotic = 0;
    for cell in 0..whole.verdicts.len() as u32 {
        let (column, row) = (cell % 8, cell / 8);
        let verdict = whole.at(column, row);
        if verdict.regime != Regime::Chaotic || verdict.measures.observed != 70 + 64 {
            continue;
        }
        chaotic += 1;
        let system = flows.system(plane.parameters_at(column, row)).unwrap();
        let first = follow::<f64>(&Job { system: system.clone(), start: [0.0; 4].into() }, &schedule);
        let further = Schedule { transient: 200, observe: 64, ..schedule };
        let later = follow::<f64>(&Job { system, start: first.state }, &further);
        assert_eq!((first.measures.observed, later.measures.observed), (70, 64));
        let mean = (70.0 * first.lyapunov + 64.0 * later.lyapunov) / 134.0;
        assert!((verdict.lyapunov - mean).abs() < 1e-5, "{} for {mean}", verdict.lyapunov);
        assert!((verdict.lyapunov - first.lyapunov).abs() > 1e-6, "the later look counts");
        assert_eq!((verdict.impacts, verdict.state), (first.impacts + later.impacts, later.state));
    }
    assert!(chaotic > 20, "{chaotic} of {}", whole.verdicts.len());
}

fn bits(backend: &dyn Backend, tile: usize, threads: usize) -> Vec<String> {
    let plane = Plane {
        x: "omega=0.4:4.4:12".parse().unwrap(),
        y: "delta=0.05:0.4:9".parse().unwrap(),
        parameters: Parameters::default().into(),
        start: Start::Symmetric,
        task: Schedule { transient: 100, observe: 100, max_period: 16, fixed_periods: false },
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let map = pool.install(|| sweep(&plane, &Tiled(tile, backend), &Unwatched)).unwrap();
    // As text, in which every bit counts and NaN equals NaN.
    map.verdicts.iter().map(|verdict| format!("{verdict:?}")).collect()
}

#[test]
fn the_same_bits_for_any_tile_and_any_number_of_threads() {
    let expected = bits(&Cpu, 1 << 14, 1);
    assert_eq!(expected.len(), 108);
    for (tile, threads) in [(1, 1), (7, 3), (13, 2), (108, 5)] {
        assert_eq!(bits(&Cpu, tile, threads), expected, "tiles of {tile}, {threads} threads");
    }
}

/// An adapter's portions of work depend on its speed at the moment; its results do not.
#[test]
fn the_same_bits_for_any_tile_on_an_adapter() {
    let gpu = gpu();
    let expected = bits(gpu, 1 << 14, 2);
    for tile in [7, 50] {
        assert_eq!(bits(gpu, tile, 2), expected, "tiles of {tile}");
    }
}
