//! Layers: what of a plane is drawn.

use thiserror::Error;

use super::{CELL_FIELDS, CellField, CellResult, Cells, CellsError, Drawn, Extras, Inner};
use crate::plane::component::Component;
use crate::plane::window::Window;
use crate::system::Family;

/// What of every cell is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layer {
    /// The motions, by their colours.
    Motion,
    /// A field that has a number for every cell, by a colour bar.
    Number {
        /// The field.
        field: &'static CellField,
        /// How it is drawn.
        drawn: Drawn,
        /// Which of a cell's values.
        index: usize,
        /// The coordinate it is about, if there is one for each.
        coordinate: Option<Component>,
    },
}

impl Layer {
    /// The name of the layer of motions.
    pub const MOTION: &str = "motion";

    /// Every layer of a family's planes.
    pub fn all(family: &Family) -> Vec<Layer> {
        let mut layers = vec![Layer::Motion];
        for field in CELL_FIELDS {
            let Some(drawn) = field.drawn else { continue };
            let of = |index, coordinate| Layer::Number { field, drawn, index, coordinate };
            match field.inner {
                Inner::Coordinates => layers.extend(
                    Component::all(family.n()).take(family.n()).enumerate().map(|(i, x)| of(i, Some(x))),
                ),
                _ => layers.push(of(0, None)),
            }
        }
        layers
    }

    /// The layer of a name.
    ///
    /// # Errors
    /// [`LayerError`] with the names that there are.
    pub fn named(name: &str, family: &Family) -> Result<Self, LayerError> {
        let layers = Layer::all(family);
        layers.iter().find(|layer| layer.name() == name).copied().ok_or_else(|| {
            let known: Vec<String> = layers.iter().map(Layer::name).collect();
            LayerError { name: name.to_owned(), known: known.join(", ") }
        })
    }

    /// The name on the command line and in files: that of the field, with the coordinate where there is one for each.
    pub fn name(&self) -> String {
        match self {
            Layer::Motion => Self::MOTION.to_owned(),
            Layer::Number { field, coordinate: None, .. } => field.name.to_owned(),
            Layer::Number { field, coordinate: Some(x), .. } => format!("{}.{}", field.name, x.name()),
        }
    }

    /// Whether a plane that has so much beyond verdicts has the layer.
    pub fn is_with(&self, extras: Extras) -> bool {
        match self {
            Layer::Motion => true,
            Layer::Number { field, .. } => field.is_with(extras),
        }
    }

    /// The numbers of some cells: NaN where there is none, infinities as they are.
    ///
    /// # Panics
    /// For the layer of motions, which has no numbers.
    pub fn numbers<'a>(&self, cells: impl Iterator<Item = CellResult<'a>>, family: &Family) -> Vec<f32> {
        let Layer::Number { field, drawn, index, .. } = self else { panic!("motions are no numbers") };
        let inner = field.inner.len(family);
        let values = field.values(cells, inner);
        let value = |cell: usize| {
            let value = values.real(cell * inner + index);
            if drawn.sentinel == Some(value) { f32::NAN } else { value as f32 }
        };
        (0..values.len() / inner).map(value).collect()
    }

    /// The values of the cells of a window, row by row: NaN where there is none, infinities as they are.
    ///
    /// # Errors
    /// What could not be read.
    ///
    /// # Panics
    /// For the layer of motions, which has no numbers.
    pub fn values(&self, cells: &dyn Cells, window: Window) -> Result<Vec<f32>, CellsError> {
        let Layer::Number { field, drawn, index, .. } = self else { panic!("motions are no numbers") };
        let inner = field.inner.len(cells.plane().parameters.family());
        let values = cells.read(field, window)?;
        let there = cells.read(&CELL_FIELDS[0], window)?;
        let value = |cell: usize| {
            let value = values.real(cell * inner + index);
            let none = drawn.sentinel == Some(value) || there.whole(cell) == u32::from(super::NOT_COMPUTED);
            if none { f32::NAN } else { value as f32 }
        };
        Ok((0..window.cells()).map(value).collect())
    }
}

/// A layer that there is not.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no layer `{name}`: choose {known}")]
pub struct LayerError {
    /// What was asked for.
    pub name: String,
    /// The layers that there are.
    pub known: String,
}
