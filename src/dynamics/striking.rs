//! Impacts that are approached from the safe side: restitution, and what follows where chatter is complete.

use pulp::NullaryFnOnce;

use super::chatter::{self, Closure, Rebound};
use super::closing::{Closing, swayed};
use super::contact;
use super::corner;
use super::imminent::Reached;
use super::placing::{placed_on, rested};
use super::point::{Approach, Motion, Point};
use super::pressing::rests;
use super::squeeze::squeezed;
use super::stop::{Contact, End, Stop};
use super::tangent::{FreeSaltation, Saltation, Tangent, catch_all, strike_all};
use super::trajectory::{Event, Impact, MOST_KICKS, Trajectory};
use crate::model::vector::{MOST, axpy, dot};
use crate::model::{Flight, Lanes, Real, State};

/// The energy that an impact takes, ½ m ((d·v−)² − (d·v+)²) with m = 1/(dᵀM⁻¹d).
#[inline(always)]
pub fn energy_taken<L: Lanes>(mass: L, before: L, after: L) -> L {
    mass.all(0.5) * mass * (before * before - after * after)
}

/// The energy that clamps take besides, of an impact along the normal `struck` that throws masses on them, whose speeds it changes by
/// u: ½ uᵀ (D M⁻¹ Dᵀ)⁻¹ u, D having a row for each contact that holds afterwards.
#[inline(always)]
pub fn taken_by_clamps<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    contact: Contact,
    struck: usize,
    kick: T,
) -> T {
    let mut taken = T::zero();
    if !contact.is_clamped() {
        return taken;
    }
    let mut thrown = [T::zero(); MOST];
    for (k, normal) in flight.normals().iter().enumerate() {
        if contact.is_clamped_along(k) {
            thrown[k] = kick * dot(&normal.direction, &flight.normals[struck].response);
        }
    }
    let matrix = &flight.pressing[contact.held() as usize];
    for (s, normal) in flight.normals().iter().enumerate() {
        for t in 0..flight.count {
            taken = taken + T::of(0.5) * normal.mass * thrown[s] * (matrix[s][t] * thrown[t]);
        }
    }
    taken
}

/// See [`Trajectory::strike`]; a type of its own, as [`Flown`](super::series::Flown) is.
struct Strike<'a, T, const N: usize> {
    trajectory: &'a mut Trajectory<T, N>,
    flight: &'a Flight<T, N>,
    tangents: &'a mut [Tangent<T, N>],
    reached: Reached<T>,
}

