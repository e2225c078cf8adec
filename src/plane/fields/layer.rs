//! Layers: what of a plane is drawn.

use thiserror::Error;

use super::{
    CELL_FIELDS, CellField, CellResult, Cells, CellsError, Drawn, Extras, Inner, NOT_COMPUTED, Values,
};
use crate::analysis::Regime;
use crate::plane::component::Component;
use crate::plane::window::Window;
use crate::system::Family;

/// The codes of cells that have no numbers, whatever stands in their fields: nothing moved there, or has moved yet.
const WITHOUT: [u32; 2] = [NOT_COMPUTED as u32, Regime::Inadmissible.code() as u32];

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
        /// The component of a state that it is about, if there is one for each, or for each coordinate.
        component: Option<Component>,
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
            let of = |index, component| Layer::Number { field, drawn, index, component };
            let components =
                Component::all(family.n()).map(|component| of(component.index(), Some(component)));
            match field.inner {
                Inner::Components => layers.extend(components),
                Inner::Coordinates => layers.extend(components.take(family.n())),
                Inner::One | Inner::Stops | Inner::Multipliers => layers.push(of(0, None)),
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

    /// The name on the command line and in files: that of the field, with the component where there is one for each.
    pub fn name(&self) -> String {
        match self {
            Layer::Motion => Self::MOTION.to_owned(),
            Layer::Number { field, component: None, .. } => field.name.to_owned(),
            Layer::Number { field, component: Some(of), .. } => format!("{}.{}", field.name, of.name()),
        }
    }

    /// What a colour bar and a list of layers say.
    pub fn title(&self) -> String {
        match self {
            Layer::Motion => Self::MOTION.to_owned(),
            Layer::Number { field, component: None, .. } => field.title.to_owned(),
            Layer::Number { field, component: Some(of), .. } => match field.inner {
                Inner::Components => format!("{}, {}", field.title, of.name()),
                _ => format!("{} {}", field.title, of.name()),
            },
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
        let Layer::Number { field, .. } = self else { panic!("motions are no numbers") };
        let cells: Vec<CellResult> = cells.collect();
        let of = |field: &CellField| field.values(cells.iter().copied(), field.inner.len(family));
        self.drawn(&of(field), &of(&CELL_FIELDS[0]), family)
    }

    /// The values of the cells of a window, row by row: NaN where there is none, infinities as they are.
    ///
    /// # Errors
    /// What could not be read.
    ///
    /// # Panics
    /// For the layer of motions, which has no numbers.
    pub fn values(&self, cells: &dyn Cells, window: Window) -> Result<Vec<f32>, CellsError> {
        let Layer::Number { field, .. } = self else { panic!("motions are no numbers") };
        let (values, regimes) = (cells.read(field, window)?, cells.read(&CELL_FIELDS[0], window)?);
        Ok(self.drawn(&values, &regimes, cells.plane().parameters.family()))
    }

    /// The numbers that are drawn, of the values of the layer's field and the codes of the regimes.
    fn drawn(&self, values: &Values, regimes: &Values, family: &Family) -> Vec<f32> {
        let Layer::Number { field, drawn, index, .. } = self else { panic!("motions are no numbers") };
        let inner = field.inner.len(family);
        let value = |cell: usize| {
            let value = values.real(cell * inner + index);
            let none = drawn.sentinel == Some(value) || WITHOUT.contains(&regimes.whole(cell));
            if none { f32::NAN } else { value as f32 }
        };
        (0..regimes.len()).map(value).collect()
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
