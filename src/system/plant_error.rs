//! Why the numbers of a cell were refused.

use thiserror::Error;

use super::limits::{
    FARTHEST_STOP, LEAST_CONDITION, LONGEST_DIRECTION, MOST_COORDINATES, MOST_STOPS, SHORTEST_DIRECTION,
};
use super::number::Number;

/// A part of a plant, as the file names it; stops count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// ω.
    Frequency,
    /// M.
    Mass,
    /// C.
    Damping,
    /// K.
    Stiffness,
    /// The amplitudes of sin ωt.
    ForceSin,
    /// The amplitudes of cos ωt.
    ForceCos,
    /// The constant load.
    Load,
    /// The direction of a stop.
    Direction(usize),
    /// The gap of a stop.
    Gap(usize),
    /// The coefficient of restitution of a stop.
    Restitution(usize),
}

impl Part {
    /// The key in a family's file; stops are counted from 1 there.
    pub fn key(self) -> String {
        match self {
            Part::Frequency => "system.frequency".to_owned(),
            Part::Mass => "system.mass".to_owned(),
            Part::Damping => "system.damping".to_owned(),
            Part::Stiffness => "system.stiffness".to_owned(),
            Part::ForceSin => "system.force_sin".to_owned(),
            Part::ForceCos => "system.force_cos".to_owned(),
            Part::Load => "system.load".to_owned(),
            Part::Direction(stop) => format!("stop[{}].direction", stop + 1),
            Part::Gap(stop) => format!("stop[{}].gap", stop + 1),
            Part::Restitution(stop) => format!("stop[{}].restitution", stop + 1),
        }
    }
}

/// Why a plant was refused; stops count from 0 in the fields and from 1 in the messages.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlantError {
    /// None, or too many, coordinates.
    #[error("{0} coordinates: a system has 1 to {most}", most = MOST_COORDINATES)]
    Coordinates(usize),
    /// None, or too many, stops.
    #[error("{0} stops: a system has 1 to {most}", most = MOST_STOPS)]
    Stops(usize),
    /// A matrix or a vector of the wrong shape.
    #[error("{key} is {rows} × {columns}, it must be {} × {}", wanted.0, wanted.1, key = part.key())]
    Shape {
        /// What has it.
        part: Part,
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
        /// The rows and columns that it must have.
        wanted: (usize, usize),
    },
    /// A number that is not finite.
    #[error("{key} holds {value}, it must be finite", key = part.key())]
    NotFinite {
        /// What holds it.
        part: Part,
        /// The number.
        value: f64,
    },
    /// ω is not positive.
    #[error("the frequency is {0}, it must be greater than 0")]
    Frequency(f64),
    /// M has no inverse, or rounding would spoil it; with its reciprocal condition, rows and columns brought to the same size.
    #[error(
        "the mass matrix is singular (reciprocal condition {0:.1e}, at least {least:.0e} is needed): every \
         coordinate needs a mass of its own, so give it one or leave the coordinate out",
        least = LEAST_CONDITION
    )]
    SingularMass(f64),
    /// M⁻¹ is too large for a number.
    #[error("the mass matrix is so small that its inverse is no number: give every coordinate a larger mass")]
    LightMass,
    /// M is symmetric and not positive definite; with its least eigenvalue.
    #[error(
        "the mass matrix is not positive definite (its least eigenvalue is {}): some motion would have a kinetic energy below \
         zero; check the signs of its entries",
        Number(*.0)
    )]
    IndefiniteMass(f64),
    /// A coefficient of restitution outside [0, 1].
    #[error("the restitution of stop {} is {value}, it must be between 0 and 1, ends included", stop + 1)]
    Restitution {
        /// The stop.
        stop: usize,
        /// The coefficient.
        value: f64,
    },
    /// A direction that is zero.
    #[error("the direction of stop {} is zero: at least one component must differ from 0", .0 + 1)]
    NoDirection(usize),
    /// A direction too short or too long for its squares.
    #[error(
        "the direction of stop {} has length {length:e}: give it one between {SHORTEST_DIRECTION:e} and \
         {LONGEST_DIRECTION:e}, about 1 if possible, and scale its gap alike",
        stop + 1
    )]
    DirectionLength {
        /// The stop.
        stop: usize,
        /// The length of its direction.
        length: f64,
    },
    /// A stop too far away.
    #[error(
        "the gap of stop {} is {}, which is out of all motion's reach: it must be between -{FARTHEST_STOP:e} and \
         {FARTHEST_STOP:e} for a direction of length 1; leave out a stop that is never met",
        stop + 1,
        Number(*value)
    )]
    TooFar {
        /// The stop.
        stop: usize,
        /// Its gap.
        value: f64,
    },
    /// dᵀM⁻¹d is not positive.
    #[error(
        "dᵀM⁻¹d = {value} for the direction d of stop {}, so that an impact could not turn it back: it must be \
         greater than 0; a positive definite mass matrix makes it so",
        stop + 1
    )]
    NoImpulse {
        /// The stop.
        stop: usize,
        /// dᵀM⁻¹d.
        value: f64,
    },
    /// Two stops on the same side of the same line.
    #[error(
        "stops {} and {} stand on the same side of the same line, so that one of them could never be touched: keep \
         the nearer one",
        first + 1,
        second + 1
    )]
    SameSide {
        /// One of the two stops.
        first: usize,
        /// The other stop.
        second: usize,
    },
    /// Two opposed stops that overlap.
    #[error(
        "no state satisfies the gaps of stops {} and {}, which face each other and overlap by {overlap} along their line: their sum \
         must be 0 or greater",
        first + 1,
        second + 1
    )]
    NoRoom {
        /// One of the two stops.
        first: usize,
        /// The other stop.
        second: usize,
        /// How far they overlap, along the unit direction.
        overlap: f64,
    },
    /// Directions that are linearly dependent without being parallel.
    #[error(
        "the direction of stop {} is a combination of those of the stops before it without being parallel to one of \
         them: contacts at once would not determine their forces, which is out of reach in this version",
        .0 + 1
    )]
    Dependent(usize),
}

impl PlantError {
    /// The parts that are at fault together, the one to blame first.
    pub fn parts(&self) -> Vec<Part> {
        match *self {
            PlantError::Coordinates(_)
            | PlantError::SingularMass(_)
            | PlantError::LightMass
            | PlantError::IndefiniteMass(_) => {
                vec![Part::Mass]
            }
            PlantError::Stops(_) => Vec::new(),
            PlantError::Shape { part, .. } | PlantError::NotFinite { part, .. } => vec![part],
            PlantError::Frequency(_) => vec![Part::Frequency],
            PlantError::Restitution { stop, .. } => vec![Part::Restitution(stop)],
            PlantError::NoDirection(stop) | PlantError::DirectionLength { stop, .. } => {
                vec![Part::Direction(stop)]
            }
            PlantError::TooFar { stop, .. } => vec![Part::Gap(stop), Part::Direction(stop)],
            PlantError::NoImpulse { stop, .. } => vec![Part::Direction(stop), Part::Mass],
            PlantError::SameSide { first, second } => vec![Part::Direction(second), Part::Direction(first)],
            PlantError::NoRoom { first, second, .. } => {
                vec![Part::Gap(second), Part::Gap(first), Part::Direction(second), Part::Direction(first)]
            }
            PlantError::Dependent(stop) => (0..=stop).rev().map(Part::Direction).collect(),
        }
    }
}
