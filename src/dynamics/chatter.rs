//! Complete chatter: infinitely many rebounds in finite time, closed in one go.

use super::point::Motion;
use crate::model::{Flight, Real};

/// What is left of a chatter sequence once the first mass is put to rest on its stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure<T> {
    /// ∫ gap dt over all the rebounds that are skipped.
    pub gap_integral: T,
}

/// Closes the sequence of rebounds that begins with `speed` off a stop, if that is as good as following them.
///
/// Against a pressing acceleration a, a rebound of speed u lasts 2u/a and opens a gap whose integral is ⅔ u³/a²;
/// the next has speed r·u. The sums are geometric: 2u/(a(1 − r)) and ⅔ u³/(a²(1 − r³)). They hold up to the
/// relative change of a meanwhile; the effect of that on the second mass (through the spring and damper
/// between the masses) must be below [`Real::CHATTER`], and the pressing must outlast the sequence, so that
/// it surely completes. `motion` is that after the impact, towards the stop.
#[inline(always)]
pub fn close<T: Real>(flight: &Flight<T>, speed: T, motion: &Motion<T>) -> Option<Closure<T>> {
    let force = motion.acceleration;
    if speed == T::zero() {
        return if force >= T::zero() { Some(Closure { gap_integral: T::zero() }) } else { None };
    }
    if force <= T::zero() || flight.r >= T::one() {
        return None;
    }
    let r = flight.r;
    let one = T::one();
    let time = (speed + speed) / (force * (one - r));
    let change = time * (motion.jerk.abs() + T::of(0.5) * motion.bound * time) / force + flight.rate * time;
    let cube = speed * speed * speed;
    let gap_integral = T::of(2.0 / 3.0) * cube / (force * force * (one - r * r * r));
    let effect = gap_integral * flight.inverse_mass * (one + flight.coupling_damping);
    let closes = change <= T::of(0.5) && effect * change <= T::of(T::CHATTER);
    if closes { Some(Closure { gap_integral }) } else { None }
}
