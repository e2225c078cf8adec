//! Contact found directly: the time at which a leg meets a stop, and where, with a certificate that it meets none before.

use super::along::{Along, Alongs, is_normal};
use super::chatter::{FADING, STEADY};
use super::course::{Course, Here};
use super::face::Face;
use super::hull::{Hull, Span};
use super::leg::{Clearances, Leg};
use super::point::Point;
use super::quintic::Quintic;
use super::tangent::FreeSaltation;
use super::touching::{is_deep, turns_off};
use crate::model::vector::dot;
use crate::model::{Flight, Lanes, Mask, Real, State};

/// A contact, and the flight after it.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<L: Lanes, const N: usize> {
    /// Where all this holds: elsewhere the stops must be approached from the safe side.
    pub certain: L::Mask,
    /// Where the leg comes near to a stop, and provably stays off all stops.
    pub passes: L::Mask,
    /// The number of the normal that is met.
    pub normal: L,
    /// Where it is met at its upper end.
    pub upper: L::Mask,
    /// The time since the beginning of the leg.
    pub time: L,
    /// The share of a whole step that is left.
    pub rest: L,
    /// Where the motion is along each normal just after the impact.
    pub after: Alongs<L>,
    /// Where the step ends now.
    pub ahead: Point<L, N>,
    /// The impact as deviations meet it.
    pub impact: FreeSaltation<L, N>,
    /// d·v+.
    pub rebound: L,
}

/// The contact of a leg, with its clearances, that ends beyond one stop, or touches one and returns; nothing is certain
/// elsewhere.
#[inline(always)]
pub fn crossing<L: Lanes, const N: usize>(
    leg: &Leg<'_, L, N>,
    clearances: &Clearances<L::Mask>,
    flight: &Flight<L, N>,
) -> Crossing<L, N> {
    let face = Face::of(leg, clearances, flight);
    let Face { sign, way, .. } = face;
    let mut begun = Course::begun(leg.end, leg.to[0].speed, flight, 0);
    for k in 1..leg.from.count {
        let other = Course::begun(leg.end, leg.to[k].speed, flight, k);
        begun = Course::select(is_normal(face.normal, k), &other, &begun);
    }
    let window = leg.span.time;
    let (zero, one) = (window.all(0.0), window.all(1.0));
    // The gap, seen from the end of the leg: u is the share of it that is left.
    let whole = leg.share(flight);
    let [bend, twist] = begun.bends();
    let square = -sign * (whole * whole);
    let leaves = sign * way.from.speed;
    let slopes = [sign * way.to.speed * window, leaves * window];
    let gaps = [face.open(way.to.place), face.open(way.from.place)];
    let gap = Quintic::through(gaps, slopes, [square * bend, square * whole * twist]);
    let mut u = one - Quintic::chord([gaps[1], gaps[0]], slopes[1]);
    // Where the leg returns, it is asked about where the gap is narrowest; few do.
    let (mut turns, mut opens) = (u, face.returns.and(face.returns.not()));
    if face.returns.bits() != 0 {
        let narrowest = gap.narrowest(slopes[1]);
        turns = narrowest.u;
        opens = face.returns.and(zero.below(narrowest.gap));
        u = L::select(face.returns, narrowest.touch(), u);
    }
    // The root does not ask for the other terms: it is a chain of operations that wait for each other, beside which there is room.
    let mut course = begun.completed(leg.end, flight, 0);
    for k in 1..leg.from.count {
        course = Course::select(is_normal(face.normal, k), &begun.completed(leg.end, flight, k), &course);
    }
    let u = L::select(opens, turns, gap.root(u));

    // What that misses is little: the course itself says how much.
    let stop = sign * face.gap;
    let mut nearly = u * whole;
    let mut here = course.about(nearly, [whole, way.from.place]);
    let mut passes = opens;
    if opens.bits() != 0 {
        passes = opens.and(turns_off(leg, &face, here.along(flight), [one - u, nearly], flight));
    }
    let mut change = here.change_to(stop);
    // Where it is not little, as where the stop is met slowly, it is asked again from there.
    let again = face.only.and(opens.not()).and(is_little(change, flight).not());
    if L::Real::ASKS_AGAIN && again.bits() != 0 {
        let nearer = nearly + change;
        let there = course.about(nearer, [whole, way.from.place]);
        change = L::select(again, there.change_to(stop), change);
        nearly = L::select(again, nearer, nearly);
        here = Here::select(again, &there, &here);
    }
    let there = here.changed(change);
    let rest = nearly + change;
    let time = window - rest * flight.h;

    let Along { place, speed: velocity } = there.along(flight);
    let rebound = -(face.restitution * velocity);
    let kick = rebound - velocity;
    let pull = there.pull(flight);
    let force = sign * (pull - face.drag * kick);
    let close = is_little(change, flight);
    let within = zero.below(time).and(time.below(window));
    let arrives = sign * velocity;
    let first = stays_off(&face, gaps[1], [leaves, arrives], time);
    let parts = parts_for_good(&face, flight, rebound, &leg.end.state.v, force);
    let rounding = face.rounding(&leg.end.state, window * velocity);
    let last = (bend + bend) * (flight.inverse_h * flight.inverse_h);
    let deep = face.returns.not().or(is_deep(&way, arrives, [sign * pull, sign * last], rounding));
    let meets = (face.open(place).magnitude() * zero.all(EXACT)).below(rounding);
    let certain = face.only.and(close).and(within).and(first).and(parts).and(deep).and(meets);
    let Face { normal, upper, .. } = face;
    let mut wake = flight.normals[0].wake(rest);
    for k in 1..leg.from.count {
        wake = State::select(is_normal(normal, k), &flight.normals[k].wake(rest), &wake);
    }
    let after = struck(leg, &face, [rest, kick], Along { place: stop, speed: rebound }, flight);
    let ahead = leg.end.kicked(kick, &wake);
    let passes = passes.and(certain.not());
    let impact = FreeSaltation { velocity, kick, pull, wake };
    Crossing { certain, passes, normal, upper, time, rest, after, ahead, impact, rebound }
}

