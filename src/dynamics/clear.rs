//! For how long a motion stays off the stops, bounded from what it is now: near an equilibrium all of it is far smaller than the
//! terms of the sums that bound it elsewhere.

use super::contact::{safe_time, safe_where_bounded};
use super::imminent::rests_at;
use super::point::{Motion, Point};
use super::stop::{Contact, End};
use crate::model::vector::{MOST, dot};
use crate::model::{Flight, Real, State, others};

/// Shorter times, as a share of a step, are asked for again.
pub const SHORT: f64 = 1.0 / 32.0;

/// A [`safe_time`] for the motion with the contacts that hold.
///
/// Where that is not all of the `window`, and [`SHORT`], it is asked again with a bound that shrinks as the motion does: a mass that
/// comes to rest where a stop is would move ever less at a time without. One that rests there is to be caught at once.
#[inline(always)]
pub fn clear_time<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    motion: &Motion<T, N>,
    [contact, ignored]: [Contact; 2],
    window: T,
) -> T {
    let safe = safe_time(flight, point, motion, ignored, window);
    if safe >= window || safe >= T::of(SHORT) * flight.h {
        return safe;
    }
    if rests_at_any(flight, point, [contact, ignored]) {
        return T::zero();
    }
    let onward = onward(flight, point, motion, contact);
    let mut bounds = [T::zero(); MOST];
    for k in 0..flight.count {
        bounds[k] = fourth(flight, [motion, &onward], contact, k, window);
    }
    let nearer = safe_where_bounded(flight, point, motion, ignored, window, |k| bounds[k]);
    if nearer > safe { nearer } else { safe }
}

/// Whether masses rest on a stop, to be caught there, but for those at the ends that are ignored.
#[inline(always)]
fn rests_at_any<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    [contact, ignored]: [Contact; 2],
) -> bool {
    for normal in 0..flight.count {
        for side in 0..2 {
            let end = End { normal, side };
            if !ignored.includes(end) && rests_at(flight, point, contact, end) {
                return true;
            }
        }
    }
    false
}

/// How x'' moves: it flows like x without loads, forced by −ω² times as much.
#[inline(always)]
fn onward<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    motion: &Motion<T, N>,
    contact: Contact,
) -> Motion<T, N> {
    let forced = -(flight.omega * flight.omega);
    let state = State { x: motion.acceleration, v: motion.jerk };
    let second = Point { state, sin: forced * point.sin, cos: forced * point.cos };
    second.motion_under(flight, contact, &[T::zero(); N])
}

/// A bound on |(d·x)''''| for a time after the point, less than a step, along a normal on which nothing holds; the motions are those of
/// x and of x''.
#[inline(always)]
fn fourth<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    [motion, onward]: [&Motion<T, N>; 2],
    contact: Contact,
    k: usize,
    time: T,
) -> T {
    let normal = &flight.normals[k];
    let sixth = motion.bounded(flight, &normal.sixth[others(contact.held(), k)]);
    let [now, rate] = [&onward.acceleration, &onward.jerk].map(|each| dot(&normal.direction, each).abs());
    now + time * (rate + T::of(0.5) * time * sixth)
}

#[cfg(test)]
mod tests;
