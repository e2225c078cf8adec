//! A whole run under control, in either precision.

use super::actuated::Actuated;
use super::controlled::Controlled;
use super::method::Controller;
use super::outcome::Outcome;
use super::schedule::ControlSchedule;
use super::sine::Convention;
use super::witness::Witness;
use crate::dynamics::{Contact, Phasor, Point, Trajectory};
use crate::model::{Drive, Flight, Real, State, System, SystemError};

/// Follows a trajectory from (x1, x2, v1, v2) at forcing phase 0 under control, to the end of its schedule.
///
/// # Errors
/// [`SystemError::TooStiff`] where the steps of a forced flight would be too many.
pub fn control<T: Real, W>(
    system: &System,
    start: [f64; 4],
    controller: &Controller<f64>,
    schedule: &ControlSchedule,
    witness: &mut W,
) -> Result<Outcome, SystemError>
where
    W: Witness<T, ()> + for<'a> Witness<T, Phasor<'a, T, 2>>,
{
    let rounded = Controller::<T>::rounded(controller);
    let start = State::from_slice(&start.map(T::of));
    let Some(ratio) = force_ratio(controller).filter(|_| system.parameters().delta > 0.0) else {
        let flight = Flight::<f64, 2>::new(system).round::<T>();
        let trajectory = Trajectory::new(&flight, start);
        return Ok(follow(Controlled::new(trajectory, rounded, schedule), &flight, schedule, witness));
    };
    let system = system.following(ratio)?;
    let flight = Flight::<f64, 2>::new(&system);
    let constants = Drive::new(&system, &flight, ratio).round::<T>();
    let flight = flight.round::<T>();
    let none = Phasor::new(&constants, T::zero(), [T::zero(), T::one()]);
    let point = Point { state: start, sin: T::zero(), cos: T::one(), one: T::one(), drive: none };
    let trajectory = Trajectory::from_point(&flight, point, Contact::FREE, 0, T::zero());
    Ok(follow(Controlled::new(trajectory, rounded, schedule), &flight, schedule, witness))
}

/// γ, if a controller forces the first mass between impacts.
fn force_ratio(controller: &Controller<f64>) -> Option<f64> {
    match controller {
        Controller::Sine(sine) if sine.convention != Convention::Kick => Some(sine.ratio),
        _ => None,
    }
}

fn follow<T: Real, D: Actuated<T>>(
    mut controlled: Controlled<T, D>,
    flight: &Flight<T, 2>,
    schedule: &ControlSchedule,
    witness: &mut impl Witness<T, D>,
) -> Outcome {
    controlled.follow(flight, schedule, witness);
    controlled.outcome(schedule)
}
