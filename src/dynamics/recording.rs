//! A trajectory written down: its impacts, and samples at equal times.

use thiserror::Error;

use super::point::Point;
use super::stop::{Contact, Stop};
use super::trajectory::{Event, Impact, MOST_MOVES, Move, Trajectory};
use crate::model::{Flight, State, System};

/// An impact, at its instant; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactEvent {
    /// Time since the start of the trajectory.
    pub time: f64,
    /// Where.
    pub stop: Stop,
    /// v1−.
    pub velocity_before: f64,
    /// v1+ = −r v1−; the last impact before sticking stands for the rebounds that follow it in finite time.
    pub velocity_after: f64,
    /// x2 at the impact.
    pub x2: f64,
    /// v2 at the impact.
    pub v2: f64,
    /// Forcing phase ωt mod 2π.
    pub phase: f64,
}

/// The state at one time; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time since the start of the trajectory.
    pub time: f64,
    /// Displacement of the first mass.
    pub x1: f64,
    /// Displacement of the second mass.
    pub x2: f64,
    /// Velocity of the first mass.
    pub v1: f64,
    /// Velocity of the second mass.
    pub v2: f64,
}

/// A stretch of time during which the first mass rests on a stop; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stick {
    /// Where.
    pub stop: Stop,
    /// When it comes to rest.
    pub from: f64,
    /// When it leaves, or where the recording ends.
    pub until: f64,
}

/// What a trajectory did in a window of forcing periods.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Its impacts, in order.
    pub impacts: Vec<ImpactEvent>,
    /// Its states at equal times, both ends of the window included.
    pub samples: Vec<Sample>,
    /// Its rests on a stop, in order.
    pub sticks: Vec<Stick>,
    /// Where and why it ends before its time, if it does.
    pub given_up: Option<GivenUp>,
}

/// A trajectory that was not followed to its end: the period in which it was given up, counted from 0 at its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum GivenUp {
    /// More moves in one forcing period than are made for any: rebounds that accumulate without end.
    #[error(
        "the trajectory was given up in forcing period {0}: it makes more than {MOST_MOVES} moves in it; \
         lower r or zeta, or raise omega"
    )]
    Moves(u32),
    /// More impacts than are recorded.
    #[error(
        "the recording was given up in forcing period {0}: it holds more than {MOST_IMPACTS} impacts; \
         record fewer periods"
    )]
    Impacts(u32),
}

/// The most impacts of one recording.
const MOST_IMPACTS: usize = 10_000_000;

/// Follows a trajectory in f64 from (x1, x2, v1, v2) at forcing phase 0, and writes down what it does.
///
/// The first `transient` forcing periods are left out; the next `periods` are recorded with `samples_per_period`
/// samples each (0 for none). Times count from the start of the trajectory. A trajectory that makes no headway is
/// given up, and the recording says so.
pub fn record(
    system: &System,
    start: [f64; 4],
    transient: u32,
    periods: u32,
    samples_per_period: u32,
) -> Recording {
    let flight = Flight::<f64, 2>::new(system);
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&start));
    for period in 0..transient {
        if !pass_period(&flight, &mut trajectory) {
            return Recording { given_up: Some(GivenUp::Moves(period)), ..Recording::default() };
        }
    }
    let mut recorder = Recorder::new(system, &flight, &trajectory, transient, samples_per_period);
    let mut period = transient;
    let mut moves = 0;
    while period < transient + periods {
        let before = trajectory;
        let taken = trajectory.advance(&flight, &mut ());
        let began = recorder.time(period, &before);
        let within = recorder.elapsed(&before);
        recorder.sample(&flight, period, within, &before.point, &taken);
        moves += 1;
        if taken.event == Event::Strobe {
            period += 1;
            moves = 0;
        }
        recorder.note(began, taken.time, &trajectory, taken.event);
        if moves > MOST_MOVES {
            return recorder.give_up(GivenUp::Moves(period), period, &trajectory);
        }
        if recorder.recording.impacts.len() > MOST_IMPACTS {
            return recorder.give_up(GivenUp::Impacts(period), period, &trajectory);
        }
    }
    recorder.finish(period, &trajectory)
}

/// Follows a trajectory to the end of its forcing period; `false` where it makes no headway.
fn pass_period(flight: &Flight<f64, 2>, trajectory: &mut Trajectory<f64, 2>) -> bool {
    (0..=MOST_MOVES).any(|_| trajectory.advance(flight, &mut ()).event == Event::Strobe)
}

