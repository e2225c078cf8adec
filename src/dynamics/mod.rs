//! Motion: flight, impact, chatter, sticking. No I/O, no threads.
//!
//! Impacts at one instant happen one after the other: of the stops that are touched and run into, the first in the order of
//! contact normals (that of their first stops in the plant) and of their ends (first the one met along the first stop's
//! direction). A contact that an impact elsewhere drives into its stop is an impact at the same instant; one that it pulls
//! off opens. Impacts whose directions are perpendicular in the metric of M⁻¹ commute. Impacts that throw the masses from one
//! stop to the other, infinitely many in finite time, end with the masses at rest on all of these stops.

mod abreast;
mod advance;
mod along;
mod chatter;
mod clear;
mod clock;
mod closing;
mod contact;
mod corner;
mod course;
mod crossing;
mod event_code;
#[cfg(test)]
mod example;
mod face;
mod given_up;
mod gliding;
mod held;
mod holding;
mod hull;
mod imminent;
mod leg;
mod meeting;
mod moments;
mod moves;
mod passing;
mod placing;
mod point;
mod pressing;
mod quintic;
mod recording;
mod rounds;
mod series;
mod squeeze;
mod sticking;
mod stop;
mod striking;
#[cfg(test)]
mod swing;
mod tally;
mod tangent;
mod touching;
mod trajectory;
mod usage;

pub use abreast::Abreast;
pub use contact::holds;
pub(crate) use event_code::EventCode;
pub use given_up::GivenUp;
pub(crate) use moments::Moments;
pub(crate) use moves::Moves;
pub(crate) use passing::{Scattering, Unseen};
pub use point::{Motion, Point};
pub use recording::{ImpactEvent, Recording, Sample, Stick, record};
pub use stop::{Contact, End, Stop};
pub(crate) use striking::{energy_taken, taken_by_clamps};
pub(crate) use tally::Tally;
pub(crate) use tangent::catch_all;
pub use tangent::{Saltation, Tangent};
pub use trajectory::{Event, Impact, Move, Trajectory};
pub use usage::Usage;

/// The numbers that the GPU's shaders share.
pub(crate) mod constants {
    pub use super::chatter::{FADING, NEARLY, PUSH, SLOW, STEADY};
    pub use super::clear::SHORT;
    pub use super::contact::{KICK_ROUNDINGS, ROUNDINGS, WIDENING};
    pub use super::corner::HOPS;
    pub use super::crossing::{EXACT, WIDER};
    pub use super::holding::{HELD_FLIGHTS, SEEN};
    pub use super::hull::SWELLING;
    pub use super::moves::{FAIR_MOVES, MOST_MOVES};
    pub use super::pressing::LOST;
    pub use super::quintic::{ASIDE, STEPS as NEWTON_STEPS};
    pub use super::series::INVERSE_FACTORIALS;
    pub use super::squeeze::SQUEEZES;
    pub use super::tangent::{LONG_SQUARE, SHORT_SQUARE};
    pub use super::trajectory::MOST_KICKS;
    pub use crate::model::FAR;
}
