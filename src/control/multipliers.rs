//! Multipliers of a controlled fixed point.

use nalgebra::{Complex, DMatrix};

use super::actuated::Actuated;
use super::controlled::Controlled;
use super::deviation::DELAYS;
use super::memory::LONGEST_DELAY;
use super::method::Controller;
use super::schedule::ControlSchedule;
use super::section::Section;
use super::witness::{Return, Witness};
use crate::dynamics::{Contact, Phasor, Point, Trajectory};
use crate::model::{Drive, Flight, State, System, SystemError};

/// How far the points are moved for the differences; non-dimensional.
const STEP: f64 = 1e-6;

/// The multipliers of one controlled iterate at a fixed point of it, the adaptation of a sine force held: those of F
/// without control, and of all the points that feedback remembers with it. The largest modulus first.
///
/// From central differences, so good to about eight digits; `None` where σ is not met again.
pub fn multipliers(
    system: &System,
    controller: &Controller<f64>,
    fixed_point: [f64; 4],
) -> Result<Option<Vec<Complex<f64>>>, SystemError> {
    let points = remembered(controller);
    let held = held(controller);
    let (ratio, force) = match &held {
        Controller::Sine(sine) if sine.convention != super::Convention::Kick => (sine.ratio, true),
        _ => (1.0, false),
    };
    let system = system.following(ratio)?;
    let flight = Flight::<f64, 2>::new(&system);
    let constants = Drive::new(&system, &flight, ratio);
    let map = |points: &[[f64; 4]]| {
        if force {
            let none = Phasor::new(&constants, 0.0, [0.0, 1.0]);
            iterate(&flight, held, points, none)
        } else {
            iterate(&flight, held, points, ())
        }
    };
    let size = 4 * points;
    let mut jacobian = DMatrix::zeros(size, size);
    let at = vec![fixed_point; points];
    for j in 0..size {
        let moved = |by: f64| {
            let mut moved = at.clone();
            moved[j / 4][j % 4] += by;
            map(&moved)
        };
        let (Some(ahead), Some(behind)) = (moved(STEP), moved(-STEP)) else { return Ok(None) };
        let difference = Section::new(ahead).minus(&Section::new(behind));
        for (i, value) in difference.into_iter().enumerate() {
            jacobian[(i, j)] = value / (2.0 * STEP);
        }
        if j + 4 < size {
            jacobian[(j + 4, j)] = 1.0;
        }
    }
    let mut found: Vec<Complex<f64>> = jacobian.complex_eigenvalues().iter().copied().collect();
    found.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
    Ok(Some(found))
}

/// Points on which the next one depends.
fn remembered(controller: &Controller<f64>) -> usize {
    match controller {
        Controller::Delay(delay) => (delay.delay as usize + 1).min(DELAYS),
        _ => 1,
    }
}

/// The controller without adaptation.
fn held(controller: &Controller<f64>) -> Controller<f64> {
    let mut held = *controller;
    if let Controller::Sine(sine) = &mut held {
        sine.weight = 0.0;
    }
    held
}

/// One controlled iterate from remembered points, the present one first.
fn iterate<D: Actuated<f64>>(
    flight: &Flight<f64, 2>,
    controller: Controller<f64>,
    points: &[[f64; 4]],
    drive: D,
) -> Option<[f64; 4]> {
    let schedule = ControlSchedule {
        from: 0,
        iterates: LONGEST_DELAY as u32 + ControlSchedule::SHORTEST,
        fixed: true,
        max_period: ControlSchedule::MAX_PERIOD,
    };
    let [v1, x2, v2, tau] = points[0];
    let (sin, cos) = tau.sin_cos();
    let state = State { x: [flight.normals[0].gap[0], x2], v: [v1, v2] };
    let point = Point { state, sin, cos, one: 1.0, drive };
    let placed = Section::new(points[0]).trajectory(flight, false, drive);
    let begun = Trajectory::from_point(flight, point, Contact::FREE, placed.step, placed.offset);
    let mut controlled = Controlled::new(begun, controller, &schedule);
    for &past in points.iter().rev() {
        controlled.memory.push(Section::new(past), 1.0, 0, 1);
    }
    controlled.force(flight);
    let mut last = Last(None);
    controlled.iterate(flight, &schedule, 1, &mut last).then_some(last.0?.section.components)
}

/// Keeps the last return.
struct Last(Option<Return<f64>>);

impl<D> Witness<f64, D> for Last {
    fn returned(&mut self, met: &Return<f64>) {
        self.0 = Some(*met);
    }
}
