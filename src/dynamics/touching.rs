//! A leg that ends within the stops but comes near to one: it touches it and returns, or turns before, or not on its way.

use super::along::Along;
use super::face::Face;
use super::hull::Span;
use super::leg::{Leg, Way};
use crate::model::{Flight, Lanes, Mask};

/// Where a leg turns off its stop and stays off all others, on its way to a `middle`, where it turns or comes near, and from there
/// on: the hulls of the two parts are far nearer to the gap than that of the whole. The second begins where it must be off the stop, by
/// more than rounding: a hull says nothing of where it begins.
///
/// `u` is the share of the leg that lies before, `rest` that of a whole step which is left then.
#[inline(always)]
pub fn turns_off<L: Lanes, const N: usize>(
    leg: &Leg<'_, L, N>,
    face: &Face<L, N>,
    middle: Along<L>,
    [u, rest]: [L; 2],
    flight: &Flight<L, N>,
) -> L::Mask {
    let (zero, time) = (u.all(0.0), u * leg.span.time);
    let within = zero.below(time).and(time.below(leg.span.time));
    let left = face.open(middle.place);
    let rounding = face.rounding(&leg.end.state, leg.span.time * middle.speed);
    let mut off = within.and(rounding.below(left));
    let each = leg.each(rest, (face.normal, middle), flight);
    for k in 0..each.count {
        let (normal, way) = (&flight.normals[k], leg.along(flight, k));
        let before = Way { to: each[k], span: Span::of(time), ..way };
        let after = Way { from: each[k], span: Span::of(leg.span.time - time), ..way };
        off = off.and(before.clearance(normal).both()).and(after.clearance(normal).both());
    }
    off
}

/// Where a leg that returns from a stop, which it meets with the speed `arrives`, would go beyond it by more than rounding, then or
/// in the next step: by v²/(2a) at least, where what pulls it back is at most a. The acceleration towards the stop is `pulls` there
/// and at the end of the leg, and in between w²/8·max|(d·x)''''| less than either at most.
#[inline(always)]
pub fn is_deep<L: Lanes>(way: &Way<L>, arrives: L, pulls: [L; 2], rounding: L) -> L::Mask {
    let swelling = (way.span.time * way.span.time) * (way.bound * way.span.time.all(0.125));
    let least = pulls[0].smaller(pulls[1]) - swelling;
    ((rounding + rounding) * (-least).larger(arrives.all(0.0))).below(arrives * arrives)
}

#[cfg(test)]
mod tests;
