//! A whole run under control, in either precision.

use super::actuated::Actuated;
use super::controlled::Controlled;
use super::methods::Controller;
use super::outcome::Outcome;
use super::schedule::ControlSchedule;
use super::surface::Surface;
use super::witness::Witness;
use crate::dynamics::{Phasor, Point, Trajectory};
use crate::model::{Drive, Flight, Real, State, System, SystemError};

/// Follows a trajectory from x1 … xn, v1 … vn at forcing phase 0 under control, to the end of its schedule.
///
/// # Errors
/// [`SystemError::TooStiff`] where the steps of a forced flight would be too many.
///
/// # Panics
/// If the start does not have 2n values, or the controller is not one of this system: see
/// [`Scheme::resolve`](super::Scheme::resolve).
pub fn control<T: Real, W: Witness<T>>(
    system: &System,
    start: &[f64],
    controller: &Controller<f64>,
    schedule: &ControlSchedule,
    witness: &mut W,
) -> Result<Outcome, SystemError> {
    match system.plant().n {
        1 => controlled::<T, W, 1>(system, start, controller, schedule, witness),
        2 => controlled::<T, W, 2>(system, start, controller, schedule, witness),
        3 => controlled::<T, W, 3>(system, start, controller, schedule, witness),
        _ => controlled::<T, W, 4>(system, start, controller, schedule, witness),
    }
}

fn controlled<T: Real, W: Witness<T>, const N: usize>(
    system: &System,
    start: &[f64],
    controller: &Controller<f64>,
    schedule: &ControlSchedule,
    witness: &mut W,
) -> Result<Outcome, SystemError> {
    let values: Vec<T> = start.iter().map(|&value| T::of(value)).collect();
    let start = State::<T, N>::from_slice(&values);
    let rounded = Controller::<T>::rounded(controller);
    let force = controller.force();
    let system = system.following(force.map_or(0.0, |(_, ratio)| ratio))?;
    let cell = Flight::<f64, N>::new(&system);
    let flight = cell.round::<T>();
    let surface = Surface::new(&system, &flight, controller.stop());
    let begun = Trajectory::new(&flight, start);
    let Some((coordinate, ratio)) = force else {
        return Ok(follow(
            &system,
            Controlled::new(begun, surface, rounded, schedule),
            &flight,
            schedule,
            witness,
        ));
    };
    let constants = Drive::on(coordinate, &system, &cell, ratio).round::<T>();
    let drive = Phasor::new(&constants, T::zero(), [T::zero(), T::one()]);
    let Trajectory { point, contact, step, offset, .. } = begun;
    let point = Point { state: point.state, sin: point.sin, cos: point.cos, one: point.one, drive };
    let begun = Trajectory::from_point(&flight, point, contact, step, offset);
    Ok(follow(&system, Controlled::new(begun, surface, rounded, schedule), &flight, schedule, witness))
}

fn follow<T: Real, const N: usize, D: Actuated<T, N>>(
    system: &System,
    mut controlled: Controlled<T, N, D>,
    flight: &Flight<T, N>,
    schedule: &ControlSchedule,
    witness: &mut impl Witness<T>,
) -> Outcome {
    controlled.follow(flight, schedule, witness);
    controlled.outcome(flight, schedule, system)
}
