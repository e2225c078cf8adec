//! The next contact with a stop, approached from the safe side: no impact can be missed.

use super::drive::Drive;
use super::point::{Motion, Point};
use crate::model::{Flight, Real};

/// Whether the step from `from` to `to` provably stays off both stops.
///
/// x1 lies within h⁴/384·max|x1''''| of its cubic Hermite interpolant, and that within the hull of its four
/// Bézier points.
#[inline(always)]
pub fn clears<T: Real, D: Drive<T>>(flight: &Flight<T>, from: &Point<T, D>, to: &Point<T, D>) -> bool {
    let third = flight.h * T::of(1.0 / 3.0);
    let h2 = flight.h * flight.h;
    let room = flight.delta - (h2 * h2) * T::of(HERMITE) * from.bound(flight);
    let leaving = from.x1 + third * from.v1;
    let arriving = to.x1 - third * to.v1;
    from.x1.abs() < room && leaving.abs() < room && arriving.abs() < room && to.x1.abs() < room
}

/// A time for which free flight from `point` provably stays between the stops: `window` if it does so for all of
/// it, else a time just short of the first contact (0 at the contact itself, moving outwards).
#[inline(always)]
pub fn safe_time<T: Real, D>(flight: &Flight<T>, point: &Point<T, D>, motion: &Motion<T>, window: T) -> T {
    let at_a =
        safe_from_stop(flight.delta - point.x1, point.v1, motion.acceleration, motion, T::one(), window);
    let at_b =
        safe_from_stop(flight.delta + point.x1, -point.v1, -motion.acceleration, motion, -T::one(), window);
    if at_a < at_b { at_a } else { at_b }
}

/// A time, at most `window`, for which a mass that leaves the stop at `side` provably does not reach the other one.
#[inline(always)]
pub fn safe_across<T: Real, D>(
    flight: &Flight<T>,
    point: &Point<T, D>,
    motion: &Motion<T>,
    side: T,
    window: T,
) -> T {
    let gap = flight.delta + side * point.x1;
    safe_from_stop(gap, -(side * point.v1), -(side * motion.acceleration), motion, -side, window)
}

/// Whether a point lies between the stops, up to the rounding of the flights that led to it.
pub fn holds<T: Real, D: Drive<T>>(flight: &Flight<T>, point: &Point<T, D>) -> bool {
    let force = (T::one() + point.x2.abs()) + flight.coupling_damping * (point.v1.abs() + point.v2.abs());
    let size = flight.delta + flight.h * (point.v1.abs() + flight.h * point.drive.bounded(force));
    let beyond = point.x1.abs() - flight.delta;
    beyond.is_nan() || beyond <= T::of(ROUNDINGS) * T::epsilon() * size
}

/// As many roundings of x1 as [`holds`] lets pass.
const ROUNDINGS: f64 = 64.0;

/// The time left to a stop, if it is so short that its square is lost in rounding; 0 if the stop is touched.
#[inline(always)]
pub fn imminent<T: Real, D: Drive<T>>(flight: &Flight<T>, point: &Point<T, D>, side: T) -> Option<T> {
    let gap = flight.delta - side * point.x1;
    let speed = side * point.v1;
    if flight.rate * gap.abs() < T::of(T::IMMINENT) * speed {
        return Some(gap / speed);
    }
    let touches = gap <= T::of(T::TOUCH) * flight.delta;
    (touches && (speed >= T::zero() || is_held(flight, point, side))).then_some(T::zero())
}

/// Whether a mass on its stop leaves it with a speed that rounding cannot tell from 0, against a force that presses
/// it back: the hop would be lost in rounding.
#[inline(always)]
fn is_held<T: Real, D: Drive<T>>(flight: &Flight<T>, point: &Point<T, D>, side: T) -> bool {
    point.v1.abs() <= unresolved(flight) && side * point.motion(flight, T::one()).acceleration > T::zero()
}

/// Speeds and accelerations up to this cannot be told from 0.
#[inline(always)]
pub fn unresolved<T: Real>(flight: &Flight<T>) -> T {
    T::epsilon() * (flight.delta + T::one())
}

