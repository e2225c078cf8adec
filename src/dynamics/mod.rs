//! Motion: flight, impact, chatter, sticking. No I/O, no threads.

mod chatter;
mod contact;
mod drive;
mod point;
mod recording;
mod series;
mod tangent;
mod trajectory;

pub use drive::{Drive, DriveSeries, Phasor};
pub use point::Point;
pub use recording::{GivenUp, ImpactEvent, Recording, Sample, Stick, record};
pub use tangent::{Tangent, Variation};
pub use trajectory::{Contact, Event, Impact, Move, Stop, Trajectory};

/// The numbers that the GPU's shaders share.
pub(crate) mod constants {
    pub use super::chatter::{DRAGGED, SLOW, STEADY};
    pub use super::contact::{FAR, HERMITE, WIDENING};
    pub use super::series::INVERSE_FACTORIALS;
    pub use super::trajectory::{MOST_KICKS, MOST_MOVES};
}
