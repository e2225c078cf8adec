//! What contacts that hold take from accelerations and their derivatives.

use super::stop::Contact;
use crate::model::vector::{MOST, axpy, dot};
use crate::model::{Flight, Real};

/// Accelerations (or their derivatives) with what the contacts that hold take from them, and what presses on each.
#[inline(always)]
pub fn held<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    contact: Contact,
    free: [T; N],
) -> ([T; N], [T; MOST]) {
    let mut pressing = [T::zero(); MOST];
    if contact.is_free() {
        return (free, pressing);
    }
    let matrix = &flight.pressing[contact.held() as usize];
    for (t, normal) in flight.normals().iter().enumerate() {
        let along = dot(&normal.direction, &free);
        for s in 0..flight.count {
            pressing[s] = pressing[s] + matrix[s][t] * along;
        }
    }
    let mut rest = free;
    for (s, normal) in flight.normals().iter().enumerate() {
        rest = axpy(-pressing[s], &normal.response, &rest);
    }
    (rest, pressing)
}

/// What the contacts that hold spare of accelerations, or of what adds up to them: nothing where there are as many as coordinates.
#[inline(always)]
pub fn spared<T: Real, const N: usize>(flight: &Flight<T, N>, contact: Contact, free: [T; N]) -> [T; N] {
    if contact.held().count_ones() as usize == N { [T::zero(); N] } else { held(flight, contact, free).0 }
}
