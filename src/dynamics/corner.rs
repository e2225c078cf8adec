//! Complete chatter in a corner: masses that rebound between several stops at once, ever faster, and come to rest on all.

use super::chatter::STEADY;
use super::contact;
use super::point::Point;
use super::stop::{Contact, End};
use crate::model::vector::dot;
use crate::model::{FAR, Flight, Real};

/// As many roundings of a place as what is lost in them may displace masses: they would go on hopping about so far, thrown by rounding
/// alone.
pub const HOPS: f64 = 32.0;

/// The contacts of masses that an impact at `end` leaves so slow, and so near to stops along other normals, that they may
/// as well rest on all of them; `None` elsewhere.
///
/// An impact at one stop may throw the masses on the other, and back: no sequence at a single stop completes. Where the
/// contact forces would all press with the masses at rest in the corner, the energy of the motion about it is positive
/// and every impact takes some of it, so that infinitely many impacts end there in finite time. A speed u against a
/// pressing acceleration a lasts for about u/(a(1 − r)), in which the masses are displaced by u²/(a(1 − r)): where that
/// is below [`Real::CHATTER`] or lost in rounding, the rest of the sequence is left out; and so it is where a single rebound, which
/// displaces them by u²/(2a), is lost in rounding, as at a stop that takes nothing while the others do.
#[inline(always)]
pub fn closes<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    end: End,
) -> Option<Contact> {
    if flight.count == 1 {
        return None;
    }
    let struck = contact.with(end);
    let mut corner = struck;
    for (k, normal) in flight.normals().iter().enumerate() {
        for side in 0..2 {
            let beside = End { normal: k, side };
            let held = (corner.held() >> k) & 1 == 1;
            if !held && normal.gap[side] < T::of(FAR) && is_near(flight, point, beside) {
                corner = corner.with(beside);
            }
        }
    }
    if corner == struck {
        return None;
    }
    let motion = point.motion(flight, corner);
    let mut closes = true;
    for (k, normal) in flight.normals().iter().enumerate() {
        let Some(end) = corner.end_along(k).filter(|_| !contact.is_clamped_along(k)) else { continue };
        let speed = dot(&normal.direction, &point.state.v).abs();
        let [force, slope] = motion.pressure(end);
        let lossy = force * (T::one() - normal.restitution[end.side]);
        let lost = T::of(HOPS) * T::epsilon() * contact::extent(normal, point, end.side);
        let completes = speed * speed <= negligible(flight, point, end) * lossy
            && -(slope * speed) <= T::of(STEADY) * force * lossy;
        closes &= force > T::zero() && (completes || speed * speed <= lost * force);
    }
    closes.then_some(corner)
}

/// Whether the gap to a stop is negligible.
#[inline(always)]
fn is_near<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>, end: End) -> bool {
    contact::gap_to(flight, point, end) <= negligible(flight, point, end)
}

/// The size of a gap that is left out.
#[inline(always)]
fn negligible<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>, end: End) -> T {
    let rounding = T::of(T::TOUCH) * contact::extent(&flight.normals[end.normal], point, end.side);
    let allowed = T::of(T::CHATTER) * flight.unit;
    if rounding > allowed { rounding } else { allowed }
}
