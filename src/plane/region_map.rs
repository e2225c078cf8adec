//! A computed plane: one verdict per cell, and where it came from.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::spec::Plane;
use super::task::{Reached, Task};
use crate::analysis::{Extent, Regime, Schedule};

/// What computed a result.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// The version of this crate.
    pub version: String,
    /// "cpu" or "gpu".
    pub backend: String,
    /// The adapter's or the processor path's description.
    pub adapter: String,
}

impl Provenance {
    /// The configuration that files carry: what was asked, and what computed it.
    ///
    /// # Panics
    /// If what was asked is not plain data.
    pub fn configuration(&self, asked: &impl Serialize) -> Value {
        #[derive(Serialize)]
        struct Configuration<'a, S> {
            #[serde(flatten)]
            provenance: &'a Provenance,
            #[serde(flatten)]
            asked: &'a S,
        }
        serde_json::to_value(Configuration { provenance: self, asked }).expect("what was asked is plain data")
    }
}

/// The configuration that a map's files carry, as far as it says what was computed.
#[derive(Clone, Debug, Deserialize)]
pub struct Made {
    /// The plane.
    #[serde(flatten)]
    pub plane: Plane,
    /// What computed it.
    #[serde(flatten)]
    pub provenance: Provenance,
    /// Whether its periodic cells were certified.
    #[serde(default)]
    pub certified: bool,
    /// Whether the root mean squares and the peaks of its coordinates were measured.
    #[serde(default)]
    pub extents: bool,
}

/// (re, im) of the 2n Floquet multipliers of a periodic motion, largest modulus first; fewer where it may drift.
pub type Multipliers = Vec<[f64; 2]>;

/// A computed plane.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionMap<T: Task = Schedule> {
    /// What was asked.
    pub plane: Plane<T>,
    /// What computed it.
    pub provenance: Provenance,
    /// What came out of each cell, row by row, first row = first y value.
    pub verdicts: Vec<T::Cell>,
    /// Where the map was certified, the multipliers of each cell's exact orbit; none for a cell that has no such orbit.
    pub multipliers: Option<Vec<Option<Multipliers>>>,
    /// Where they were measured, the root mean squares and the peaks of each cell's coordinates.
    pub extents: Option<Vec<Extent>>,
}

impl<T: Task> RegionMap<T> {
    /// What came out of each cell of a plane, and nothing beyond.
    pub fn new(plane: Plane<T>, provenance: Provenance, verdicts: Vec<T::Cell>) -> Self {
        RegionMap { plane, provenance, verdicts, multipliers: None, extents: None }
    }

    /// What came out of the cell in column `column` of row `row`.
    pub fn at(&self, column: u32, row: u32) -> &T::Cell {
        assert!(column < self.plane.x.count, "column {column} of {}", self.plane.x.count);
        &self.verdicts[row as usize * self.plane.x.count as usize + column as usize]
    }

    /// Whether systems of the plane have a mirror: that in the middle, or one of a motion that is symmetric.
    pub fn has_mirror(&self) -> bool {
        self.plane.has_mirror() || self.verdicts.iter().any(|cell| cell.verdict().symmetric)
    }

    /// How many cells are in each regime, in the order of [`Regime::ALL`].
    pub fn census(&self) -> [(Regime, u64); Regime::ALL.len()] {
        let cells = |regime| self.verdicts.iter().filter(|cell| cell.verdict().regime == regime).count();
        Regime::ALL.map(|regime| (regime, cells(regime) as u64))
    }

    /// The configuration text that files carry: the plane and its provenance, as JSON.
    pub fn config(&self) -> String {
        self.configuration().to_string()
    }

    pub(super) fn configuration(&self) -> Value {
        let mut configuration = self.provenance.configuration(&self.plane);
        if self.multipliers.is_some() {
            configuration["certified"] = true.into();
        }
        if self.extents.is_some() {
            configuration["extents"] = true.into();
        }
        configuration
    }

    /// The same with something more that a file shows, under a name of its own.
    pub fn config_with(&self, name: &str, value: Value) -> String {
        let mut configuration = self.configuration();
        configuration[name] = value;
        configuration.to_string()
    }
}