impl<T: Real, const N: usize> NullaryFnOnce for Strike<'_, T, N> {
    type Output = Event<T>;

    #[inline(always)]
    fn call(self) -> Event<T> {
        self.trajectory.strike_inlined(self.flight, self.tangents, self.reached)
    }
}

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// An impact, a time `left` ahead: restitution, and sticking where the rebounds that follow can be closed.
    #[inline(never)]
    pub(super) fn strike(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
        reached: Reached<T>,
    ) -> Event<T> {
        T::fused(Strike { trajectory: self, flight, tangents, reached })
    }

    #[inline(always)]
    fn strike_inlined(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
        Reached { end, left }: Reached<T>,
    ) -> Event<T> {
        let normal = &flight.normals[end.normal];
        let sign = end.sign::<T>();
        let speed = dot(&normal.direction, &self.point.state.v);
        if sign * speed < T::zero() {
            self.point.state.v = axpy(-speed, &normal.response, &self.point.state.v);
        }
        let held = self.contact;
        let arrived = self.point.nudged(flight, left, held);
        let before = arrived.motion(flight, held).acceleration;
        let velocity = dot(&normal.direction, &arrived.state.v);
        let rebound = -(normal.restitution[end.side] * velocity);
        let kick = rebound - velocity;
        self.point = Point { state: placed_on(flight, &arrived.state, end, rebound), ..arrived };
        self.offset = self.offset + left;
        if !held.is_free() {
            self.keep_pressed(flight, end.normal, kick);
        }
        let after = self.point.motion(flight, self.contact);
        let closed = self.closed(flight, end, rebound, &after);
        let impact =
            Impact { stop: Stop(normal.stop[end.side]), velocity_before: velocity, velocity_after: rebound };
        // Of two stops without restitution either may seem to end it at once.
        let at_once = |(_, rebounds, closing): &(_, T, Closing<T>)| {
            closing.gap_integral == T::zero() && *rebounds == T::zero()
        };
        if flight.count > 1
            && closed.as_ref().is_none_or(at_once)
            && velocity.abs() > contact::unresolved(flight, end, &arrived.state)
            && let Some(beside) = squeezed(flight, &self.point, self.contact, end)
        {
            return self.collapse(flight, tangents, [end, beside], impact, before);
        }
        // Where an impact takes masses off a contact, which throws them back, each stop by itself seems to end that, again and again.
        let freed = self.contact != held;
        let corner = if closed.is_none() || freed {
            corner::closes(flight, &self.point, self.contact, end)
        } else {
            None
        };
        let closed = closed.filter(|_| corner.is_none());
        // A speed that rounding cannot tell from 0 is no impact where the masses stay on the stop: it shifts nothing, and nothing
        // rebounds.
        let stays = closed.is_some() && velocity.abs() <= contact::unresolved(flight, end, &arrived.state);
        if velocity != T::zero() && !stays && !tangents.is_empty() {
            if self.under_way {
                let rest = (flight.h - self.offset) * flight.inverse_h;
                let wake = normal.wake(rest);
                let saltation = FreeSaltation { velocity, kick, pull: dot(&normal.direction, &before), wake };
                strike_all(tangents, flight, end.normal, rest, &saltation);
            } else {
                let (after, contact) = (after.acceleration, self.contact);
                let saltation = Saltation { normal: end.normal, velocity, kick, before, after, contact };
                for tangent in tangents.iter_mut() {
                    *tangent = tangent.struck(flight, &saltation);
                }
            }
        }
        let Some((resting, rebounds, closing)) = closed else {
            if let Some(corner) = corner {
                let beside = corner.since(self.contact.with(end));
                self.catch(flight, tangents, corner);
                self.point.state = rested(flight, &self.point.state, corner);
                return Event::Caught { impact, complete_chatter: true, beside, rebounds: T::zero() };
            }
            let lost = contact::unresolved(flight, end, &self.point.state);
            if rebound.abs() <= lost {
                // Pulled off the stop as soon as it is met: rounding must not make that another impact.
                let parting = -(sign * (lost + lost));
                self.point.state = placed_on(flight, &self.point.state, end, parting);
            }
            self.bounce(flight, tangents, end.normal, kick);
            return Event::Impact(impact);
        };
        let impact = if stays { Impact { velocity_before: T::zero(), ..impact } } else { impact };
        self.point = resting;
        if closing.speed > T::zero() && !stays && !tangents.is_empty() {
            self.bring_back(flight, tangents);
            self.under_way = false;
            for tangent in tangents.iter_mut() {
                *tangent = tangent.closed(flight, self.contact, &closing);
            }
        }
        self.catch(flight, tangents, self.contact.with(end));
        let complete_chatter = !stays && rebound.abs() > T::zero();
        Event::Caught { impact, complete_chatter, beside: Contact::FREE, rebounds }
    }

    /// Where the rebounds that follow an impact end at rest, how long they take, and what of them a deviation changes, if closing them
    /// is as good as following them.
    #[inline(always)]
    fn closed(
        &self,
        flight: &Flight<T, N>,
        end: End,
        rebound: T,
        after: &Motion<T, N>,
    ) -> Option<(Point<T, N>, T, Closing<T>)> {
        let normal = &flight.normals[end.normal];
        let along = self.point.approach(flight, after, end.normal);
        let sign = end.sign::<T>();
        let towards = Approach { acceleration: sign * along.acceleration, jerk: sign * along.jerk, ..along };
        let room = T::of(f64::from(flight.steps - self.step)) * flight.h - self.offset;
        let rebound = Rebound {
            speed: rebound.abs(),
            restitution: normal.restitution[end.side],
            unresolved: contact::unresolved(flight, end, &self.point.state),
            room,
        };
        let (speed, force) = (rebound.speed, towards.acceleration);
        let closing = Closing { end, speed, force, gap_integral: T::zero() };
        if rebound.speed <= rebound.unresolved && rests(flight, &self.point, self.contact, end) {
            return Some((self.at_rest(flight, end, T::zero()), T::zero(), closing));
        }
        let Closure { gap_integral, height, time, lasts } =
            chatter::close(flight, normal, &rebound, &towards)?;
        let resting = self.at_rest(flight, end, gap_integral);
        let contact = self.contact.with(end);
        // Without height they are over at once, or damping alone ends what is as good as rest.
        let closing = if height > T::zero() { Closing { gap_integral, ..closing } } else { closing };
        contact::clears_elsewhere(flight, &resting, contact, end, height, lasts)
            .then_some((resting, time, closing))
    }

    /// An impact that ends in flight: the end of the step is where the kick takes it.
    #[inline(always)]
    fn bounce(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>], normal: usize, kick: T) {
        if !self.under_way {
            self.look_ahead(flight, tangents);
            return;
        }
        self.kicks += 1;
        if self.kicks <= MOST_KICKS {
            let rest = flight.h - self.offset;
            let wake = flight.normals[normal].wake(rest * flight.inverse_h);
            self.ahead = self.ahead.kicked(kick, &wake);
        }
    }

    /// From now on these contacts hold.
    #[inline(always)]
    fn catch(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>], contact: Contact) {
        self.bring_back(flight, tangents);
        catch_all(tangents, flight, contact);
        self.under_way = false;
        self.contact = contact;
    }

    /// The end of a chatter sequence whose rebounds opened the gap for `gap_integral` in all: meanwhile springs and dampers
    /// acted on the masses that are free with the contact, and now it holds.
    #[inline(always)]
    fn at_rest(&self, flight: &Flight<T, N>, end: End, gap_integral: T) -> Point<T, N> {
        let contact = self.contact.with(end);
        let swayed = swayed(flight, contact, end.normal);
        let signed = -(end.sign::<T>() * gap_integral);
        let State { x, v } = self.point.state;
        let state = State { x: axpy(signed, &swayed.x, &x), v: axpy(signed, &swayed.v, &v) };
        Point { state: rested(flight, &state, contact), ..self.point }
    }

    /// After an impact along the normal `struck`: a contact whose speed this changes, by more than is lost in rounding, no
    /// longer holds; where it is directed into the stop, the next move is an impact there, at the same instant.
    #[inline(always)]
    fn keep_pressed(&mut self, flight: &Flight<T, N>, struck: usize, kick: T) {
        let response = &flight.normals[struck].response;
        for (k, normal) in flight.normals().iter().enumerate() {
            let Some(end) = self.contact.end_along(k) else { continue };
            let change = kick * dot(&normal.direction, response);
            let lost = contact::unresolved(flight, end, &self.point.state)
                + T::of(contact::KICK_ROUNDINGS) * T::epsilon() * kick.abs();
            if !self.contact.is_clamped_along(k) && change.abs() > lost {
                self.contact = self.contact.without(k);
            }
        }
        self.point.state = rested(flight, &self.point.state, self.contact);
    }
}
