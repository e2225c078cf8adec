//! Complete chatter: infinitely many rebounds in finite time, their sum in closed form.

use super::point::Approach;
use crate::model::{ContactNormal, Flight, Real};

/// What is left of a chatter sequence once the contact holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure<T> {
    /// ∫ gap dt over all the rebounds that are skipped.
    pub gap_integral: T,
    /// How high they rise at most; 0 where that is lost in rounding.
    pub height: T,
    /// About how long they last; 0 where that is lost in rounding, and where damping alone ends them, at what is as good as rest.
    pub time: T,
    /// How long they last at most; likewise.
    pub lasts: T,
}

impl<T: Real> Closure<T> {
    /// Of rebounds that are over at once.
    fn at_once(gap_integral: T) -> Self {
        Closure { gap_integral, height: T::zero(), time: T::zero(), lasts: T::zero() }
    }
}

/// The rebound with which a sequence begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound<T> {
    /// The speed off the stop.
    pub speed: T,
    /// r, the stop's coefficient of restitution.
    pub restitution: T,
    /// Speeds and accelerations up to this cannot be told from 0.
    pub unresolved: T,
    /// The time to the next strobe.
    pub room: T,
}

/// The largest relative change of the pressing force over a sequence, reckoned with the force at its beginning,
/// for which it surely completes: a change c makes the sequence longer by a factor of 1/(1 − c′), where
/// c′ (1 − c′) = c has a solution, with c′ ≤ ½, up to c = ¼.
pub const STEADY: f64 = 0.25;

/// Rebounds with at most this loss, 1 − r, are nearly without loss …
pub const NEARLY: f64 = 1e-3;
/// … and may be closed below this speed, in units of [`Flight::unit`] as all of these, long before their sum is reached …
pub const FADING: f64 = 1e-4;
/// … if they are as slow as this by the next strobe, whose state would still show them, and by the time the force vanishes …
pub const SLOW: f64 = 1e-6;
/// … and if all that they still do to the other masses is below this.
pub const PUSH: f64 = 1e-8;

/// Closes the sequence of rebounds off a stop, if that is as good as following them.
///
/// Against a pressing acceleration a, a rebound of speed u lasts 2u/a and opens a gap whose integral is ⅔ u³/a²;
/// the next has speed r·u. The sums are geometric: 2u/(a(1 − r)) and ⅔ u³/(a²(1 − r³)). They hold up to the
/// relative change of a meanwhile; the effect of that on the other masses (through the springs and dampers
/// between the masses) must be below [`Real::CHATTER`], and the pressing must outlast the sequence, so that
/// it surely completes. It must also complete before the next strobe, whose state would still show its
/// rebounds; a steady enough force makes it at most twice as long as reckoned. The caller makes sure that no stop along
/// another normal is reached meanwhile. A speed that rounding cannot tell from 0
/// is 0: the mass rests, unless it is pulled off. `towards` is the motion after the impact, towards the stop.
#[inline(always)]
pub fn close<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    normal: &ContactNormal<T, N>,
    rebound: &Rebound<T>,
    towards: &Approach<T>,
) -> Option<Closure<T>> {
    let Rebound { speed, restitution: r, unresolved, room } = *rebound;
    let force = towards.acceleration;
    let one = T::one();
    if speed <= unresolved {
        return (force >= -unresolved).then(|| Closure::at_once(T::zero()));
    }
    if force <= T::zero() {
        return None;
    }
    if r < one {
        let time = (speed + speed) / (force * (one - r));
        let change =
            time * (towards.jerk.abs() + T::of(0.5) * towards.bound * time) / force + flight.rate * time;
        let cube = speed * speed * speed;
        let gap_integral = T::of(2.0 / 3.0) * cube / (force * force * (one - r * r * r));
        let effect = gap_integral * normal.coupling;
        let lasts = time + time;
        let closes = lasts <= room
            && change <= T::of(STEADY)
            && effect * change <= T::of(T::CHATTER) * flight.unit
            && stays_low(normal, speed, force);
        if closes {
            // A force that grows ends them sooner: to first order in its change, by a third of that.
            let sooner = time * time * towards.jerk / (T::of(3.0) * force);
            return Some(Closure { gap_integral, height: speed * speed / force, time: time - sooner, lasts });
        }
    }
    if one - r <= T::of(NEARLY) { drag(flight, normal, rebound, towards) } else { None }
}

/// Whether rebounds that begin with `speed` surely do not reach the stop at the other end of the normal: a force that stays
/// above half of what it is lets them rise to u²/a at most.
#[inline(always)]
fn stays_low<T: Real, const N: usize>(normal: &ContactNormal<T, N>, speed: T, force: T) -> bool {
    speed * speed < (normal.gap[0] + normal.gap[1]) * force
}

/// Rebounds without loss (r = 1) do not end in finite time, but the damping c along the normal drags them down: their
/// speed decays like exp(−ct/3), ever more of them in a given time. With a small loss it is (u + k) exp(−ct/3) − k with
/// k = 3a(1 − r)/(2c), and ∫ gap dt is (u²/2 − ku + k² ln(1 + u/k))/(ac); u²/(2ac) at r = 1. Where that cannot be told from
/// rest by the time it matters, the mass is as good as at rest: neither the strobe nor the force that vanishes, which takes
/// a/(2|a′|) at least, may find rebounds that are not slow. What they do to the other masses they do over a time of 3/(2c)
/// rather than at once, so that all of it must be negligible; and the force must hardly change during a rebound.
#[inline(always)]
fn drag<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    normal: &ContactNormal<T, N>,
    rebound: &Rebound<T>,
    towards: &Approach<T>,
) -> Option<Closure<T>> {
    let Rebound { speed, restitution, room, .. } = *rebound;
    let damping = normal.drag;
    let force = towards.acceleration;
    // In flight the damper resists what accelerates the mass; what presses on the contact changes by so much more.
    let drift = (towards.jerk + damping * force).abs();
    let steady = (speed + speed) * drift <= T::of(STEADY) * (force * force);
    if !(damping > T::zero()
        && steady
        && speed <= T::of(FADING) * flight.unit
        && stays_low(normal, speed, force))
    {
        return None;
    }
    let most = speed * speed / ((force + force) * damping);
    let slow = speed * T::of(1.0 / SLOW) / flight.unit;
    let fades = slow <= T::one() || {
        let needed = T::of(3.0) * slow.logarithm();
        damping * room >= needed && damping * force >= (needed + needed) * drift
    };
    if !(fades && most * normal.coupling <= T::of(PUSH) * flight.unit) {
        return None;
    }
    let k = T::of(1.5) * (T::one() - restitution) * force / damping;
    if k <= T::zero() {
        return Some(Closure::at_once(most));
    }
    let lost = k * (speed - k * (T::one() + speed / k).logarithm()) / (force * damping);
    let left = most - lost;
    Some(Closure::at_once(if left > T::zero() { left } else { T::zero() }))
}

#[cfg(test)]
mod tests;