/// The cubic Hermite interpolant's error constant, in h⁴·max|x''''|.
pub const HERMITE: f64 = 1.0 / 384.0;

/// A time longer than any window, and finite in either precision.
pub const FAR: f64 = 1e30;

/// How far beyond the expected contact the window reaches.
pub const WIDENING: f64 = 1.25;

/// [`safe_time`] for one stop, `gap` away, approached with `speed` and `acceleration`.
///
/// The gap after a time s is at least gap − speed·s − ½ s² (acceleration + jerk·s/3 + bound·s²/12), and the
/// bracket is at most its larger end value on any window, so the quadratic's root is safe within that window. A
/// narrow window gives a tight bracket: it reaches just beyond where the contact is expected.
#[inline(always)]
fn safe_from_stop<T: Real>(gap: T, speed: T, acceleration: T, motion: &Motion<T>, side: T, window: T) -> T {
    let gap = if gap > T::zero() { gap } else { T::zero() };
    let jerk = side * motion.jerk * T::of(1.0 / 3.0);
    let bound = motion.bound * T::of(1.0 / 12.0);
    let steepest = |s: T| {
        let change = s * (jerk + bound * s);
        if change > T::zero() { acceleration + change } else { acceleration }
    };
    let within = |window: T| {
        let closing = closing_time(gap, speed, steepest(window));
        if closing < window { closing } else { window }
    };
    if stays_clear(gap, speed, steepest(window), window) {
        return window;
    }
    if speed <= T::zero() {
        let pulled_off = pulled_off_time(acceleration, jerk, bound);
        if pulled_off >= window {
            return window;
        }
        let expected = T::of(WIDENING) * closing_time(gap, speed, acceleration);
        let safe = within(if expected < window { expected } else { window });
        return if safe > pulled_off { safe } else { pulled_off };
    }
    if acceleration < T::zero() && within(window) >= window {
        return window;
    }
    let expected = T::of(WIDENING) * gap / speed;
    within(if expected < window { expected } else { window })
}

/// Whether a gap surely stays open for a time, by a glance: speed and acceleration count only where they close it.
#[inline(always)]
fn stays_clear<T: Real>(gap: T, speed: T, acceleration: T, time: T) -> bool {
    let speed = if speed > T::zero() { speed } else { T::zero() };
    let acceleration = if acceleration > T::zero() { acceleration } else { T::zero() };
    gap > time * (speed + T::of(0.5) * acceleration * time)
}

/// The first s > 0 with gap = speed·s + ½ acceleration·s², or [`FAR`]: for gap ≥ 0, without cancellation.
#[inline(always)]
fn closing_time<T: Real>(gap: T, speed: T, acceleration: T) -> T {
    let discriminant = speed * speed + (gap + gap) * acceleration;
    if (acceleration <= T::zero() && speed <= T::zero()) || discriminant < T::zero() {
        return T::of(FAR);
    }
    let root = discriminant.sqrt();
    if speed > T::zero() { (gap + gap) / (speed + root) } else { (root - speed) / acceleration }
}

/// How long an acceleration away from the stop surely lasts (0 if it is towards the stop): the root of
/// acceleration + jerk·s + bound·s², with `jerk` and `bound` scaled as the caller has them.
#[inline(always)]
fn pulled_off_time<T: Real>(acceleration: T, jerk: T, bound: T) -> T {
    if acceleration > T::zero() || (acceleration == T::zero() && jerk >= T::zero()) {
        return T::zero();
    }
    let two = T::of(2.0);
    let root = (jerk * jerk - (two + two) * acceleration * bound).sqrt();
    if jerk > T::zero() { -(two * acceleration) / (jerk + root) } else { (root - jerk) / (two * bound) }
}

/// A time for which the force that presses the first mass on its stop provably lasts, at most `window`: `force`
/// ≥ 0 now, `slope` its derivative, `bound` on its second derivative.
#[inline(always)]
pub fn pressed_time<T: Real>(force: T, slope: T, bound: T, window: T) -> T {
    let force = if force > T::zero() { force } else { T::zero() };
    let time = closing_time(force, -slope, bound);
    if time < window { time } else { window }
}
