//! A trajectory of any plant, event by event.

use std::collections::HashMap;
use std::sync::Arc;

use impact_atlas::system::{Plant, PlantStop};

use super::crossing::first_positive;
use super::mode::{Augmented, Mode, at_phase_zero, place, restore_phase, speed};

/// Terms of a Taylor series within a grid step, in which rates are below [`FINENESS`].
const TERMS: usize = 16;
const FINENESS: f64 = 0.1;

/// Speeds up to this, relative to the velocities, count as none: a mass that rebounds no faster rests if it is pressed.
const REST: f64 = 1e-13;

/// Events in one period beyond which a trajectory is given up.
const MOST_EVENTS: u32 = 4000;

/// What happened in one forcing period.
#[derive(Clone, Debug, Default)]
pub struct Period {
    /// The state at its end: x1 … xn, v1 … vn.
    pub strobe: Vec<f64>,
    /// Impacts at each stop.
    pub impacts: [u32; 4],
    /// Whether rebounds came to an end on a stop: their number is infinite.
    pub chatters: bool,
    /// Whether two impacts happened at one instant.
    pub coincides: bool,
    /// Stops that were left, with the time since the beginning of the period.
    pub releases: Vec<(usize, f64)>,
    /// The stops in contact at its end.
    pub held: Vec<usize>,
}

/// A trajectory.
#[derive(Clone, Debug)]
pub struct Follower {
    plant: Arc<Plant>,
    /// The order in which stops that are reached at one instant are struck.
    rank: Vec<usize>,
    modes: HashMap<Vec<usize>, Arc<Mode>>,
    gaps: Vec<f64>,
    z: Augmented,
    held: Vec<usize>,
    /// How many of the first Taylor coefficients of each stop's d·x − gap are 0 here.
    touching: [usize; 4],
    steps: u32,
    step: f64,
    events: u32,
    exhausted: bool,
    period: Period,
}

impl Follower {
    /// Begins at forcing phase 0 with x1 … xn, v1 … vn within the stops.
    pub fn new(plant: Plant, start: &[f64]) -> Self {
        let period = plant.period();
        let free = Mode::new(&plant, &[], 0.0);
        let mut power = free.generator;
        for _ in 0..3 {
            power *= power;
        }
        let rate = power.norm().powf(0.125).max(plant.omega);
        let steps = ((period * rate / FINENESS).ceil() as u32).max(64);
        let mut follower = Follower {
            rank: rank(&plant.stops),
            gaps: plant.stops.iter().map(|stop| stop.gap).collect(),
            plant: Arc::new(plant),
            modes: HashMap::new(),
            z: at_phase_zero(start),
            held: Vec::new(),
            touching: [0; 4],
            steps,
            step: period / f64::from(steps),
            events: 0,
            exhausted: false,
            period: Period::default(),
        };
        let on = |f: &Self, j: usize| f.place(j) >= f.gaps[j];
        let touched: Vec<usize> = (0..follower.gaps.len()).filter(|&j| on(&follower, j)).collect();
        if !touched.is_empty() {
            follower.touch(&touched);
        }
        follower
    }

    /// The same trajectory between stops that are off by the given distances.
    pub fn with_roughness(mut self, off: &[f64]) -> Self {
        for (gap, off) in self.gaps.iter_mut().zip(off) {
            *gap += off;
        }
        self.settle_onto_stops();
        self
    }

    /// Displaces the state, within the stops.
    pub fn nudge(&mut self, by: &[f64]) {
        let n = self.plant.n;
        for i in 0..n {
            self.z[i] += by[i];
            self.z[4 + i] += by[n + i];
        }
        self.settle_onto_stops();
    }

    /// x1 … xn, v1 … vn.
    pub fn state(&self) -> Vec<f64> {
        let n = self.plant.n;
        (0..n).map(|i| self.z[i]).chain((0..n).map(|i| self.z[4 + i])).collect()
    }

