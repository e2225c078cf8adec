//! Complete chatter: infinitely many rebounds in finite time, closed in one go.

use super::contact;
use super::point::Motion;
use crate::model::{Flight, Real};

/// What is left of a chatter sequence once the first mass is put to rest on its stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure<T> {
    /// ∫ gap dt over all the rebounds that are skipped.
    pub gap_integral: T,
}

/// The largest relative change of the pressing force over a sequence, reckoned with the force at its beginning,
/// for which it surely completes: a change c makes the sequence longer by a factor of 1/(1 − c′), where
/// c′ (1 − c′) = c has a solution, with c′ ≤ ½, up to c = ¼.
pub const STEADY: f64 = 0.25;

/// Rebounds without loss may be closed below this speed …
pub const SLOW: f64 = 1e-6;
/// … if the force lasts for so many times 1/c: a third of it in exponents of e.
pub const DRAGGED: f64 = 21.0;

/// Closes the sequence of rebounds that begins with `speed` off a stop, if that is as good as following them.
///
/// Against a pressing acceleration a, a rebound of speed u lasts 2u/a and opens a gap whose integral is ⅔ u³/a²;
/// the next has speed r·u. The sums are geometric: 2u/(a(1 − r)) and ⅔ u³/(a²(1 − r³)). They hold up to the
/// relative change of a meanwhile; the effect of that on the second mass (through the spring and damper
/// between the masses) must be below [`Real::CHATTER`], and the pressing must outlast the sequence, so that
/// it surely completes. It must also complete before the next strobe, `room` away, whose state would still show its
/// rebounds; a steady enough force makes it at most twice as long as reckoned. A speed
/// that rounding cannot tell from 0 is 0: the mass rests, unless it is pulled off.
/// `motion` is that after the impact, towards the stop.
#[inline(always)]
pub fn close<T: Real>(flight: &Flight<T>, speed: T, motion: &Motion<T>, room: T) -> Option<Closure<T>> {
    let force = motion.acceleration;
    let one = T::one();
    let unresolved = contact::unresolved(flight);
    if speed <= unresolved {
        let gap_integral = T::zero();
        return if force >= -unresolved { Some(Closure { gap_integral }) } else { None };
    }
    if force <= T::zero() {
        return None;
    }
    if flight.r >= one {
        return drag(flight, speed, motion);
    }
    let r = flight.r;
    let time = (speed + speed) / (force * (one - r));
    let change = time * (motion.jerk.abs() + T::of(0.5) * motion.bound * time) / force + flight.rate * time;
    let cube = speed * speed * speed;
    let gap_integral = T::of(2.0 / 3.0) * cube / (force * force * (one - r * r * r));
    let effect = gap_integral * flight.inverse_mass * (one + flight.coupling_damping);
    let closes = time + time <= room
        && change <= T::of(STEADY)
        && effect * change <= T::of(T::CHATTER)
        && stays_low(flight, speed, force);
    if closes { Some(Closure { gap_integral }) } else { None }
}

/// Whether rebounds that begin with `speed` surely do not reach the other stop, 2δ away: a force that stays above half
/// of what it is lets them rise to u²/a at most.
#[inline(always)]
fn stays_low<T: Real>(flight: &Flight<T>, speed: T, force: T) -> bool {
    speed * speed < (flight.delta + flight.delta) * force
}

/// Rebounds without loss (r = 1) do not end in finite time, but the damper drags them down: their speed u decays
/// like exp(−ct/3), c = 2ζ, ever more of them in a given time. Once they are slow, and the force lasts until they
/// are gone, the mass is as good as at rest; ∫ gap dt is u²/(2ac) then.
#[inline(always)]
fn drag<T: Real>(flight: &Flight<T>, speed: T, motion: &Motion<T>) -> Option<Closure<T>> {
    let damping = flight.coupling_damping;
    let force = motion.acceleration;
    let lasts = damping * force >= T::of(DRAGGED) * motion.jerk.abs();
    if damping > T::zero() && lasts && speed <= T::of(SLOW) && stays_low(flight, speed, force) {
        Some(Closure { gap_integral: speed * speed / ((force + force) * damping) })
    } else {
        None
    }
}