struct Recorder {
    recording: Recording,
    period: f64,
    h: f64,
    omega: f64,
    samples_per_period: u32,
    /// The next sample's number within the present period.
    next: u32,
}

impl Recorder {
    fn new(
        system: &System,
        flight: &Flight<f64, 2>,
        trajectory: &Trajectory<f64, 2>,
        transient: u32,
        samples_per_period: u32,
    ) -> Self {
        let mut recorder = Recorder {
            recording: Recording::default(),
            period: system.period(),
            h: flight.h,
            omega: flight.omega,
            samples_per_period,
            next: 0,
        };
        if let Some(stop) = resting_on(flight, trajectory.contact) {
            let from = recorder.time(transient, trajectory);
            recorder.recording.sticks.push(Stick { stop, from, until: from });
        }
        recorder
    }

    /// Time since the last strobe.
    fn elapsed(&self, trajectory: &Trajectory<f64, 2>) -> f64 {
        f64::from(trajectory.step) * self.h + trajectory.offset
    }

    /// Time since the start.
    fn time(&self, period: u32, trajectory: &Trajectory<f64, 2>) -> f64 {
        f64::from(period) * self.period + self.elapsed(trajectory)
    }

    /// Takes the samples that fall within a move of length `time` that began `elapsed` after the last strobe.
    fn sample(
        &mut self,
        flight: &Flight<f64, 2>,
        period: u32,
        elapsed: f64,
        point: &Point<f64, 2>,
        taken: &Move<f64>,
    ) {
        while self.next < self.samples_per_period {
            let at = self.period * f64::from(self.next) / f64::from(self.samples_per_period);
            if at >= elapsed + taken.time && self.next > 0 {
                return;
            }
            let State { x: [x1, x2], v: [v1, v2] } =
                point.flown(flight, (at - elapsed).max(0.0), taken.contact).state;
            self.recording.samples.push(Sample {
                time: f64::from(period) * self.period + at,
                x1,
                x2,
                v1,
                v2,
            });
            self.next += 1;
        }
    }

    fn note(&mut self, began: f64, duration: f64, trajectory: &Trajectory<f64, 2>, event: Event<f64>) {
        let time = began + duration;
        match event {
            Event::Impact(impact) => self.impact(time, trajectory, impact),
            Event::Caught { impact, .. } => {
                if impact.velocity_before != 0.0 {
                    self.impact(time, trajectory, impact);
                }
                self.recording.sticks.push(Stick { stop: impact.stop, from: time, until: time });
            }
            Event::Released(_) => {
                if let Some(stick) = self.recording.sticks.last_mut() {
                    stick.until = began;
                }
            }
            Event::Strobe => self.next = 0,
            Event::Flight | Event::StepEnd | Event::HalfPeriod => {}
        }
    }

    fn impact(&mut self, time: f64, trajectory: &Trajectory<f64, 2>, impact: Impact<f64>) {
        let State { x: [_, x2], v: [_, v2] } = trajectory.point.state;
        self.recording.impacts.push(ImpactEvent {
            time,
            stop: impact.stop,
            velocity_before: impact.velocity_before,
            velocity_after: impact.velocity_after,
            x2,
            v2,
            phase: self.omega * self.elapsed(trajectory),
        });
    }

    fn give_up(mut self, why: GivenUp, period: u32, trajectory: &Trajectory<f64, 2>) -> Recording {
        self.recording.given_up = Some(why);
        self.finish(period, trajectory)
    }

    fn finish(mut self, period: u32, trajectory: &Trajectory<f64, 2>) -> Recording {
        let time = self.time(period, trajectory);
        if let (false, Some(stick)) = (trajectory.contact.is_free(), self.recording.sticks.last_mut()) {
            stick.until = time;
        }
        if self.samples_per_period > 0 {
            let State { x: [x1, x2], v: [v1, v2] } = trajectory.point.state;
            self.recording.samples.push(Sample { time, x1, x2, v1, v2 });
        }
        self.recording
    }
}

/// The stop on which a mass rests, pressed; none where it is free, or clamped.
pub fn resting_on<T: crate::model::Real, const N: usize>(
    flight: &Flight<T, N>,
    contact: Contact,
) -> Option<Stop> {
    let held =
        (0..flight.count).filter(|&k| !contact.is_clamped_along(k)).find_map(|k| contact.end_along(k))?;
    Some(Stop(flight.normals[held.normal].stop[held.side]))
}
