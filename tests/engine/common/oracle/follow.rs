//! A trajectory through flights, impacts, chatter, sticking and release.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::crossing::{self, Watched};
use super::flow::{Flow, Functional};
use super::linear::{DIMENSION, Vector};
use super::plant::{Plant, index};
use super::real::Real;

/// A rebound slower than this is the end of a chatter, against a force that keeps pressing.
pub const DEAD_REBOUND: f64 = 1e-9;

/// A rebound that f64 cannot tell from rest, whatever the force does next.
const REST: f64 = 1e-13;

/// More events than this in one forcing period are not followed: with r = 1 a pressed M1 hops on for ever, ever faster
/// where there is damping.
const EVENTS_PER_PERIOD: usize = 30_000;

/// One of the two stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// x1 = −δ (Ā).
    Minus,
    /// x1 = +δ (A).
    Plus,
}

/// One impact.
#[derive(Clone, Copy, Debug)]
pub struct Impact {
    /// Time since the start of the forcing period.
    pub time: f64,
    /// The stop that was hit.
    pub stop: Stop,
    /// v1 just before.
    pub velocity_before: f64,
    /// v1 just after.
    pub velocity_after: f64,
    /// Displacement of the second mass.
    pub x2: f64,
    /// Velocity of the second mass.
    pub v2: f64,
}

/// M1 at rest on a stop, within one forcing period.
#[derive(Clone, Copy, Debug)]
pub struct Stick {
    /// Time of coming to rest since the start of the forcing period; 0 also where it rested before.
    pub from: f64,
    /// Time of release, or `None` where it rests on into the next period.
    pub until: Option<f64>,
}

/// Stops that are not where they should be, differently at every impact.
#[derive(Clone, Debug)]
struct Roughness {
    depth: f64,
    rng: ChaCha8Rng,
}

/// Everything that happened in one forcing period.
#[derive(Clone, Debug, Default)]
pub struct Period {
    /// (x1, x2, v1, v2) at its end, forcing phase 0.
    pub strobe: [f64; 4],
    /// The impacts, in order; of a complete chatter those that were followed one by one.
    pub impacts: Vec<Impact>,
    /// The rests, in order.
    pub sticks: Vec<Stick>,
    /// Complete chatters at (Ā, A).
    pub chatters: [u32; 2],
}

impl Period {
    /// Impacts at (Ā, A).
    pub fn counts(&self) -> [u32; 2] {
        [Stop::Minus, Stop::Plus].map(|stop| self.impacts.iter().filter(|i| i.stop == stop).count() as u32)
    }
}

/// What all trajectories of a system share.
#[derive(Debug)]
struct Machine<R> {
    plant: Plant,
    period: R,
    flying: Flow<R>,
    resting: Flow<R>,
    /// The distance to the reference stop in flight, seen from the stop at +δ.
    near: Functional<R>,
    /// The distance to the other stop, seen from the stop at +δ.
    far: Functional<R>,
    /// The acceleration of M1 in flight, on the flying and on the resting flow.
    acceleration: [Functional<R>; 2],
}

impl<R: Real> Machine<R> {
    fn new(plant: Plant) -> Self {
        let (free, resting) = (plant.free(), plant.resting());
        let unit = |i: usize, value: f64| -> Vector<R> {
            let mut row = [R::of(0.0); DIMENSION];
            row[i] = R::of(value);
            row
        };
        let mut far = unit(index::Y, 1.0);
        far[index::STOP] = R::of(2.0);
        let push = free[index::V1].map(R::rounded);
        let flying = Flow::new(&free, plant.period());
        let resting = Flow::new(&resting, plant.period());
        Machine {
            plant,
            period: R::rounded(plant.period()),
            near: flying.functional(unit(index::Y, -1.0)),
            far: flying.functional(far),
            acceleration: [flying.functional(push), resting.functional(push)],
            flying,
            resting,
        }
    }
}

/// Follows one trajectory, exactly to the rounding of `R`.
#[derive(Clone, Debug)]
pub struct Follower<R> {
    machine: Arc<Machine<R>>,
    /// Time since the start of the forcing period.
    time: R,
    state: Vector<R>,
    rests: bool,
    /// Whether the state is that of a contact: the near gap is exactly zero.
    touches: bool,
    dead_rebound: f64,
    roughness: Option<Roughness>,
    record: Period,
    events: usize,
}

/// The mirror image x → −x where the reference stop is −δ, so that only the stop at +δ needs functionals.
fn facing<R: Real>(sign: f64, row: &Vector<R>) -> Vector<R> {
    row.map(|entry| R::of(sign) * entry)
}

impl<R: Real> Follower<R> {
    /// A trajectory that starts at forcing phase 0.
    pub fn new(plant: Plant, start: [f64; 4]) -> Self {
        Self::on(Arc::new(Machine::new(plant)), start)
    }

    /// Another trajectory of the same system.
    #[must_use]
    pub fn another(&self, start: [f64; 4]) -> Self {
        Self::on(self.machine.clone(), start)
    }

