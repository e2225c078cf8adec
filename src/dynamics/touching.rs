//! A leg that ends within the stops but comes near to one: it touches it and returns, or turns before.

use super::face::Face;
use super::leg::Leg;
use super::point::Point;
use crate::model::{Flight, Lanes, Mask};

/// Where a leg turns off its stop and stays off all others, on its way to where it turns about, `middle`, the share `u` of it, and
/// from there on: the hulls of the two parts are far nearer to the gap than that of the whole. The second begins where it must be
/// off the stop, by more than rounding: a hull says nothing of where it begins.
#[inline(always)]
pub fn turns_off<L: Lanes, const N: usize>(
    leg: &Leg<'_, L, N>,
    face: &Face<L, N>,
    middle: &Point<L, N>,
    u: L,
    flight: &Flight<L, N>,
) -> L::Mask {
    let Leg { from, to, window } = *leg;
    let (zero, time) = (window.all(0.0), u * window);
    let within = zero.below(time).and(time.below(window));
    let before = Leg { from, to: middle, window: time };
    let after = Leg { from: middle, to, window: window - time };
    let left = face.open(&middle.state);
    let rounding = face.rounding(&middle.state, window * face.towards(&middle.state.v));
    within.and(rounding.below(left)).and(before.clears(flight)).and(after.clears(flight))
}

/// Where a leg that returns from a stop, which it meets with the speed `arrives`, would go beyond it by more than rounding, then or
/// in the next step: by v²/(2a) at least, where what pulls it back is at most a, see [`pulled`].
#[inline(always)]
pub fn is_deep<L: Lanes, const N: usize>(
    face: &Face<L, N>,
    arrives: L,
    pulls: [L; 2],
    window: L,
    rounding: L,
) -> L::Mask {
    let [least, _] = pulled(face, pulls, window);
    ((rounding + rounding) * (-least).larger(window.all(0.0))).below(arrives * arrives)
}

/// Between what the acceleration towards the stop lies all along a leg: it lies w²/8·max|(d·x)''''| outside of what lies between
/// those at its ends, `pulls`, at most.
#[inline(always)]
pub fn pulled<L: Lanes, const N: usize>(face: &Face<L, N>, pulls: [L; 2], window: L) -> [L; 2] {
    let swelling = (window * window) * (face.bound * window.all(0.125));
    [pulls[0].smaller(pulls[1]) - swelling, pulls[0].larger(pulls[1]) + swelling]
}

#[cfg(test)]
mod tests;
