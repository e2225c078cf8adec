//! What is known of every cell of a plane: one table, from which files, layers and their documentation follow.

mod assemble;
mod layer;
mod table;
mod thinned;
mod values;

use thiserror::Error;

use super::region_map::{Multipliers, RegionMap};
use super::spec::Plane;
use super::window::Window;
use crate::analysis::{Extent, Verdict};
use crate::system::Family;

pub use assemble::{Assembled, assembled};
pub use layer::{Layer, LayerError};
pub use table::{CELL_FIELDS, NOT_COMPUTED};
pub use thinned::thinned;
pub use values::{Kind, Values};

/// What is known of one cell.
#[derive(Clone, Copy, Debug)]
pub struct CellResult<'a> {
    /// What became of its trajectory.
    pub verdict: &'a Verdict,
    /// The multipliers of its exact orbit; none where none was certified.
    pub multipliers: Option<&'a Multipliers>,
    /// How far its motion goes; none where that was not measured.
    pub extent: Option<&'a Extent>,
}

impl<'a> CellResult<'a> {
    /// Cell `i` of some results, with what there is beyond verdicts.
    pub fn of(
        i: usize,
        verdicts: &'a [Verdict],
        multipliers: Option<&'a [Option<Multipliers>]>,
        extents: Option<&'a [Extent]>,
    ) -> Self {
        CellResult {
            verdict: &verdicts[i],
            multipliers: multipliers.and_then(|all| all[i].as_ref()),
            extent: extents.map(|all| &all[i]),
        }
    }
}

/// What a field has of every cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inner {
    /// One value.
    One,
    /// One for every stop, in the order of labels.
    Stops,
    /// One for every component of the state (x1 … xn, v1 … vn).
    Components,
    /// One for every coordinate x1 … xn.
    Coordinates,
    /// Real and imaginary part of every multiplier.
    Multipliers,
}

impl Inner {
    /// The sizes beyond rows and columns, by name.
    pub fn dimensions(self, family: &Family) -> Vec<(&'static str, usize)> {
        match self {
            Inner::One => Vec::new(),
            Inner::Stops => vec![("stop", family.stops().len())],
            Inner::Components => vec![("component", 2 * family.n())],
            Inner::Coordinates => vec![("coordinate", family.n())],
            Inner::Multipliers => vec![("multiplier", 2 * family.n()), ("part", 2)],
        }
    }

    /// How many values a cell has.
    pub fn len(self, family: &Family) -> usize {
        self.dimensions(family).iter().map(|(_, size)| size).product()
    }
}

/// How a colour bar spreads the values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// By equal differences.
    Even,
    /// By equal ratios; what is not above zero has no place on it.
    Ratios,
    /// By equal differences to either side of zero.
    AboutZero,
}

/// How a field is drawn as a layer. A cell of a picture that covers many cells of the plane shows their mean, over those
/// that have a value; none if most have not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// How its colour bar is spread.
    pub spread: Spread,
    /// The value, beside NaN, that stands for there being none.
    pub sentinel: Option<f64>,
    /// What a cell without a value is called in the key.
    pub undefined: &'static str,
    /// What a cell is called whose value is minus infinity.
    pub lost: &'static str,
}

/// Where a field's values come from.
#[derive(Clone, Copy)]
pub(super) enum Source {
    U8(fn(&CellResult) -> u8),
    U16(fn(&CellResult, usize) -> u16),
    U32(fn(&CellResult) -> u32),
    F32(fn(&CellResult, usize) -> f32),
    F64(fn(&CellResult, usize) -> f64),
}

/// What a plane's cells have beyond their verdicts, where it was asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extras {
    /// Periodic cells are certified, and have multipliers.
    pub certified: bool,
    /// The root mean square and the peak of every coordinate are measured.
    pub extents: bool,
}

impl Extras {
    /// None.
    pub const NONE: Extras = Extras { certified: false, extents: false };
}

/// A field: one array of a file, of the shape rows, columns, and whatever [`Inner`] adds.
#[derive(Clone, Copy)]
pub struct CellField {
    /// The name in files, and of the layer.
    pub name: &'static str,
    /// What a colour bar says.
    pub title: &'static str,
    /// What a cell has of it.
    pub inner: Inner,
    /// The unit; empty for what has none, 1 for what is non-dimensional.
    pub unit: &'static str,
    /// What it is, and what its special values mean.
    pub meaning: &'static str,
    /// What a plane must have beyond verdicts to have it.
    pub needs: Extras,
    /// How it is drawn, if it is a layer.
    pub drawn: Option<Drawn>,
    source: Source,
}

impl std::fmt::Debug for CellField {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for CellField {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl CellField {
    /// The field of a name.
    pub fn named(name: &str) -> Option<&'static CellField> {
        CELL_FIELDS.iter().find(|field| field.name == name)
    }

    /// The type of its values.
    pub fn kind(&self) -> Kind {
        match self.source {
            Source::U8(_) => Kind::U8,
            Source::U16(_) => Kind::U16,
            Source::U32(_) => Kind::U32,
            Source::F32(_) => Kind::F32,
            Source::F64(_) => Kind::F64,
        }
    }

    /// The fields that a plane has.
    pub fn of_plane(extras: Extras) -> impl Iterator<Item = &'static CellField> {
        CELL_FIELDS.iter().filter(move |field| field.is_with(extras))
    }

    /// Whether a plane that has so much beyond verdicts has it.
    pub fn is_with(&self, extras: Extras) -> bool {
        (extras.certified || !self.needs.certified) && (extras.extents || !self.needs.extents)
    }

    /// The values of some cells, `inner` of them each.
    pub fn values<'a>(&self, cells: impl Iterator<Item = CellResult<'a>>, inner: usize) -> Values {
        let cells = cells.flat_map(|cell| (0..inner).map(move |i| (cell, i)));
        match self.source {
            Source::U8(get) => Values::U8(cells.map(|(cell, _)| get(&cell)).collect()),
            Source::U16(get) => Values::U16(cells.map(|(cell, i)| get(&cell, i)).collect()),
            Source::U32(get) => Values::U32(cells.map(|(cell, _)| get(&cell)).collect()),
            Source::F32(get) => Values::F32(cells.map(|(cell, i)| get(&cell, i)).collect()),
            Source::F64(get) => Values::F64(cells.map(|(cell, i)| get(&cell, i)).collect()),
        }
    }
}

/// Where the fields of a plane's cells can be read: a map in memory, or a store of which some tiles are there.
pub trait Cells: Sync {
    /// The plane.
    fn plane(&self) -> &Plane;

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

impl Cells for RegionMap {
    fn plane(&self) -> &Plane {
        &self.plane
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_field_comes_twice() {
        for (i, field) in CELL_FIELDS.iter().enumerate() {
            assert!(CELL_FIELDS[..i].iter().all(|other| other.name != field.name), "{}", field.name);
            assert!(field.meaning.len() > 10 && !field.title.is_empty());
            // Which cells are there is told by the regime, which is the last field of a tile to appear.
            assert_eq!(field.name == "regime", i == 0);
        }
    }
}
