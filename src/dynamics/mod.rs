//! Motion: flight, impact, chatter, sticking. No I/O, no threads.

mod chatter;
mod contact;
mod drive;
mod point;
mod recording;
mod series;
mod stop;
mod tangent;
mod trajectory;

pub use drive::{Drive, DriveSeries, Phasor};
pub use point::{Motion, Point};
pub use recording::{GivenUp, ImpactEvent, Recording, Sample, Stick, record, resting_on};
pub use stop::{Contact, End, Stop};
pub use tangent::{Saltation, Tangent, Variation};
pub use trajectory::{Event, Impact, Move, Trajectory};

/// The numbers that the GPU's shaders share.
pub(crate) mod constants {
    pub use super::chatter::{DRAGGED, SLOW, STEADY};
    pub use super::contact::{HERMITE, WIDENING};
    pub use super::series::INVERSE_FACTORIALS;
    pub use super::trajectory::{MOST_KICKS, MOST_MOVES};
    pub use crate::model::FAR;
}
