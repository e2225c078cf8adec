//! Masses that two stops squeeze: they rebound between both ever faster, and lose all speed along both in an instant.

use super::contact::{KICK_ROUNDINGS, gap_to, unresolved};
use super::placing::{placed_on, rested};
use super::point::Point;
use super::stop::{Contact, End};
use super::tangent::{Saltation, Tangent};
use super::trajectory::{Event, Impact, Trajectory};
use crate::model::vector::{axpy, dot};
use crate::model::{FAR, Flight, Real, State};

/// Impacts at either stop after which those that follow are known to be infinitely many.
pub const SQUEEZES: u32 = 24;

/// The stop that masses are thrown on by an impact at `end`, and from which they come back at once, infinitely often.
///
/// With both gaps closed, speeds alone matter: an impact at one stop turns the speed off it by −r and throws the masses on the other by
/// what the two normals share, c. The speeds after two impacts are a linear map of those before, with the determinant r₁r₂ and the trace
/// (1 + r₁)(1 + r₂) c − r₁ − r₂, and impacts follow each other for ever where that has two positive eigenvalues, below 1 as c is, and the
/// speeds are such that none of the first few leads off both. It takes no time, whatever presses. Such impacts are followed one by
/// one until their speeds squared are below [`Real::CHATTER`]: what they took then is known, and what a deviation shifts them by.
#[inline(always)]
pub fn squeezed<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    contact: Contact,
    end: End,
) -> Option<End> {
    let mut found = None;
    for (k, normal) in flight.normals().iter().enumerate() {
        for side in 0..2 {
            let other = End { normal: k, side };
            let meets = k != end.normal && (contact.held() >> k) & 1 == 0 && normal.gap[side] < T::of(FAR);
            if meets && is_thrown_on(flight, point, other) {
                if found.is_some() {
                    return None;
                }
                found = Some(other);
            }
        }
    }
    let other = found?;
    let [own, beside] = [end, other].map(|end| &flight.normals[end.normal]);
    let [r, s] = [own.restitution[end.side], beside.restitution[other.side]];
    let facing = -(end.sign::<T>() * other.sign::<T>());
    // What an impact at one stop throws on the other, per speed that it changes.
    let onto_own = facing * dot(&own.direction, &beside.response);
    let onto_other = facing * dot(&beside.direction, &own.response);
    let (one, zero) = (T::one(), T::zero());
    let product = onto_own * onto_other;
    let trace = (one + r) * (one + s) * product - r - s;
    let faces = onto_own > zero && onto_other > zero && product < one;
    if !(faces && trace > (r * s).sqrt() + (r * s).sqrt()) {
        return None;
    }
    // Contacts that hold must not be in the way.
    for (k, normal) in flight.normals().iter().enumerate() {
        let thrown = dot(&normal.direction, &beside.response).abs() > T::of(KICK_ROUNDINGS) * T::epsilon();
        if thrown && contact.opening_along(k).is_some() {
            return None;
        }
    }
    // The speed towards the own stop, per speed towards the other.
    let own_speed = end.sign::<T>() * dot(&own.direction, &point.state.v);
    let mut share = own_speed / (other.sign::<T>() * dot(&beside.direction, &point.state.v));
    for _ in 0..SQUEEZES {
        let towards_own = share + (one + s) * onto_own;
        let towards_other = (one + r) * onto_other * towards_own - s;
        if !(towards_own > zero && towards_other > zero) {
            return None;
        }
        share = -(r * towards_own) / towards_other;
    }
    Some(other)
}

/// Whether masses meet the stop at an end at once, so slowly that the impact takes nothing, but not so slowly that rounding tells.
#[inline(always)]
fn is_thrown_on<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>, end: End) -> bool {
    let speed = end.sign::<T>() * dot(&flight.normals[end.normal].direction, &point.state.v);
    let gap = gap_to(flight, point, end);
    let lost = unresolved(flight, end, &point.state);
    let at_once = flight.rate * gap <= T::of(T::CHATTER) * speed || gap <= lost;
    at_once && speed > lost && speed * speed <= T::of(T::CHATTER) * (flight.unit * flight.unit)
}

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// The end of a squeeze that an impact at `end` throws the masses on `beside` in: they have no speed along either normal, and rest
    /// on what presses. `before` is their acceleration before the impact, the velocity of which is known.
    #[inline(never)]
    pub(super) fn collapse(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
        [end, beside]: [End; 2],
        impact: Impact<T>,
        before: [T; N],
    ) -> Event<T> {
        self.bring_back(flight, tangents);
        let corner = self.contact.with(end).with(beside);
        self.point.state = rested(flight, &self.point.state, corner);
        let mut contact = corner;
        // Whether one presses depends on the other.
        for held in [end, beside, end] {
            let pressing = self.point.motion(flight, contact).pressure(held)[0];
            if contact.includes(held) && pressing < T::zero() {
                contact = contact.without(held.normal);
            }
        }
        for parted in [end, beside] {
            let joined = contact.with(parted);
            let pressing = self.point.motion(flight, joined).pressure(parted)[0];
            if !contact.includes(parted) && pressing > T::zero() {
                contact = joined;
            }
        }
        for parted in [end, beside] {
            if !contact.includes(parted) {
                // Pulled off at once: rounding must not make that another impact.
                let lost = unresolved(flight, parted, &self.point.state);
                let parting = -(parted.sign::<T>() * (lost + lost));
                self.point.state = placed_on(flight, &self.point.state, parted, parting);
            }
        }
        let after = self.point.motion(flight, contact).acceleration;
        let (velocity, kick) = (impact.velocity_before, impact.velocity_after - impact.velocity_before);
        let saltation = Saltation { normal: end.normal, velocity, kick, before, after, contact: corner };
        for tangent in tangents.iter_mut() {
            *tangent = tangent.squeezed(flight, &saltation);
        }
        (self.under_way, self.contact) = (false, contact);
        self.look_ahead(flight, tangents);
        let beside = Contact::FREE.with(beside);
        Event::Caught { impact, complete_chatter: true, beside, rebounds: T::zero() }
    }
}

impl<T: Real, const N: usize> Tangent<T, N> {
    /// Once all speed along the normals of a corner is lost at the instant of an impact, whose shift a deviation changes.
    #[inline(always)]
    #[must_use]
    fn squeezed(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        let shift = dot(&flight.normals[impact.normal].direction, &self.0.x) / impact.velocity;
        let v = axpy(-shift, &impact.before, &self.0.v);
        let Tangent(mut left) = Tangent(State { x: self.0.x, v }).caught(flight, impact.contact);
        left.v = axpy(shift, &impact.after, &left.v);
        Tangent(left)
    }
}
