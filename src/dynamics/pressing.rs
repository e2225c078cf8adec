//! What presses on a contact now, and whether that can be told from nothing.

use super::contact;
use super::point::{Motion, Point};
use super::stop::{Contact, End};
use crate::model::vector::dot;
use crate::model::{Flight, Real};

/// What presses on a contact that holds, as an acceleration towards the stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressing<T> {
    /// It.
    pub force: T,
    /// Its derivative.
    pub slope: T,
    /// How far it may seem to fall below 0 while the contact holds: not at all, but where it cannot be told from nothing, and
    /// rounding decides on its sign.
    pub slack: T,
    /// Whether the contact opens now: as soon as it presses no more where it falls steeply, else where it surely pulls.
    pub opens: bool,
}

/// As many roundings of the sums that what presses is may be all that there is of it.
pub const LOST: f64 = 8.0;

impl<T: Real> Pressing<T> {
    /// On the stop at an end, of those on which masses rest.
    #[inline(always)]
    pub fn on<const N: usize>(
        flight: &Flight<T, N>,
        point: &Point<T, N>,
        motion: &Motion<T, N>,
        contact: Contact,
        end: End,
    ) -> Self {
        let [force, slope] = motion.pressure(end);
        let unresolved = contact::unresolved(flight, end, &point.state);
        if slope * flight.least() < -unresolved {
            return Pressing { force, slope, slack: T::zero(), opens: force <= unresolved };
        }
        let lost = unresolved + lost(flight, point, contact, end.normal);
        let slack = if force.abs() <= lost { lost } else { T::zero() };
        Pressing { force, slope, slack, opens: force < -lost }
    }

    /// For how long it provably lasts, at most `window`, or does nothing to a speed that would not be lost in rounding; `bound` is
    /// on its second derivative. Without that nothing would come of moves so short that a displacement does not change.
    #[inline(always)]
    pub fn lasts(&self, bound: T, window: T) -> T {
        let force = self.force + self.slack * T::of(T::UNHEEDED);
        contact::pressed_time(force, self.slope, bound, window)
    }
}

/// Whether masses on a stop, or as near to it as rounding tells, with a speed that cannot be told from 0, stay there beside the
/// contacts that hold: a hop would be lost in rounding.
#[inline(always)]
pub fn rests<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    end: End,
) -> bool {
    let motion = point.motion(flight, contact.with(end));
    let Pressing { force, opens, .. } = Pressing::on(flight, point, &motion, contact.with(end), end);
    force >= T::zero() || !opens
}

/// What may be lost in rounding of what presses on a contact: it is a sum over the motion, and no more of its terms is known than of
/// the largest that they get as that goes on.
#[inline(always)]
fn lost<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    normal: usize,
) -> T {
    let mut sizes: [T; N] =
        std::array::from_fn(|i| (flight.load[i].abs() + flight.sin[i].abs()) + flight.cos[i].abs());
    for j in 0..N {
        let moved = point.state.x[j].abs() + point.state.v[j].abs() / flight.rate;
        for i in 0..N {
            let pull = flight.rate.times_plus(flight.damping[j][i].abs(), flight.stiffness[j][i].abs());
            sizes[i] = moved.times_plus(pull, sizes[i]);
        }
    }
    let matrix = &flight.pressing[contact.held() as usize][normal];
    let mut sum = T::zero();
    for (t, other) in flight.normals().iter().enumerate() {
        let along = dot(&other.direction.map(T::abs), &sizes);
        sum = matrix[t].abs().times_plus(along, sum);
    }
    T::of(LOST * T::EPSILON) * sum
}

#[cfg(test)]
mod tests;
