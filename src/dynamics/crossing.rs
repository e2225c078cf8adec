//! Contact found directly: the time at which a leg meets a stop, and where, with a certificate that it meets none before.

use std::hint::black_box;

use super::chatter::{FADING, STEADY};
use super::face::Face;
use super::hull::Hull;
use super::leg::{Clearances, Leg};
use super::point::Point;
use super::quintic::Quintic;
use super::tangent::FreeSaltation;
use super::touching::{is_deep, pulled, turns_off};
use crate::model::vector::{MOST, dot};
use crate::model::{Flight, Lanes, Mask, Real, State};

/// A contact, and the flight after it.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<L: Lanes, const N: usize> {
    /// Where all this holds: elsewhere the stops must be approached from the safe side.
    pub certain: L::Mask,
    /// Where the leg comes near to a stop, turns, and provably stays off all stops.
    pub passes: L::Mask,
    /// The normal that is met: one of them where it is certain.
    pub normals: [L::Mask; MOST],
    /// Where it is met at its upper end.
    pub upper: L::Mask,
    /// The time since the beginning of the leg.
    pub time: L,
    /// Just after the impact.
    pub point: Point<L, N>,
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
    let Leg { from, to, window } = *leg;
    let zero = window.all(0.0);
    let pulls = [face.towards(&from.accelerations(flight)), face.towards(&to.accelerations(flight))];
    let speeds = [face.towards(&from.state.v), face.towards(&to.state.v)];
    let gaps = [face.open(&from.state), face.open(&to.state)];
    let gap = Quintic::through(gaps, speeds, pulls, window);
    let mut u = Quintic::chord(gaps, speeds[0] * window);
    // Where the leg returns, the gap is narrowest on its way; few do.
    let (mut turns, mut opens) = (u, face.returns.and(face.returns.not()));
    if face.returns.bits() != 0 {
        let narrowest = gap.narrowest(speeds[1] * window);
        turns = narrowest.u;
        opens = face.returns.and(zero.below(narrowest.gap));
        u = L::select(face.returns, narrowest.touch(), u);
    }
    let u = L::select(opens, turns, gap.root(u));

    // From the nearer end of the step, and what is left of the way as if the acceleration changed steadily.
    let near = u.below(zero.all(0.5));
    let base = Point::select(near, from, to);
    // The constants are read again here and below: without these hints they are copied to the stack above.
    let flight = black_box(flight);
    let reached = base.flown_near(flight, window * L::select(near, u, u - zero.all(1.0)));
    let acceleration = reached.accelerations(flight);
    let jerk = reached.jerks(flight, &acceleration);
    let snap = reached.snaps(flight, &acceleration, &jerk);
    let left = face.open(&reached.state);
    let speed = face.towards(&reached.state.v);
    let mut passes = opens;
    if opens.bits() != 0 {
        passes = opens.and(turns_off(leg, &face, &reached, u, flight));
    }
    let straight = left / speed;
    let bend = face.towards(&acceleration);
    let turn = face.towards(&jerk) * zero.all(0.5);
    let nearly = left / (bend * zero.all(0.5)).times_plus(straight, speed);
    let far = (turn * zero.all(1.0 / 3.0)).times_plus(nearly, bend * zero.all(0.5)).times_plus(nearly, speed);
    let steep = turn.times_plus(nearly, bend).times_plus(nearly, speed);
    let slide = nearly - far.times_plus(nearly, -left) / steep;
    let (arrived, before) = reached.slid(flight, slide, [&acceleration, &jerk, &snap]);
    let time = u.times_plus(window, slide);

    let velocity = dot(&face.direction, &arrived.state.v);
    let rebound = -(face.restitution * velocity);
    let kick = rebound - velocity;
    let point = Point { state: face.placed(&arrived.state, rebound), ..arrived };
    let flight = black_box(flight);
    let after = point.accelerations(flight);
    let close = (slide.magnitude() * flight.rate).below(zero.all(L::Real::STRAIGHT));
    let within = zero.below(time).and(time.below(window));
    let arrives = face.sign * velocity;
    let first = is_first(&face, [speeds[0], arrives], pulls, time, window).or(stays_off(
        &face,
        gaps[0],
        [speeds[0], arrives],
        time,
    ));
    let parts = parts_for_good(&face, flight, rebound, &point.state.v, face.towards(&after));
    let rounding = face.rounding(&arrived.state, window * velocity);
    let deep = face.returns.not().or(is_deep(&face, arrives, pulls, window, rounding));
    let certain = face.only.and(close).and(within).and(first).and(parts);
    let certain = certain.and(deep).and(face.meets(&arrived.state, rounding));
    let Face { direction, normals, upper, .. } = face;
    let left_of_step = (window - time) * flight.inverse_h;
    let mut wake = flight.normals[0].wake(left_of_step);
    for (normal, &met) in flight.normals.iter().zip(&normals).take(flight.count).skip(1) {
        wake = State::select(met, &normal.wake(left_of_step), &wake);
    }
    let ahead = to.kicked(kick, &wake);
    let passes = passes.and(certain.not());
    let impact = FreeSaltation { velocity, kick, pull: dot(&direction, &before), wake };
    Crossing { certain, passes, normals, upper, time, point, ahead, impact, rebound }
}

/// Where a contact after `time` is the first: the way to it is monotone, or bends towards the stop while it stays off the
/// other one.
#[inline(always)]
fn is_first<L: Lanes, const N: usize>(
    face: &Face<L, N>,
    [leaves, arrives]: [L; 2],
    pulls: [L; 2],
    time: L,
    window: L,
) -> L::Mask {
    let zero = window.all(0.0);
    let [least, most] = pulled(face, pulls, window);
    let sets_out = zero.below(least.smaller(zero).times_plus(time, leaves));
    let comes_in = zero.below((-most.larger(zero)).times_plus(time, arrives));
    let bends = zero.below(least).and(face.opposite_clear);
    zero.below(arrives).and(sets_out.or(comes_in).or(bends))
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
    let hull = Hull::of([gap, zero], [-leaves, -arrives], face.bound, time);
    // No comparison with a NaN holds.
    let sound = zero.below(hull.lower);
    let off = face.opposite_clear.or(hull.highest().below(face.width));
    sound.and(zero.below(hull.lowest())).and(off)
}

/// Where the rebounds that follow an impact can surely not be closed, so that it ends in flight; see
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
    let mut size = face.gap.magnitude() + speed.all(1.0);
    for (direction, speed) in face.direction.iter().zip(v) {
        size = size + (*direction * *speed).magnitude();
    }
    let slow = (size * speed.all(L::Real::EPSILON)).larger(speed.all(FADING));
    let one = speed.all(1.0);
    let loss = one - face.restitution;
    let cubic_loss = one - face.restitution * face.restitution * face.restitution;
    // The change of the force over the sequence is at least rate · 2u/(a(1 − r)).
    let drift = (flight.rate + flight.rate) * speed;
    let steady = drift.below(force * loss * speed.all(STEADY * WIDER));
    let effect = face.coupling * drift * (speed * speed * speed) * speed.all(2.0 / 3.0);
    let lost =
        effect.below((force * force * force) * (loss * cubic_loss) * speed.all(L::Real::CHATTER * WIDER));
    let zero = speed.all(0.0);
    let may_close = zero.below(force).and(steady).and(lost);
    slow.below(speed).and(may_close.not())
}

/// What rounding may add to a bound.
pub const WIDER: f64 = 1.001;

#[cfg(test)]
mod tests;
