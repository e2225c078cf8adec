//! Some cells spread over a plane, computed alone, from which the cost of the whole plane is estimated.

use super::Result;
use super::preparing::made_in_order;
use super::swept::{Swept, Without};
use crate::backend::{Backend, Watch};
use crate::plane::Plane;

/// In so many columns, where they are high enough: cells of a column may share what follows from their flow, as they do in the
/// whole plane.
const COLUMNS: u32 = 32;

/// Of the cells of these columns no more than one in so many is taken.
const ONE_OF: u32 = 4;

/// Cells of a plane of so many columns and rows by their indices, row by row: the first `count` of a sequence that
/// fills the plane evenly however many of it are taken, in some of its columns. A cell may come twice.
///
/// # Panics
/// If the plane has no cells.
pub fn spread(columns: u32, rows: u32, count: u32) -> Vec<u64> {
    /// The real root of g³ = g + 1, whose powers make the sequence.
    const G: f64 = 1.324_717_957_244_746;
    let place = |i: u32, step: f64, cells: u32| {
        let share = (0.5 + step * f64::from(i)).fract();
        u64::from(((share * f64::from(cells)) as u32).min(cells - 1))
    };
    let few = columns.min(COLUMNS.max(ONE_OF.saturating_mul(count).div_ceil(rows)));
    let column = |k: u64| (2 * k + 1) * u64::from(columns) / (2 * u64::from(few));
    (1..=count)
        .map(|i| place(i, 1.0 / (G * G), rows) * u64::from(columns) + column(place(i, 1.0 / G, few)))
        .collect()
}

/// What comes out of single cells of a plane, the same as in the whole; those that cannot be controlled are left out, and those that
/// are inadmissible.
///
/// # Errors
/// As [`sweep`](super::sweep).
///
/// # Panics
/// If the plane does not have the cells.
pub fn sample<T: Swept>(
    plane: &Plane<T>,
    backend: &dyn Backend,
    cells: &[u64],
    watch: &dyn Watch,
) -> Result<Vec<T::Cell>> {
    assert!(
        cells.iter().all(|&cell| cell < plane.cells()),
        "the cells are those of the plane: {}",
        plane.cells()
    );
    let jobs: Result<Vec<_>, _> = made_in_order(plane, cells, |preparing, cell| preparing.asked_of(cell))
        .filter_map(|asked| match asked {
            Err(Without::Refused(why)) if !why.is_of_one_cell() => Some(Err(why)),
            asked => asked.ok().flatten().map(Ok),
        })
        .collect();
    Ok(plane.task.run(backend, &jobs?, watch)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::backend::{Cpu, Unwatched};
    use crate::plane::Start;
    use crate::sweep::sweep;

    #[test]
    fn the_cells_fill_the_plane_evenly() {
        for (columns, rows) in [(40, 30), (1, 50), (7, 1), (300, 2)] {
            let cells = spread(columns, rows, 64);
            assert!(cells.iter().all(|&cell| cell < u64::from(columns) * u64::from(rows)));
            // Every quarter of the plane has about a quarter of the cells.
            for (columns, rows) in [(columns, rows); 1].into_iter().filter(|&(c, r)| c > 5 && r > 5) {
                let quarter = |cell: &u64| {
                    let (column, row) = (cell % u64::from(columns), cell / u64::from(columns));
                    (2 * column / u64::from(columns), 2 * row / u64::from(rows))
                };
                for wanted in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let there = cells.iter().filter(|cell| quarter(cell) == wanted).count();
                    assert!((12..=20).contains(&there), "{there} in {wanted:?}");
                }
            }
        }
    }

    #[test]
    fn a_cell_alone_is_the_cell_of_the_plane() {
        let schedule = Schedule { transient: 60, observe: 40, max_period: 8, fixed_periods: false };
        let plane = Plane::of_paper("omega=2:4:6", "delta=0.05:0.3:5", Start::Symmetric, schedule).unwrap();
        let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
        let cells = spread(6, 5, 9);
        let alone = sample(&plane, &Cpu, &cells, &Unwatched).unwrap();
        for (&cell, verdict) in cells.iter().zip(&alone) {
            assert_eq!(&map.verdicts[cell as usize], verdict);
        }
    }
}