    fn on(machine: Arc<Machine<R>>, start: [f64; 4]) -> Self {
        let mut follower = Follower {
            machine,
            time: R::of(0.0),
            state: [R::of(0.0); DIMENSION],
            rests: false,
            touches: false,
            dead_rebound: DEAD_REBOUND,
            roughness: None,
            record: Period::default(),
            events: 0,
        };
        follower.place(start.map(R::of));
        follower
    }

    /// The same trajectory with another speed at which chatter counts as dead.
    #[must_use]
    pub fn with_dead_rebound(mut self, speed: f64) -> Self {
        self.dead_rebound = speed;
        self
    }

    /// The same trajectory between stops that are rough: every impact happens up to `depth`·δ early or late.
    #[must_use]
    pub fn with_roughness(mut self, depth: f64, seed: u64) -> Self {
        let depth = depth * self.machine.plant.parameters.delta;
        self.roughness = Some(Roughness { depth, rng: ChaCha8Rng::seed_from_u64(seed) });
        self
    }

    /// The period of the forcing.
    pub fn period(&self) -> R {
        self.machine.period
    }

    /// (x1, x2, v1, v2) now.
    pub fn position(&self) -> [f64; 4] {
        let z = &self.state;
        [z[index::Y] + z[index::STOP], z[index::X2], z[index::V1], z[index::V2]].map(R::f64)
    }

    /// Whether M1 rests on a stop now.
    pub fn rests(&self) -> bool {
        self.rests
    }

    /// Whether there were too many events in one forcing period to go on: the trajectory has no truth from then on.
    pub fn is_exhausted(&self) -> bool {
        self.events >= EVENTS_PER_PERIOD
    }

    /// The smaller distance to a stop now: to the last bit of the distance, not of x1.
    pub fn gap(&self) -> f64 {
        let z = self.seen();
        self.machine.near.derivative(0, &z).f64().min(self.machine.far.derivative(0, &z).f64())
    }

    /// Follows one forcing period from phase 0 to phase 0.
    pub fn next_period(&mut self) -> Period {
        self.advance(self.machine.period);
        self.finish_period()
    }

    /// Closes a forcing period that [`Follower::advance`] has reached the end of.
    pub fn finish_period(&mut self) -> Period {
        self.time = R::of(0.0);
        self.set_phasor();
        self.events = if self.is_exhausted() { self.events } else { 0 };
        let strobe = self.position();
        let mut period = std::mem::take(&mut self.record);
        period.strobe = strobe;
        if self.rests {
            self.record.sticks.push(Stick { from: 0.0, until: None });
        }
        period
    }

    /// Follows the trajectory up to a time within the forcing period.
    pub fn advance(&mut self, until: R) {
        while self.time < until && !self.is_exhausted() {
            self.events += 1;
            if self.rests { self.rest(until) } else { self.fly(until) }
        }
    }

    /// Moves the state by a small displacement, as far as the stops and a rest leave room for it.
    pub fn nudge(&mut self, by: [f64; 4]) {
        for (i, component) in [(index::X2, 1), (index::V2, 3)] {
            self.state[i] = self.state[i] + R::of(by[component]);
        }
        if !self.rests && !self.touches {
            let mut moved = self.state;
            moved[index::Y] = moved[index::Y] + R::of(by[0]);
            let seen = facing(self.sign(), &moved);
            let inside = [&self.machine.near, &self.machine.far]
                .iter()
                .all(|gap| gap.derivative(0, &seen) > R::of(0.0));
            if inside {
                self.state[index::Y] = moved[index::Y];
                self.state[index::V1] = self.state[index::V1] + R::of(by[2]);
            }
        }
    }

    /// Gives a resting M1 a velocity away from its stop.
    pub fn kick(&mut self, velocity: f64) {
        self.rests = false;
        self.state[index::V1] = R::of(velocity);
    }

    fn sign(&self) -> f64 {
        if self.state[index::STOP] < R::of(0.0) { -1.0 } else { 1.0 }
    }

    fn stop(&self) -> Stop {
        if self.sign() > 0.0 { Stop::Plus } else { Stop::Minus }
    }

    /// The state as seen by the functionals.
    fn seen(&self) -> Vector<R> {
        facing(self.sign(), &self.state)
    }

    fn place(&mut self, [x1, x2, v1, v2]: [R; 4]) {
        let zero = R::of(0.0);
        let delta = R::of(self.machine.plant.parameters.delta);
        let stop = if x1 < zero { -delta } else { delta };
        self.time = zero;
        self.state = [x1 - stop, x2, v1, v2, zero, zero, stop];
        self.set_phasor();
        self.record = Period::default();
        self.rests = false;
        self.touches = self.state[index::Y] == zero;
        if self.touches {
            self.meet(self.seen()[index::V1] > zero);
        }
    }

    fn set_phasor(&mut self) {
        let mut phasor = [R::of(0.0); DIMENSION];
        phasor[index::COS] = R::of(1.0);
        let turned = self.machine.flying.at(&phasor, self.time);
        self.state[index::SIN] = turned[index::SIN];
        self.state[index::COS] = turned[index::COS];
    }

