//! What rebounds that are closed together do to the masses, and to a deviation.

use super::held::spared;
use super::stop::{Contact, End};
use super::tangent::Tangent;
use crate::model::vector::{added, applied, axpy, dot};
use crate::model::{Flight, Real, State};

/// Rebounds that are closed with an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing<T> {
    /// The stop.
    pub end: End,
    /// The speed off it, of the first.
    pub speed: T,
    /// What presses on the stop, as an acceleration towards it.
    pub force: T,
    /// ∫ gap dt over all of them; 0 where they are over at once.
    pub gap_integral: T,
}

/// By how much springs and dampers move the masses that are free with some contacts, and change their velocities, per ∫ gap dt of
/// rebounds off a stop along one of their normals.
#[inline(always)]
pub fn swayed<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    contact: Contact,
    normal: usize,
) -> State<T, N> {
    let response = &flight.normals[normal].response;
    let push = spared(flight, contact, applied(&flight.damping, response));
    let pull = added(&applied(&flight.stiffness, response), &applied(&flight.damping, &push));
    State { x: push, v: spared(flight, contact, pull) }
}

impl<T: Real, const N: usize> Tangent<T, N> {
    /// Just after rebounds that are closed, before their contact holds beside those that hold already.
    ///
    /// A deviation makes the first rebound faster, u² being (d·v)² with twice the gap times what presses, and changes what presses, a:
    /// ∫ gap dt, which goes with u³/a², grows by as much, and with it what the rebounds do to the other masses. What it has of a gap
    /// closes, and dampers push the other masses by as much.
    #[inline(always)]
    #[must_use]
    pub fn closed(&self, flight: &Flight<T, N>, contact: Contact, closing: &Closing<T>) -> Self {
        let Closing { end, speed, force, gap_integral } = *closing;
        let (direction, sign) = (&flight.normals[end.normal].direction, end.sign::<T>());
        let State { x, v } = &self.0;
        let pulled = added(&applied(&flight.stiffness, x), &applied(&flight.damping, v));
        let pressed = sign * dot(direction, &spared(flight, contact, pulled));
        let gap = dot(direction, x);
        let faster = -(sign * dot(direction, v)) - force * (sign * gap) / speed;
        let share = T::of(3.0) * faster / speed - (pressed + pressed) / force;
        // What is over at once may be pressed by nothing.
        let grows = if gap_integral > T::zero() { gap_integral * share } else { T::zero() };
        let signed = -(sign * grows);
        let swayed = swayed(flight, contact.with(end), end.normal);
        let pushed = axpy(-gap, &swayed.x, v);
        Tangent(State { x: axpy(signed, &swayed.x, x), v: axpy(signed, &swayed.v, &pushed) })
    }
}