    /// Whether it was given up.
    pub fn is_exhausted(&self) -> bool {
        self.exhausted
    }

    /// Follows one forcing period.
    pub fn next_period(&mut self) -> Period {
        self.events = 0;
        self.period = Period::default();
        for step in 0..self.steps {
            self.pass(f64::from(step) * self.step);
            if self.exhausted {
                break;
            }
        }
        restore_phase(&mut self.z);
        self.period.strobe = self.state();
        self.period.held = self.held.clone();
        std::mem::take(&mut self.period)
    }

    fn direction(&self, stop: usize) -> &[f64] {
        self.plant.stops[stop].direction.as_slice()
    }

    fn place(&self, stop: usize) -> f64 {
        place(self.direction(stop)).dot(&self.z)
    }

    fn speed(&self, stop: usize) -> f64 {
        speed(self.direction(stop)).dot(&self.z)
    }

    fn mode(&mut self, held: &[usize]) -> Arc<Mode> {
        let (plant, step) = (&self.plant, self.step);
        let make = || Arc::new(Mode::new(plant, held, step));
        self.modes.entry(held.to_vec()).or_insert_with(make).clone()
    }

    /// One step of the grid, which begins `elapsed` after the beginning of the period.
    fn pass(&mut self, elapsed: f64) {
        let mut left = self.step;
        loop {
            let mode = self.mode(&self.held.clone());
            let series = mode.series::<TERMS>(&self.z);
            let Some((time, stop)) = self.next_event(&mode, &series, left) else {
                self.z = if left == self.step { mode.stepper * self.z } else { at(&series, left) };
                self.touching = [0; 4];
                return;
            };
            self.z = at(&series, time);
            left -= time;
            self.events += 1;
            if self.events > MOST_EVENTS {
                self.exhausted = true;
                return;
            }
            if time > 0.0 {
                self.touching = [0; 4];
            }
            if let Some(place) = self.held.iter().position(|&held| held == stop) {
                self.held.remove(place);
                self.touching[stop] = 3;
                self.period.releases.push((stop, elapsed + self.step - left));
            } else {
                let before = self.held.clone();
                self.touch(&[stop]);
                for &lost in before.iter().filter(|lost| !self.held.contains(lost)) {
                    self.period.releases.push((lost, elapsed + self.step - left));
                }
            }
        }
    }

    /// The next stop that is reached, or left, and when.
    fn next_event(&self, mode: &Mode, series: &[Augmented; TERMS], left: f64) -> Option<(f64, usize)> {
        let mut first: Option<(f64, usize)> = None;
        for stop in 0..self.gaps.len() {
            let found = match mode.held.iter().position(|&held| held == stop) {
                Some(s) => first_positive(&series.map(|term| -mode.forces[s].dot(&term)), left),
                None => {
                    let row = place(self.direction(stop));
                    let mut c = series.map(|term| row.dot(&term));
                    c[0] -= self.gaps[stop];
                    // What is 0 here is divided out.
                    first_positive(&c[self.touching[stop]..], left)
                }
            };
            if let Some(time) = found
                && first.is_none_or(|(earlier, _)| time < earlier)
            {
                first = Some((time, stop));
            }
        }
        first
    }

    /// The instant at which stops are reached: impacts one by one, then who rests and who leaves.
    fn touch(&mut self, reached: &[usize]) {
        let count = self.gaps.len();
        let mut touching: Vec<usize> = (0..count)
            .filter(|j| reached.contains(j) || self.held.contains(j) || self.touching[*j] > 0)
            .collect();
        touching.sort_by_key(|&j| self.rank[j]);
        let scale = 1.0 + self.state()[self.plant.n..].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let rest = REST * scale;
        let mut struck = 0;
        while let Some(&stop) = touching.iter().find(|&&j| self.speed(j) > rest) {
            self.strike(stop);
            self.period.impacts[stop] += 1;
            struck += 1;
            if struck > 200 {
                self.exhausted = true;
                return;
            }
        }
        self.period.coincides |= struck > 1;
        let candidates: Vec<usize> =
            touching.iter().copied().filter(|&j| self.speed(j).abs() <= rest).collect();
        let held = self.pressed(&candidates);
        self.period.chatters |= held.iter().any(|j| !self.held.contains(j));
        self.held = held;
        for &j in &touching {
            let leaves = if candidates.contains(&j) { 2 } else { 1 };
            self.touching[j] = if self.held.contains(&j) { 0 } else { leaves };
        }
        self.settle_onto_stops();
    }

