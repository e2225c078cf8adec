//! States moved onto the stops that they rest on, or that they have reached, against the rounding of flights.

use super::along::Along;
use super::stop::{Contact, End};
use crate::model::vector::{MOST, axpy, dot};
use crate::model::{ContactNormal, Flight, Real, State};

/// A state moved to where it is to be along a normal, along the response of that.
#[inline(always)]
pub fn placed<T: Real, const N: usize>(
    normal: &ContactNormal<T, N>,
    state: &State<T, N>,
    Along { place, speed }: Along<T>,
) -> State<T, N> {
    let away = place - dot(&normal.direction, &state.x);
    let change = speed - dot(&normal.direction, &state.v);
    State { x: axpy(away, &normal.response, &state.x), v: axpy(change, &normal.response, &state.v) }
}

/// A state moved onto a stop, with the given speed along its normal.
#[inline(always)]
pub fn placed_on<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    state: &State<T, N>,
    end: End,
    speed: T,
) -> State<T, N> {
    let normal = &flight.normals[end.normal];
    placed(normal, state, Along { place: end.sign::<T>() * normal.gap[end.side], speed })
}

/// A state moved onto all stops on which masses rest, at rest there: along the responses of their normals, together.
#[inline(always)]
pub fn rested<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    state: &State<T, N>,
    contact: Contact,
) -> State<T, N> {
    if contact.is_free() {
        return *state;
    }
    let matrix = &flight.pressing[contact.held() as usize];
    let mut away = [[T::zero(); 2]; MOST];
    for (t, normal) in flight.normals().iter().enumerate() {
        let Some(end) = contact.end_along(t) else { continue };
        let place = end.sign::<T>() * normal.gap[end.side];
        let off = [place - dot(&normal.direction, &state.x), -dot(&normal.direction, &state.v)];
        for s in 0..flight.count {
            for i in 0..2 {
                away[s][i] = away[s][i] + matrix[s][t] * off[i];
            }
        }
    }
    let mut rested = *state;
    for (normal, [x, v]) in flight.normals().iter().zip(away) {
        rested.x = axpy(x, &normal.response, &rested.x);
        rested.v = axpy(v, &normal.response, &rested.v);
    }
    rested
}

/// The contacts that hold for ever: normals between whose stops there is no room.
#[inline(always)]
pub fn clamped<T: Real, const N: usize>(flight: &Flight<T, N>) -> Contact {
    let mut contact = Contact::FREE;
    for (k, normal) in flight.normals().iter().enumerate() {
        if normal.gap[0] + normal.gap[1] == T::zero() {
            contact = contact.clamped(k);
        }
    }
    contact
}
