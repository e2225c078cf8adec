//! Whole planes on the reference.

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, BackendError, Cpu, Job, Unwatched, Watch};
use impact_atlas::model::Parameters;
use impact_atlas::plane::{Plane, Start};
use impact_atlas::sweep::sweep;

/// The reference with another tile.
#[derive(Debug)]
struct Tiled(usize);

impl Backend for Tiled {
    fn name(&self) -> &'static str {
        Cpu.name()
    }

    fn adapter(&self) -> String {
        Cpu.adapter()
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
        Cpu.run(jobs, schedule, watch)
    }
}

fn bits(tile: usize, threads: usize) -> Vec<String> {
    let plane = Plane {
        x: "omega=0.4:4.4:12".parse().unwrap(),
        y: "delta=0.05:0.4:9".parse().unwrap(),
        parameters: Parameters::default(),
        start: Start::Symmetric,
        schedule: Schedule { transient: 100, observe: 100, max_period: 16, fixed_periods: false },
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let map = pool.install(|| sweep(&plane, &Tiled(tile), &Unwatched)).unwrap();
    // As text, in which every bit counts and NaN equals NaN.
    map.verdicts.iter().map(|verdict| format!("{verdict:?}")).collect()
}

#[test]
fn the_same_bits_for_any_tile_and_any_number_of_threads() {
    let expected = bits(1 << 14, 1);
    assert_eq!(expected.len(), 108);
    for (tile, threads) in [(1, 1), (7, 3), (13, 2), (108, 5)] {
        assert_eq!(bits(tile, threads), expected, "tiles of {tile}, {threads} threads");
    }
}
