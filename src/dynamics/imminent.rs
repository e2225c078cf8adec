//! The stop that is met at once.

use super::contact::{extent, gap_to, unresolved};
use super::point::Point;
use super::pressing::rests;
use super::stop::{Contact, End};
use crate::model::vector::dot;
use crate::model::{FAR, Flight, Real};

/// A stop that is reached in one straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached<T> {
    /// The end of a contact normal that is met.
    pub end: End,
    /// The time left; 0 if the stop is touched.
    pub left: T,
}

/// The stop that is touched, or reached so soon that the square of the time left is lost in rounding; of several the one
/// that is reached first, and of those reached at the same time the first in the order of normals and ends.
#[inline(always)]
pub fn imminent<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
) -> Option<Reached<T>> {
    let ignored = contact.with_opposite_ends();
    let mut first: Option<Reached<T>> = None;
    for (k, normal) in flight.normals().iter().enumerate() {
        for side in 0..2 {
            let end = End { normal: k, side };
            if normal.gap[side] >= T::of(FAR) || ignored.includes(end) {
                continue;
            }
            let Some(left) = imminent_at(flight, point, contact, end) else { continue };
            if first.is_none_or(|first| left < first.left) {
                first = Some(Reached { end, left });
            }
        }
    }
    first
}

/// The speed with which the gap to the stop at an end closes.
#[inline(always)]
fn speed_towards<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>, end: End) -> T {
    end.sign::<T>() * dot(&flight.normals[end.normal].direction, &point.state.v)
}

/// Whether masses rest on the stop at an end, or as near to it as rounding tells, with a speed that cannot be told from 0, and stay
/// there beside the contacts that hold.
#[inline(always)]
pub fn rests_at<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    end: End,
) -> bool {
    let lost = unresolved(flight, end, &point.state);
    let still = speed_towards(flight, point, end).abs() <= lost && gap_to(flight, point, end) <= lost;
    still && rests(flight, point, contact, end)
}

/// The time left to one stop; see [`imminent`].
#[inline(always)]
fn imminent_at<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    end: End,
) -> Option<T> {
    let normal = &flight.normals[end.normal];
    let (gap, speed) = (gap_to(flight, point, end), speed_towards(flight, point, end));
    let touches = gap <= T::of(T::TOUCH) * extent(normal, point, end.side);
    if (touches && speed > T::zero()) || rests_at(flight, point, contact, end) {
        return Some(T::zero());
    }
    if touches {
        return None;
    }
    (flight.rate * gap < T::of(T::IMMINENT) * speed).then(|| gap / speed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::example::single;
    use crate::model::State;

    /// What is imminent on a stop that a force presses on, or pulls off.
    fn touches<T: Real>() {
        let upper = End { normal: 0, side: 0 };
        let at = |load: f64, v: f64| {
            let system = single(|plant| plant.load[0] = load);
            let flight = Flight::<f64, 1>::new(&system).round::<T>();
            let point = Point::at_phase_zero(State { x: [T::of(0.5)], v: [T::of(v)] });
            imminent(&flight, &point, Contact::FREE)
        };
        let touched = Some(Reached { end: upper, left: T::zero() });
        // The spring pulls with ½; the load decides.
        assert_eq!(at(1.0, 0.1), touched);
        assert_eq!(at(1.0, 0.0), touched, "at rest and pressed");
        assert_eq!(at(0.5, 0.0), touched, "at rest and neither pressed nor pulled");
        assert_eq!(at(0.4, 0.0), None, "at rest and pulled off");
        assert_eq!(at(1.0, -0.1), None, "on the way off");
        assert_eq!(at(1.0, -0.1 * T::EPSILON), touched, "on the way off at a speed that is lost in rounding");
    }

    #[test]
    fn a_touched_stop_is_met_unless_it_is_left() {
        touches::<f64>();
        touches::<f32>();
    }
}
