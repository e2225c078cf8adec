//! What back ends are given for cells, made flow by flow: what cells have in common is found once.

use rayon::prelude::*;

use super::Result;
use super::begun::Begun;
use super::order::{goes_by_column, has_flows_by_cell};
use super::swept::{Swept, Without};
use crate::backend::Job;
use crate::model::{Flows, Setting, System, SystemError};
use crate::plane::{Inadmissible, Plane};
use crate::theory::SymmetricStarts;

/// As many cells as are worth a thread's turn.
const AT_ONCE: usize = 8;

/// Makes what is asked of one cell after the other.
pub(super) struct Preparing<'a, T> {
    plane: &'a Plane<T>,
    flows: &'a Flows,
    /// The parameters of the last cell, or those that the axes leave.
    setting: Setting,
    /// A system that the next one may have its flow in common with.
    like: Option<System>,
    /// Whether no cell has its flow in common with another.
    each_alone: bool,
    symmetric: SymmetricStarts,
}

impl<'a, T> Preparing<'a, T> {
    /// Of a plane; `flows` are those of cells before.
    pub fn new(plane: &'a Plane<T>, flows: &'a Flows) -> Self {
        let (each_alone, symmetric) = (has_flows_by_cell(plane), SymmetricStarts::default());
        Preparing { plane, flows, setting: plane.parameters, like: None, each_alone, symmetric }
    }

    /// The system and the start of a cell, counted row by row; it shares what follows from its flow with cells before it.
    ///
    /// # Errors
    /// As [`System::new`].
    pub fn job(&mut self, cell: u64) -> Result<Begun, SystemError> {
        self.job_at(column_and_row(self.plane, cell))
    }

    /// The same of the cell in a column of a row.
    fn job_at(&mut self, (column, row): (u32, u32)) -> Result<Begun, SystemError> {
        self.plane.put_parameters(column, row, &mut self.setting);
        let start = self.plane.start_at(column, row);
        if self.each_alone {
            let system = System::new(self.setting)?;
            let start = start.begun_by(&system, &mut self.symmetric);
            // What was found on the way would be kept as long as the system is; of it only the mirror is asked for again.
            return Ok(start.map(|start| Job { system: system.alone(), start }));
        }
        let system = match self.like.as_ref().and_then(|like| like.neighbour(&self.setting)) {
            Some(system) => system,
            None => self.like.insert(self.flows.system(self.setting)?).clone(),
        };
        let start = start.begun_by(&system, &mut self.symmetric);
        Ok(start.map(|start| Job { system, start }))
    }
}

impl<T: Swept> Preparing<'_, T> {
    /// What a back end is given for a cell, counted row by row; nothing where there is nothing to do.
    ///
    /// # Errors
    /// What cannot be used, or does not begin.
    pub fn asked_of(&mut self, cell: u64) -> Result<Option<T::Job>, Without> {
        let at = column_and_row(self.plane, cell);
        let begun = self.job_at(at).map_err(|error| Without::Refused(error.into()))?;
        let job = begun.map_err(|Inadmissible(start)| Without::Inadmissible(start))?;
        T::job(self.plane, at, job).map_err(Without::Refused)
    }
}

/// The column and the row of a cell, counted row by row.
fn column_and_row<T>(plane: &Plane<T>, cell: u64) -> (u32, u32) {
    let columns = u64::from(plane.x.count);
    ((cell % columns) as u32, (cell / columns) as u32)
}