    /// Flies to the next impact or to the end.
    fn fly(&mut self, until: R) {
        let seen = self.seen();
        let from = if self.touches { self.surely_clear(&seen) } else { R::of(0.0) };
        let watched = [
            Watched { functional: &self.machine.near, from },
            Watched { functional: &self.machine.far, from: R::of(0.0) },
        ];
        let span = until - self.time;
        let Some((after, which)) = crossing::first(&self.machine.flying, &seen, &watched, span) else {
            self.state = self.machine.flying.at(&self.state, span);
            self.time = until;
            self.set_phasor();
            self.touches = false;
            return;
        };
        self.state = self.machine.flying.at(&self.state, after);
        self.time = self.time + after;
        self.set_phasor();
        if which == 1 {
            self.state[index::STOP] = -self.state[index::STOP];
        }
        self.state[index::Y] = R::of(0.0);
        self.touches = true;
        let hits = self.seen()[index::V1] > R::of(0.0);
        self.meet(hits);
    }

    /// How long M1 is proven to stay clear of the stop that it leaves, by bounds on the third or fourth derivative.
    fn surely_clear(&self, seen: &Vector<R>) -> R {
        let derivative = |order| self.machine.near.derivative(order, seen).f64();
        let bound = |order| self.machine.flying.bound(&self.machine.near, order, seen);
        let (speed, acceleration, jerk) = (derivative(1), derivative(2), derivative(3));
        let clear = if speed > 0.0 || acceleration > 1e-13 {
            let root = (acceleration * acceleration + 2.0 * bound(3) * speed.max(0.0)).sqrt();
            if acceleration < 0.0 {
                2.0 * speed / (root - acceleration)
            } else {
                (acceleration + root) / bound(3)
            }
        } else {
            3.0 * jerk.max(1e-9) / bound(4)
        };
        R::of((0.9 * clear).min(self.machine.flying.step().f64()))
    }

    /// At a stop with y = 0: an impact where M1 moves outwards, then a rest where the rebounds are dead.
    fn meet(&mut self, hits: bool) {
        let r = self.machine.plant.parameters.r;
        if hits {
            self.roughen();
            let before = self.state[index::V1];
            self.state[index::V1] = -(R::of(r) * before);
            self.record.impacts.push(Impact {
                time: self.time.f64(),
                stop: self.stop(),
                velocity_before: before.f64(),
                velocity_after: self.state[index::V1].f64(),
                x2: self.state[index::X2].f64(),
                v2: self.state[index::V2].f64(),
            });
        }
        let rebound = -self.seen()[index::V1].f64();
        if rebound > 0.0 && !self.is_dead(rebound) {
            return;
        }
        let mut still = self.seen();
        still[index::V1] = R::of(0.0);
        if self.machine.acceleration[1].derivative(0, &still) > R::of(0.0) {
            if rebound > 0.0 {
                self.record.chatters[usize::from(self.stop() == Stop::Plus)] += 1;
            }
            self.rests = true;
            self.state[index::V1] = R::of(0.0);
            self.record.sticks.push(Stick { from: self.time.f64(), until: None });
        }
    }

    /// Shifts the impact that is about to happen to where a rough stop would be: the force on the way does the work.
    fn roughen(&mut self) {
        let seen = self.seen();
        let force = self.machine.acceleration[0].derivative(0, &seen).f64();
        if let Some(Roughness { depth, rng }) = &mut self.roughness {
            let speed = seen[index::V1].f64();
            let work = rng.random_range(-*depth..*depth) * force;
            let factor = (1.0 + 2.0 * work / (speed * speed)).max(0.0).sqrt();
            self.state[index::V1] = self.state[index::V1] * R::of(factor);
        }
    }

    /// Whether the hops that follow a rebound are below all effect, and die out before the force can change sign.
    fn is_dead(&self, rebound: f64) -> bool {
        let r = self.machine.plant.parameters.r;
        if r >= 1.0 {
            return false;
        }
        let seen = self.seen();
        let pressing = self.machine.acceleration[0].derivative(0, &seen).f64();
        let change = self.machine.acceleration[0].derivative(1, &seen).f64().abs();
        let lasting = 1e-3 * pressing * pressing * (1.0 - r);
        pressing > 0.0 && (rebound < REST || rebound < self.dead_rebound && rebound * change < lasting)
    }

    /// Rests until the force on M1 pulls, or to the end.
    fn rest(&mut self, until: R) {
        let seen = self.seen();
        let watched = [Watched { functional: &self.machine.acceleration[1], from: R::of(0.0) }];
        let span = until - self.time;
        let release = crossing::first(&self.machine.resting, &seen, &watched, span);
        self.state = self.machine.resting.at(&self.state, release.map_or(span, |(after, _)| after));
        self.time = release.map_or(until, |(after, _)| self.time + after);
        self.set_phasor();
        if release.is_some() {
            self.rests = false;
            self.touches = true;
            let released = self.time.f64();
            let stick = self.record.sticks.last_mut().expect("a rest has been recorded");
            stick.until = Some(released);
        }
    }
}
