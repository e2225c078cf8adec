//! A trajectory written down: its impacts, and samples at equal times.

use super::given_up::{GivenUp, MOST_IMPACTS};
use super::moves::Moves;
use super::stop::{Contact, Stop};
use super::trajectory::{Event, Impact, Move, Trajectory};
use crate::model::{Flight, State, StateVector, System};

/// An impact, at its instant; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactEvent {
    /// Time since the start of the trajectory.
    pub time: f64,
    /// The stop that is struck.
    pub stop: Stop,
    /// d·v−, with d the direction of the first stop on the same line.
    pub velocity_before: f64,
    /// d·v+ = −r d·v−; the last impact before sticking stands for the rebounds that follow it in finite time.
    pub velocity_after: f64,
    /// (x, v) once it is over: just after the impact, or at rest on the stop.
    pub state: StateVector,
    /// Forcing phase ωt mod 2π.
    pub phase: f64,
}

/// The state at one time; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time since the start of the trajectory.
    pub time: f64,
    /// (x, v).
    pub state: StateVector,
}

/// A stretch of time during which a stop holds; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stick {
    /// The stop that masses rest on.
    pub stop: Stop,
    /// When masses come to rest on it.
    pub from: f64,
    /// When they leave, or where the recording ends.
    pub until: f64,
}

/// What a trajectory did in a window of forcing periods.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Its impacts, in order.
    pub impacts: Vec<ImpactEvent>,
    /// Its states at equal times, both ends of the window included.
    pub samples: Vec<Sample>,
    /// Its rests on stops, in the order in which they begin.
    pub sticks: Vec<Stick>,
    /// Where and why it ends before its time, if it does.
    pub given_up: Option<GivenUp>,
}

impl Recording {
    /// Notes the rests that are under way where a recording begins.
    pub fn begin_rests<const N: usize>(&mut self, flight: &Flight<f64, N>, contact: Contact, from: f64) {
        self.sticks.extend(resting(flight, contact).into_iter().map(|stop| Stick {
            stop,
            from,
            until: from,
        }));
    }

    /// Notes the rests that go on, end and begin in a move from a time on, between the contacts before it and after it.
    pub fn note_rests<const N: usize>(
        &mut self,
        flight: &Flight<f64, N>,
        before: Contact,
        taken: &Move<f64>,
        after: Contact,
        began: f64,
    ) {
        let (ended, now) = (resting(flight, before), resting(flight, after));
        let time = began + taken.time;
        // A contact opens at the beginning of the move that pulls the masses off.
        let released = if matches!(taken.event, Event::Released(_)) { began } else { time };
        for stop in &ended {
            if let Some(stick) = self.sticks.iter_mut().rev().find(|stick| stick.stop == *stop) {
                stick.until = if now.contains(stop) { time } else { released };
            }
        }
        let begun = now.into_iter().filter(|stop| !ended.contains(stop));
        self.sticks.extend(begun.map(|stop| Stick { stop, from: time, until: time }));
    }
}

/// Follows a trajectory in f64 from (x, v) at forcing phase 0, and writes down what it does.
///
/// The first `transient` forcing periods are left out; the next `periods` are recorded with `samples_per_period`
/// samples each (0 for none). Times count from the start of the trajectory. A trajectory that makes no headway is
/// given up, and the recording says so.
///
/// # Panics
/// If the start does not have 2n components.
pub fn record(
    system: &System,
    start: impl AsRef<[f64]>,
    transient: u32,
    periods: u32,
    samples_per_period: u32,
) -> Recording {
    let start = start.as_ref();
    let window = Window { transient, periods, samples: samples_per_period };
    match system.coordinates() {
        1 => window.record::<1>(system, start),
        2 => window.record::<2>(system, start),
        3 => window.record::<3>(system, start),
        _ => window.record::<4>(system, start),
    }
}

/// What is recorded of a trajectory.
#[derive(Clone, Copy)]
struct Window {
    /// Forcing periods that are left out.
    transient: u32,
    /// Forcing periods that are recorded.
    periods: u32,
    /// Samples in each of them.
    samples: u32,
}

impl Window {
    fn record<const N: usize>(self, system: &System, start: &[f64]) -> Recording {
        let flight = &Flight::<f64, N>::new(system);
        let mut trajectory = Trajectory::new(flight, State::from_slice(start));
        let mut moves = Moves::default();
        for period in 0..self.transient {
            let passed = pass_period(flight, &mut trajectory, &mut moves);
            let given_up = if !passed { Some(GivenUp::Moves(period)) } else { grown(period, &trajectory) };
            if given_up.is_some() {
                return Recording { given_up, ..Recording::default() };
            }
        }
        let mut recorder = Recorder::new(system, flight, &trajectory, self);
        while recorder.period < self.transient.saturating_add(self.periods) {
            let before = trajectory;
            let taken = trajectory.advance(flight, &mut []);
            recorder.sample(&before, &taken);
            let period = recorder.period;
            recorder.note(&before, &taken, &trajectory);
            moves.note(&taken.event);
            if let (Event::Strobe, Some(grown)) = (taken.event, grown(period, &trajectory)) {
                return recorder.give_up(grown, &trajectory);
            }
            if moves.are_too_many() {
                return recorder.give_up(GivenUp::Moves(period), &trajectory);
            }
            if recorder.recording.impacts.len() > MOST_IMPACTS {
                return recorder.give_up(GivenUp::Impacts(period), &trajectory);
            }
        }
        recorder.finish(&trajectory)
    }
}

