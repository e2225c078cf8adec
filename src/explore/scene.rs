//! A plane that is looked at: what is asked of its cells, what computes them, and the motions met so far.

use std::collections::HashMap;
use std::sync::Arc;

use parking_lot::Mutex;

use super::backends::Computing;
use super::known::Known;
use super::lattice::{self, Cell};
use super::limits;
use super::stored::Stored;
use crate::analysis::Verdict;
use crate::backend::Job;
use crate::model::System;
use crate::plane::{Axis, Plane};
use crate::render::Motion;
use crate::sweep::Begun;

/// A plane that is looked at.
#[derive(Debug)]
pub struct Scene {
    /// The number by which pages name it.
    pub id: u32,
    /// The plane that was asked for: the cells of level 0 are its own.
    pub plane: Plane,
    /// What computes.
    pub computing: Computing,
    /// Cells that were computed before, those of a file.
    known: Option<Arc<Known>>,
    motions: Mutex<Motions>,
}

/// Motions by their numbers.
#[derive(Debug, Default)]
struct Motions {
    numbers: HashMap<Motion, u16>,
    examples: Vec<Verdict>,
}

impl Scene {
    /// A plane to be looked at; `known` are cells of it that need not be computed.
    pub fn new(id: u32, plane: Plane, computing: Computing, known: Option<Arc<Known>>) -> Self {
        Scene { id, plane, computing, known, motions: Mutex::default() }
    }

    /// The value of the axes at a cell.
    pub fn values(&self, cell: Cell) -> [f64; 2] {
        [lattice::value(&self.plane.x, cell.z, cell.i), lattice::value(&self.plane.y, cell.z, cell.j)]
    }

    /// Makes ready what is known from before of some cells.
    ///
    /// # Errors
    /// What could not be read, in words.
    pub fn prepare(&self, cells: impl Iterator<Item = Cell>) -> Result<(), String> {
        self.known.as_ref().map_or(Ok(()), |known| known.prepare(cells))
    }

    /// The store that its cells are in, if they are in one.
    pub fn stored(&self) -> Option<&Stored> {
        self.known.as_ref()?.stored()
    }

    /// Whether the cells of a level are those that are known from before, and were certified.
    pub fn is_certified(&self, level: i32) -> bool {
        level == 0 && self.known.as_ref().is_some_and(|known| known.is_certified())
    }

    /// What is known of a cell from before, of those that were made ready.
    pub fn known(&self, cell: Cell) -> Option<Verdict> {
        let (column, row) = cell.of_plane(&self.plane)?;
        self.known.as_ref()?.at(column, row)
    }

    /// What is to be followed at a cell, or where it would begin beyond a stop; none where there is no such system.
    pub fn job(&self, cell: Cell) -> Option<Begun> {
        let [x, y] = self.values(cell);
        self.job_at(x, y)
    }

    /// The plane of the one cell at two values of the axes; none where they are out of range.
    pub fn alone(&self, x: f64, y: f64) -> Option<Plane> {
        let one = |axis: &Axis, value: f64| {
            Axis::spaced(axis.quantity, value, value, 1, axis.spacing).ok().filter(|_| value.is_finite())
        };
        Some(Plane { x: one(&self.plane.x, x)?, y: one(&self.plane.y, y)?, ..self.plane.clone() })
    }

    /// What is to be followed at two values of the axes, or where it would begin beyond a stop; none where there is no such system.
    pub fn job_at(&self, x: f64, y: f64) -> Option<Begun> {
        let plane = self.alone(x, y)?;
        let system = System::new(plane.parameters_at(0, 0)).ok()?;
        let start = plane.start_at(0, 0).begun(&system);
        Some(start.map(|start| Job { start, system }))
    }

    /// Why there is no system at two values of the axes that are in range, or it does not begin there; none where it does.
    pub fn missing(&self, x: f64, y: f64) -> Option<String> {
        let plane = self.alone(x, y)?;
        let family = plane.parameters.family();
        match System::new(plane.parameters_at(0, 0)) {
            Ok(system) => {
                plane.start_at(0, 0).check(system.plant(), family).err().map(|error| error.to_string())
            }
            Err(error) => Some(error.to_string()),
        }
    }

    /// The numbers of the motions of some cells.
    pub fn numbered(&self, cells: &[Option<Verdict>]) -> Vec<u16> {
        let mut motions = self.motions.lock();
        let number = |cell: &Option<Verdict>| {
            let Some(verdict) = cell else { return super::tile::NOWHERE };
            let motion = Motion::of(verdict);
            if let Some(&number) = motions.numbers.get(&motion) {
                return number;
            }
            let number = motions.examples.len().min(limits::MOTIONS) as u16;
            if usize::from(number) == motions.examples.len() {
                motions.examples.push(*verdict);
            }
            motions.numbers.insert(motion, number);
            number
        };
        cells.iter().map(number).collect()
    }

    /// An example of every motion from a number on.
    pub fn motions_from(&self, first: usize) -> Vec<Verdict> {
        let motions = self.motions.lock();
        motions.examples.get(first..).map(<[Verdict]>::to_vec).unwrap_or_default()
    }

    /// An example of a motion.
    pub fn motion(&self, number: u16) -> Option<Verdict> {
        let motions = self.motions.lock();
        motions.examples.get(usize::from(number)).copied()
    }
}