    /// v⁺ = v⁻ − (1 + r)(d·v⁻) M⁻¹d/(dᵀM⁻¹d).
    fn strike(&mut self, stop: usize) {
        let mode = self.mode(&[stop]);
        let change = -(1.0 + self.plant.stops[stop].restitution) * self.speed(stop);
        for (i, lift) in mode.lifts[0].iter().enumerate() {
            self.z[4 + i] += change * lift;
        }
    }

    /// Of the stops on which masses rest, those that are pressed an instant later: forces ≥ 0 on them, and no
    /// acceleration into the others.
    fn pressed(&mut self, candidates: &[usize]) -> Vec<usize> {
        let instant = 1e-7 * self.step;
        let mut best: (f64, Vec<usize>) = (f64::NEG_INFINITY, Vec::new());
        for subset in 0..1u32 << candidates.len() {
            let held: Vec<usize> =
                (0..candidates.len()).filter(|i| subset >> i & 1 == 1).map(|i| candidates[i]).collect();
            let mut held = held;
            held.sort_unstable();
            let mode = self.mode(&held);
            let ahead = self.z + mode.generator * self.z * instant;
            let rate = mode.generator * ahead;
            let forces = mode.forces.iter().map(|force| force.dot(&ahead));
            let off = candidates.iter().filter(|j| !held.contains(j));
            let offs: Vec<f64> = off.map(|&j| -speed(self.direction(j)).dot(&rate)).collect();
            let worst = forces.chain(offs).fold(f64::INFINITY, f64::min);
            if worst > best.0 {
                best = (worst, held);
            }
        }
        best.1
    }

    /// Moves the masses onto the stops that hold them, at rest there, and within the others.
    fn settle_onto_stops(&mut self) {
        let held = self.held.clone();
        let mode = self.mode(&held);
        let away: Vec<[f64; 2]> =
            held.iter().map(|&j| [self.gaps[j] - self.place(j), -self.speed(j)]).collect();
        for (lift, [x, v]) in mode.lifts.iter().zip(away) {
            for (i, lift) in lift.iter().enumerate() {
                self.z[i] += x * lift;
                self.z[4 + i] += v * lift;
            }
        }
        for j in (0..self.gaps.len()).filter(|j| !held.contains(j)) {
            let beyond = self.place(j) - self.gaps[j];
            if beyond > 0.0 {
                let lift = self.mode(&[j]).lifts[0].clone();
                lift.iter().enumerate().for_each(|(i, lift)| self.z[i] -= beyond * lift);
            }
        }
    }
}

fn at(series: &[Augmented; TERMS], s: f64) -> Augmented {
    series.iter().rev().fold(Augmented::zeros(), |sum, term| sum * s + term)
}

/// Lines in the order of their first stops; on a line, first the stop met along the first one's direction.
fn rank(stops: &[PlantStop]) -> Vec<usize> {
    let parallel = |a: &PlantStop, b: &PlantStop| {
        let cosine = a.direction.dot(&b.direction) / (a.direction.norm() * b.direction.norm());
        1.0 - cosine.abs() < 1e-12
    };
    let of = |stop: &PlantStop| {
        let line = stops.iter().position(|other| parallel(other, stop)).unwrap();
        2 * line + usize::from(stops[line].direction.dot(&stop.direction) < 0.0)
    };
    stops.iter().map(of).collect()
}
