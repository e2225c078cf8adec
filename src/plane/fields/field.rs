//! A field: one number, or a few, of every cell, with its name, its meaning and how it is drawn.

use derive_more::Debug;

use super::cell::CellResult;
use super::values::{Kind, Values};
use crate::figure::Spread;
use crate::plane::spec::Plane;
use crate::system::Family;

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
#[derive(Clone, Copy, Debug)]
#[debug("{name}")]
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
    pub(super) source: Source,
}

impl PartialEq for CellField {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl CellField {
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

    /// Whether a plane that has so much beyond verdicts has it.
    pub fn is_with(&self, extras: Extras) -> bool {
        (extras.certified || !self.needs.certified) && (extras.extents || !self.needs.extents)
    }

    /// The sizes of its array over a whole plane.
    pub fn shape<T>(&self, plane: &Plane<T>) -> Vec<u64> {
        let inner = self.inner.dimensions(plane.parameters.family()).into_iter().map(|(_, size)| size as u64);
        [plane.y.count.into(), plane.x.count.into()].into_iter().chain(inner).collect()
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
