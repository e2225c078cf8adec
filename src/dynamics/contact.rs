//! The next contact with a stop, approached from the safe side: no impact can be missed.

use super::point::{Approach, Motion, Point};
use super::stop::{Contact, End};
use crate::model::vector::{axpy, dot, dot_absolute};
use crate::model::{ContactNormal, FAR, Flight, Real, State};

/// A time for which the motion from `point` provably stays off all stops but those at the ends that `ignored` includes:
/// `window` if it does so for all of it, else a time just short of the first contact (0 at the contact itself, moving
/// outwards).
#[inline(always)]
pub fn safe_time<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    motion: &Motion<T, N>,
    ignored: Contact,
    window: T,
) -> T {
    safe_where_bounded(flight, point, motion, ignored, window, |k| point.bound(flight, k))
}

/// The same, `bound` bounding |(d·x)''''| along each normal.
#[inline(always)]
pub(super) fn safe_where_bounded<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    motion: &Motion<T, N>,
    ignored: Contact,
    window: T,
    bound: impl Fn(usize) -> T,
) -> T {
    let mut safe = window;
    for (k, normal) in flight.normals().iter().enumerate() {
        let place = dot(&normal.direction, &point.state.x);
        let speed = dot(&normal.direction, &point.state.v);
        let approach = motion.approach(&normal.direction, bound(k));
        for side in 0..2 {
            let end = End { normal: k, side };
            if normal.gap[side] >= T::of(FAR) || ignored.includes(end) {
                continue;
            }
            let sign = end.sign::<T>();
            let time = safe_from_stop(normal.gap[side] - sign * place, sign * speed, &approach, sign, window);
            safe = if time < safe { time } else { safe };
        }
    }
    safe
}

/// Whether a point lies within all stops but those at the ends that `ignored` includes.
#[inline(always)]
fn is_within<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>, ignored: Contact) -> bool {
    let mut within = true;
    for (k, normal) in flight.normals().iter().enumerate() {
        let place = dot(&normal.direction, &point.state.x);
        within &= ignored.includes(End { normal: k, side: 0 }) || place <= normal.gap[0];
        within &= ignored.includes(End { normal: k, side: 1 }) || -place <= normal.gap[1];
    }
    within
}

/// Whether a point lies within all stops, up to the rounding of the flights that led to it.
pub fn holds<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>) -> bool {
    let State { x, v } = &point.state;
    let size = |i: usize, row: &[[T; N]; N], of: &[T; N]| {
        (0..N).fold(T::zero(), |sum, j| sum + (row[j][i] * of[j]).abs())
    };
    // The size of what adds up in one step to each coordinate.
    let moved: [T; N] = std::array::from_fn(|i| {
        let loads = flight.sin[i].abs() + flight.cos[i].abs() + flight.load[i].abs();
        let pulls = size(i, &flight.stiffness, x) + size(i, &flight.damping, v) + loads;
        x[i].abs() + flight.h * (v[i].abs() + flight.h * pulls)
    });
    flight.normals().iter().all(|normal| {
        let place = dot(&normal.direction, x);
        let rounding = T::of(ROUNDINGS) * T::epsilon() * dot_absolute(&normal.direction.map(T::abs), &moved);
        [place - normal.gap[0], -place - normal.gap[1]].into_iter().all(|beyond| {
            beyond.is_nan()
                || beyond
                    <= rounding
                        + T::of(ROUNDINGS) * T::epsilon() * normal.gap[0].abs().min(normal.gap[1].abs())
        })
    })
}

/// As many roundings of a place as [`holds`] lets pass.
pub const ROUNDINGS: f64 = 64.0;

/// Roundings of a kick by which a speed that it does not change may seem changed.
pub const KICK_ROUNDINGS: f64 = 4.0;

/// The gap to the stop at an end.
#[inline(always)]
pub fn gap_to<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>, end: End) -> T {
    let normal = &flight.normals[end.normal];
    normal.gap[end.side] - end.sign::<T>() * dot(&normal.direction, &point.state.x)
}

/// The size of the numbers whose difference the gap is.
#[inline(always)]
pub fn extent<T: Real, const N: usize>(normal: &ContactNormal<T, N>, point: &Point<T, N>, side: usize) -> T {
    let mut extent = normal.gap[side].abs();
    for (d, x) in normal.direction.iter().zip(&point.state.x) {
        let part = (*d * *x).abs();
        extent = if part > extent { part } else { extent };
    }
    extent
}

/// Speeds and accelerations up to this cannot be told from 0: d·v is a difference of velocities.
#[inline(always)]
pub fn unresolved<T: Real, const N: usize>(flight: &Flight<T, N>, end: End, state: &State<T, N>) -> T {
    let normal = &flight.normals[end.normal];
    let mut size = normal.gap[end.side].abs() + flight.unit;
    for (d, v) in normal.direction.iter().zip(&state.v) {
        size = size + (*d * *v).abs();
    }
    T::epsilon() * size
}

/// Whether masses that hop on a stop, never higher than `height` and for no longer than `time` ≤ h, surely stay off all
/// stops along other normals.
///
/// `point` is where the hops end, and `contact` includes their stop. What is reached with the hops lies between what is
/// reached at rest and what is reached `height` off the stop. Hops that are over at once reach nothing.
#[inline(always)]
pub fn clears_elsewhere<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    end: End,
    height: T,
    time: T,
) -> bool {
    if flight.count == 1 || time == T::zero() {
        return true;
    }
    let motion = point.motion(flight, contact);
    let ignored = contact.with_opposite_ends();
    let response = &flight.normals[end.normal].response;
    let raised = axpy(-(end.sign::<T>() * height), response, &point.state.x);
    let raised = Point { state: State { x: raised, ..point.state }, ..*point };
    is_within(flight, point, ignored)
        && is_within(flight, &raised, ignored)
        && safe_time(flight, point, &motion, ignored, time) >= time
        && safe_time(flight, &raised, &motion, ignored, time) >= time
}

/// How far beyond the expected contact the window reaches.
pub const WIDENING: f64 = 1.25;

/// [`safe_time`] for one stop, `gap` away, approached with `speed` and `acceleration`.
///
/// The gap after a time s is at least gap − speed·s − ½ s² (acceleration + jerk·s/3 + bound·s²/12), and the
/// bracket is at most its larger end value on any window, so the quadratic's root is safe within that window. A
/// narrow window gives a tight bracket: it reaches just beyond where the contact is expected.
#[inline(always)]
fn safe_from_stop<T: Real>(gap: T, speed: T, approach: &Approach<T>, sign: T, window: T) -> T {
    let gap = if gap > T::zero() { gap } else { T::zero() };
    let acceleration = sign * approach.acceleration;
    let jerk = sign * approach.jerk * T::of(1.0 / 3.0);
    let bound = approach.bound * T::of(1.0 / 12.0);
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
    if jerk > T::zero() {
        return -(two * acceleration) / (jerk + root);
    }
    if root == jerk {
        // Nothing ever changes the acceleration.
        return T::of(FAR);
    }
    (root - jerk) / (two * bound)
}

/// A time for which what presses a mass on its stop provably lasts, at most `window`: `force`
/// ≥ 0 now, `slope` its derivative, `bound` on its second derivative.
#[inline(always)]
pub fn pressed_time<T: Real>(force: T, slope: T, bound: T, window: T) -> T {
    let force = if force > T::zero() { force } else { T::zero() };
    let time = closing_time(force, -slope, bound);
    if time < window { time } else { window }
}

#[cfg(test)]
mod tests;
