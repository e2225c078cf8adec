//! Whole planes, cut up in different ways.

use impact_atlas::analysis::{Probe, Regime, Schedule, Trace, Verdict};
use impact_atlas::backend::{Backend, BackendError, Cpu, Job, Unwatched, Watch, follow};
use impact_atlas::model::{Flows, Parameters, Setting};
use impact_atlas::plane::{Axis, AxisError, Plane, PlaneError, Start, Window};
use impact_atlas::sweep::{sample, sweep, sweep_windows};
use impact_atlas::system::Family;

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

/// A plane of a family, over the axes of these texts as this or another family has them.
fn of_family(family: &'static Family, [x, y]: [&str; 2], axes_of: &'static Family) -> Plane {
    let axis = |text: &str| Axis::of_family(text, axes_of).unwrap();
    let task = Schedule { transient: 10, observe: 8, max_period: 4, fixed_periods: true };
    Plane { x: axis(x), y: axis(y), parameters: Setting::defaults(family), start: Start::Rest, task }
}

#[test]
fn axes_of_another_family_are_refused() {
    for (name, x, y) in [
        ("shaw-holmes", "omega=2:3:3", "delta=0.1:0.3:2"),
        ("bouncing-ball", "f20=0:1:3", "mu_c=0.1:0.3:2"),
        // A component of a state of two coordinates, of a system that has one.
        ("shaw-holmes", "x2=0:0.1:3", "v2=0:1:2"),
    ] {
        let plane = of_family(Family::builtin(name), [x, y], Family::paper());
        assert!(matches!(plane.check(), Err(PlaneError::Axis(AxisError::Foreign { .. }))), "{name}");
        assert!(sweep(&plane, &Cpu, &Unwatched).is_err(), "{name}");
    }
    let mut own = of_family(Family::paper(), ["omega=2:3:3", "delta=0.1:0.3:2"], Family::paper());
    assert!(own.check().is_ok());
    own.x.steps.count = 0;
    assert!(matches!(own.check(), Err(PlaneError::Axis(AxisError::Count { .. }))));
}

#[test]
fn cells_beyond_a_plane_are_no_cells() {
    let plane = of_family(Family::paper(), ["omega=2:3:3", "delta=0.1:0.3:3"], Family::paper());
    let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let window = |column: u32, columns: u32| Window { column, row: 0, columns, rows: 1 };
    let within = sweep_windows(&plane, &[window(1, 2)], &Cpu, &Unwatched).unwrap();
    assert_eq!(within[0], [*map.at(1, 0), *map.at(2, 0)]);
    let fails = |work: &dyn Fn()| std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)).is_err();
    assert!(fails(&|| drop(sweep_windows(&plane, &[window(2, 2)], &Cpu, &Unwatched))));
    assert!(fails(&|| drop(sweep_windows(&plane, &[window(u32::MAX, 2)], &Cpu, &Unwatched))));
    assert!(fails(&|| assert_eq!(map.at(3, 0), map.at(3, 0))));
    assert!(fails(&|| drop(sample(&plane, &Cpu, &[9], &Unwatched))));
    assert!(!fails(&|| drop(sample(&plane, &Cpu, &[8], &Unwatched))));
}