/// Where a change of the share of a step is so small that what is known of the course near by says where it leads.
#[inline(always)]
fn is_little<L: Lanes, const N: usize>(change: L, flight: &Flight<L, N>) -> L::Mask {
    (change.magnitude() * (flight.h * flight.rate)).below(change.all(L::Real::STRAIGHT))
}

/// Where the motion is along each normal just after an impact: on the stop with its rebound, and where the step goes along the
/// others, with what the kick changes there.
#[inline(always)]
fn struck<L: Lanes, const N: usize>(
    leg: &Leg<'_, L, N>,
    face: &Face<L, N>,
    [rest, kick]: [L; 2],
    own: Along<L>,
    flight: &Flight<L, N>,
) -> Alongs<L> {
    let mut each = leg.each(rest, (face.normal, own), flight);
    if each.count > 1 {
        for k in 0..each.count {
            let change = dot(&flight.normals[k].direction, &face.response);
            let changed = Along { speed: kick.times_plus(change, each[k].speed), ..each[k] };
            each.set(k, Along::select(is_normal(face.normal, k), &own, &changed));
        }
    }
    each
}

/// Where a contact after `time` is the first since the gap lies within its [`Hull`] on the way there, and that between the stops.
/// It begins where the trajectory is, and ends with the contact.
#[inline(always)]
fn stays_off<L: Lanes, const N: usize>(
    face: &Face<L, N>,
    gap: L,
    [leaves, arrives]: [L; 2],
    time: L,
) -> L::Mask {
    let zero = time.all(0.0);
    let hull = Hull::of([gap, zero], [-leaves, -arrives], face.way.bound, &Span::of(time));
    let off = face.opposite_clear.or(hull.highest().below(face.width));
    zero.below(hull.lowest()).and(off)
}

/// Where the rebounds that follow an impact can surely not be closed, so that it ends in flight, `v` being velocities near by; see
/// [`close`](super::chatter::close).
#[inline(always)]
fn parts_for_good<L: Lanes, const N: usize>(
    face: &Face<L, N>,
    flight: &Flight<L, N>,
    rebound: L,
    v: &[L; N],
    force: L,
) -> L::Mask {
    let speed = rebound.magnitude();
    let mut size = face.gap.magnitude() + flight.unit;
    for (direction, speed) in face.direction.iter().zip(v) {
        size = size + (*direction * *speed).magnitude();
    }
    let slow = (size * speed.all(L::Real::EPSILON)).larger(speed.all(FADING) * flight.unit);
    let one = speed.all(1.0);
    let loss = one - face.restitution;
    let cubic_loss = one - face.restitution * face.restitution * face.restitution;
    // The change of the force over the sequence is at least rate · 2u/(a(1 − r)).
    let drift = (flight.rate + flight.rate) * speed;
    let steady = drift.below(force * loss * speed.all(STEADY * WIDER));
    // u/a is no smaller where all is small, as powers of either are.
    let ratio = speed / force;
    let effect = face.coupling * drift * (ratio * ratio * ratio) * speed.all(2.0 / 3.0);
    let lost = effect.below((loss * cubic_loss) * (speed.all(L::Real::CHATTER * WIDER) * flight.unit));
    let zero = speed.all(0.0);
    let may_close = zero.below(force).and(steady).and(lost);
    slow.below(speed).and(may_close.not())
}

/// A contact is accepted only this many times nearer to its stop than rounding may make it seem.
pub const EXACT: f64 = 8.0;
/// What rounding may add to a bound.
pub const WIDER: f64 = 1.001;

#[cfg(test)]
mod tests;
