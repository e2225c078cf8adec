//! How long a plane will take, measured on some of its cells before the rest is begun.

use std::time::{Duration, Instant};

use impact_atlas::backend::{Backend, Watch, Width};
use impact_atlas::plane::Plane;
use impact_atlas::sweep::{Swept, sample, spread};

use super::interrupt::{self, Interruptible};
use super::{CliError, note, spans};

/// The most cells that are measured.
const MOST: u32 = 512;

/// One cell of so many is measured, so that measuring costs little beside the rest.
const ONE_OF: u64 = 32;

/// One of so many where it will take long: a few cells may cost more than all the others.
const ONE_OF_FEWER: u64 = 8;

/// Planes of fewer cells are not worth it.
const FEWEST: u64 = 64;

/// When measuring ends.
const LONGEST: Duration = Duration::from_secs(1);

/// What will take longer than this is announced.
pub const WORTH_SAYING: Duration = Duration::from_secs(10);

/// Says how long a plane will take on a back end, if that is long.
pub fn of_plane<T: Swept>(what: &str, plane: &Plane<T>, backend: &dyn Backend) -> Result<(), CliError> {
    of_cells(what, [plane.x.count, plane.y.count], backend, |cells, watch| {
        sample(plane, backend, cells, watch).map(drop).map_err(CliError::from)
    })
}

fn of_cells(
    what: &str,
    [columns, rows]: [u32; 2],
    backend: &dyn Backend,
    compute: impl Fn(&[u64], &dyn Watch) -> Result<(), CliError>,
) -> Result<(), CliError> {
    let all = u64::from(columns) * u64::from(rows);
    if all < FEWEST {
        return Ok(());
    }
    let cells = spread(columns, rows, u32::try_from(all / ONE_OF_FEWER).unwrap_or(MOST).min(MOST));
    // A device works on many cells at once; a processor on as many as its threads have lanes.
    let lanes = Width::available()[0].lanes() * rayon::current_num_threads();
    let together = if backend.name() == "cpu" { lanes } else { MOST as usize };
    let began = Instant::now();
    let mut measured = 0;
    let mut estimate = Duration::ZERO;
    for some in cells.chunks(together) {
        compute(some, &Interruptible)?;
        interrupt::check()?;
        measured += some.len();
        estimate = began.elapsed().mul_f64(all as f64 / measured as f64);
        let is_short = measured as u64 >= all / ONE_OF && estimate < WORTH_SAYING;
        if is_short || began.elapsed() > LONGEST {
            break;
        }
    }
    if estimate > WORTH_SAYING {
        let time = spans::words(estimate);
        note(&format!("{what} will take about {time} (measured on {measured} of {all} cells)"));
    }
    Ok(())
}