/// What is made of each of some cells, in their order; those that come one after the other share what they can.
pub(super) fn made<T: Sync, M: Send>(
    plane: &Plane<T>,
    cells: &[u64],
    flows: &Flows,
    make: impl Fn(&mut Preparing<'_, T>, u64) -> M + Sync,
) -> Vec<M> {
    (cells.par_iter().with_min_len(AT_ONCE))
        .map_init(|| Preparing::new(plane, flows), |preparing, &cell| make(preparing, cell))
        .collect()
}

/// The same of cells in any order, made flow by flow, each with its place among them.
fn made_by_flow<T: Sync, M: Send>(
    plane: &Plane<T>,
    cells: &[u64],
    flows: &Flows,
    make: impl Fn(&mut Preparing<'_, T>, u64) -> M + Sync,
) -> Vec<(u32, M)> {
    let mut order: Vec<(u32, u64)> = (0..).zip(cells.iter().copied()).collect();
    if goes_by_column(plane) {
        order.sort_by_key(|&(_, cell)| cell % u64::from(plane.x.count));
    }
    let (places, cells): (Vec<u32>, Vec<u64>) = order.into_iter().unzip();
    places.into_iter().zip(made(plane, &cells, flows, make)).collect()
}

/// The same, in the order of the cells, which share with no others.
pub(super) fn made_in_order<T: Sync, M: Send>(
    plane: &Plane<T>,
    cells: &[u64],
    make: impl Fn(&mut Preparing<'_, T>, u64) -> M + Sync,
) -> impl Iterator<Item = M> {
    let mut made = made_by_flow(plane, cells, &Flows::default(), make);
    made.sort_unstable_by_key(|&(place, _)| place);
    made.into_iter().map(|(_, made)| made)
}

/// The systems and the starts of some cells, in their order.
///
/// # Errors
/// As [`System::new`].
pub(super) fn jobs_of<T: Sync>(plane: &Plane<T>, cells: &[u64]) -> Result<Vec<Begun>, SystemError> {
    made_in_order(plane, cells, |preparing, cell| preparing.job(cell)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::{Axis, Start};
    use crate::system::Family;

    /// How far apart two jobs are that should be the same: in their starts, or infinitely.
    fn apart(a: &Job, b: &Job) -> f64 {
        let systems = [a, b]
            .map(|Job { system, .. }| (system.plant(), system.mirror(), system.steps(), system.setting()));
        if systems[0] != systems[1] || a.start.len() != b.start.len() {
            return f64::INFINITY;
        }
        a.start.iter().zip(b.start.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn cells_are_the_same_whichever_way_the_flow_varies() {
        let alone = |plane: &Plane<()>, cell: u64| {
            let (column, row) = column_and_row(plane, cell);
            let system = System::new(plane.parameters_at(column, row)).unwrap();
            let start = plane.start_at(column, row).state(&system);
            Job { system, start }
        };
        let (mut compared, mut begun) = (0, 0);
        for (family, x, y) in [
            ("luo-ma-lv", "omega=2:4:9", "delta=0.05:0.3:31"),
            ("luo-ma-lv", "delta=0.05:0.3:31", "omega=2:4:9"),
            ("luo-ma-lv", "delta=0.05:0.3:17", "r=0.5:0.9:11"),
            ("luo-ma-lv", "omega=2:4:9", "zeta=0.01:0.3:8"),
            // The mirror comes at β = 1, and goes.
            ("two-sided", "omega=0.5:2:7", "beta=0.5:1.5:11"),
            ("two-sided", "beta=0.5:1.5:11", "delta=0.1:0.5:7"),
        ] {
            let family = Family::builtin(family);
            let axis = |text: &str| Axis::of_family(text, family).unwrap();
            let parameters = Setting::defaults(family);
            let plane = Plane { x: axis(x), y: axis(y), parameters, start: Start::Symmetric, task: () };
            let cells: Vec<u64> = (3..plane.cells() - 5).collect();
            let made: Vec<Job> = jobs_of(&plane, &cells).unwrap().into_iter().map(Result::unwrap).collect();
            for (&cell, job) in cells.iter().zip(&made) {
                assert_eq!(apart(job, &alone(&plane, cell)), 0.0, "{x}, {y}: cell {cell}");
                compared += 1;
                begun += usize::from(job.start.iter().any(|value| *value != 0.0));
            }
            assert!(apart(&made[0], &alone(&plane, 4)) > 0.0, "the check can fail");
        }
        assert!(begun > 100 && begun < compared, "{begun} of {compared} begin on a symmetric motion");
    }

    #[test]
    fn cells_with_the_same_flow_come_one_after_the_other() {
        for (x, y) in [("omega=2:4:9", "delta=0.05:0.3:31"), ("delta=0.05:0.3:31", "omega=2:4:9")] {
            let plane = Plane::of_paper(x, y, Start::Rest, ()).unwrap();
            let cells: Vec<u64> = (0..plane.cells()).collect();
            let made = made_by_flow(&plane, &cells, &Flows::default(), |preparing, cell| {
                preparing.job(cell).unwrap().unwrap()
            });
            let omega = |(_, job): &(u32, Job)| job.system.parameters().omega;
            let changes = made.windows(2).filter(|pair| omega(&pair[0]) != omega(&pair[1])).count();
            assert_eq!(changes, 8, "{x}, {y}");
            let mut places: Vec<u32> = made.iter().map(|&(place, _)| place).collect();
            places.sort_unstable();
            assert!(places.into_iter().eq(0..plane.cells() as u32), "each cell once");
        }
    }
}
