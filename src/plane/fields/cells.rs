//! Where the fields of cells are read.

use thiserror::Error;

use super::cell::CellResult;
use super::field::{CellField, Extras};
use super::values::Values;
use crate::plane::region_map::RegionMap;
use crate::plane::spec::Plane;
use crate::plane::task::Task;
use crate::plane::window::Window;

/// Where the fields of a plane's cells can be read: a map in memory, or a store of which some tiles are there.
pub trait Cells: Sync {
    /// The plane, whatever was asked of it.
    fn plane(&self) -> Plane<()>;

    /// The configuration that made it, as files carry it.
    fn configuration(&self) -> serde_json::Value;

    /// What its cells have beyond their verdicts.
    fn extras(&self) -> Extras;

    /// A field of the cells of a window, row by row; of a cell that is not there, the field's own value for that.
    ///
    /// # Errors
    /// What could not be read.
    fn read(&self, field: &'static CellField, window: Window) -> Result<Values, CellsError>;

    /// The rows that are best read together.
    fn band(&self) -> u32 {
        256
    }
}

/// Why a field could not be read.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct CellsError(pub String);

impl<T: Task> Cells for RegionMap<T> {
    fn plane(&self) -> Plane<()> {
        self.plane.asking(())
    }

    fn configuration(&self) -> serde_json::Value {
        RegionMap::configuration(self)
    }

    fn extras(&self) -> Extras {
        Extras { certified: self.multipliers.is_some(), extents: self.extents.is_some() }
    }

    fn read(&self, field: &'static CellField, window: Window) -> Result<Values, CellsError> {
        let inner = field.inner.len(self.plane.parameters.family());
        let whole = Window::whole(&self.plane);
        let cells = window.places().map(|place| {
            let (multipliers, extents) = (self.multipliers.as_deref(), self.extents.as_deref());
            CellResult::of(whole.index(place), &self.verdicts, multipliers, extents)
        });
        Ok(field.values(cells, inner))
    }
}
