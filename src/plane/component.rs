//! The components of a state.

use crate::model::vector::MOST;

/// A component of a state at forcing phase 0, of the start or of the end; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Component {
    coordinates: usize,
    index: usize,
}

/// The names of displacements and of velocities.
const NAMES: [[&str; MOST]; 2] = [["x1", "x2", "x3", "x4"], ["v1", "v2", "v3", "v4"]];

impl Component {
    /// Every component, in the order of a state (x1 … xn, v1 … vn).
    pub fn all(coordinates: usize) -> impl Iterator<Item = Component> {
        (0..2 * coordinates).map(move |index| Component { coordinates, index })
    }

    /// The component of a name, if there is one.
    pub fn named(name: &str, coordinates: usize) -> Option<Component> {
        Component::all(coordinates).find(|component| component.name() == name)
    }

    /// How many coordinates the systems have of whose states it is one.
    pub fn coordinates(self) -> usize {
        self.coordinates
    }

    /// The name used on the command line and in files: x1 … xn, v1 … vn.
    pub fn name(self) -> &'static str {
        NAMES[usize::from(self.is_velocity())][self.coordinate()]
    }

    /// Whether it is a velocity.
    pub fn is_velocity(self) -> bool {
        self.index >= self.coordinates
    }

    /// Which coordinate it belongs to, counted from 0.
    pub fn coordinate(self) -> usize {
        self.index % self.coordinates
    }

    /// Where the component stands in a state.
    pub fn index(self) -> usize {
        self.index
    }
}