/// Why a trajectory is given up at the end of a forcing period, where it grows without bounds.
fn grown<const N: usize>(period: u32, trajectory: &Trajectory<f64, N>) -> Option<GivenUp> {
    (!trajectory.point.state.is_bounded()).then_some(GivenUp::Growth(period))
}

/// Follows a trajectory to the end of its forcing period; `false` where it makes no headway.
fn pass_period<const N: usize>(
    flight: &Flight<f64, N>,
    trajectory: &mut Trajectory<f64, N>,
    moves: &mut Moves,
) -> bool {
    while !moves.are_too_many() {
        let taken = trajectory.advance(flight, &mut []);
        moves.note(&taken.event);
        if taken.event == Event::Strobe {
            return true;
        }
    }
    false
}

struct Recorder<'a, const N: usize> {
    recording: Recording,
    flight: &'a Flight<f64, N>,
    /// The forcing period's length.
    length: f64,
    /// Forcing periods since the start.
    period: u32,
    samples: u32,
    /// The next sample's number within the present period.
    next: u32,
}

impl<'a, const N: usize> Recorder<'a, N> {
    fn new(
        system: &System,
        flight: &'a Flight<f64, N>,
        trajectory: &Trajectory<f64, N>,
        window: Window,
    ) -> Self {
        let mut recorder = Recorder {
            recording: Recording::default(),
            flight,
            length: system.period(),
            period: window.transient,
            samples: window.samples,
            next: 0,
        };
        let from = recorder.time(trajectory);
        recorder.recording.begin_rests(flight, trajectory.contact, from);
        recorder
    }

    /// Time since the last strobe.
    fn elapsed(&self, trajectory: &Trajectory<f64, N>) -> f64 {
        f64::from(trajectory.step) * self.flight.h + trajectory.offset
    }

    /// Time since the start.
    fn time(&self, trajectory: &Trajectory<f64, N>) -> f64 {
        f64::from(self.period) * self.length + self.elapsed(trajectory)
    }

    /// Takes the samples that fall within a move.
    fn sample(&mut self, before: &Trajectory<f64, N>, taken: &Move<f64>) {
        let elapsed = self.elapsed(before);
        while self.next < self.samples {
            let at = self.length * f64::from(self.next) / f64::from(self.samples);
            if at >= elapsed + taken.time && self.next > 0 {
                return;
            }
            let state = before.point.flown(self.flight, (at - elapsed).max(0.0), taken.contact).state;
            let time = f64::from(self.period) * self.length + at;
            self.recording.samples.push(Sample { time, state: StateVector::of(&state) });
            self.next += 1;
        }
    }

    fn note(&mut self, before: &Trajectory<f64, N>, taken: &Move<f64>, after: &Trajectory<f64, N>) {
        let began = self.time(before);
        let time = began + taken.time;
        match taken.event {
            Event::Impact(impact) => self.impact(time, after, impact),
            Event::Caught { impact, .. } if impact.velocity_before != 0.0 => self.impact(time, after, impact),
            Event::Strobe => (self.next, self.period) = (0, self.period + 1),
            _ => {}
        }
        self.recording.note_rests(self.flight, before.contact, taken, after.contact, began);
    }

    fn impact(&mut self, time: f64, trajectory: &Trajectory<f64, N>, impact: Impact<f64>) {
        self.recording.impacts.push(ImpactEvent {
            time,
            stop: impact.stop,
            velocity_before: impact.velocity_before,
            velocity_after: impact.velocity_after,
            state: StateVector::of(&trajectory.point.state),
            phase: self.flight.omega * self.elapsed(trajectory),
        });
    }

    fn give_up(mut self, why: GivenUp, trajectory: &Trajectory<f64, N>) -> Recording {
        self.recording.given_up = Some(why);
        self.finish(trajectory)
    }

    fn finish(mut self, trajectory: &Trajectory<f64, N>) -> Recording {
        if self.samples > 0 {
            let time = self.time(trajectory);
            self.recording.samples.push(Sample { time, state: StateVector::of(&trajectory.point.state) });
        }
        self.recording
    }
}

/// The stops on which masses rest, pressed; not those that clamp them.
fn resting<const N: usize>(flight: &Flight<f64, N>, contact: Contact) -> Vec<Stop> {
    if contact.is_free() {
        return Vec::new();
    }
    let ends = (0..flight.count).filter_map(|k| contact.opening_along(k));
    ends.map(|end| Stop(flight.normals[end.normal].stop[end.side])).collect()
}
