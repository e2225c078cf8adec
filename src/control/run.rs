//! A whole run under control, in either precision.

use std::marker::PhantomData;

use super::controlled::Controlled;
use super::force::InFlight;
use super::methods::Controller;
use super::outcome::Outcome;
use super::schedule::ControlSchedule;
use super::surface::Surface;
use super::witness::Witness;
use crate::dynamics::Trajectory;
use crate::model::{Flight, Real, State, System, SystemError};

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
    controller.fly(system, Run { system, start, controller, schedule, witness, precision: PhantomData::<T> })
}

/// What is run.
struct Run<'a, T, W> {
    system: &'a System,
    start: &'a [f64],
    controller: &'a Controller<f64>,
    schedule: &'a ControlSchedule,
    witness: &'a mut W,
    precision: PhantomData<T>,
}

impl<T: Real, W: Witness<T>> InFlight for Run<'_, T, W> {
    type Output = Outcome;

    fn fly<const N: usize, const M: usize>(self, flown: &System) -> Outcome {
        let flight = Flight::<f64, M>::new(flown).round::<T>();
        let surface = Surface::new(self.system, &flight, self.controller.stop());
        let given = State::<f64, N>::from_slice(self.start).map(T::of);
        let mut start = State::zero();
        start.x[..N].copy_from_slice(&given.x);
        start.v[..N].copy_from_slice(&given.v);
        let (begun, controller) = (Trajectory::new(&flight, start), Controller::rounded(self.controller));
        let mut controlled = Controlled::<T, N, M>::new(begun, surface, controller, self.schedule);
        controlled.follow(&flight, self.schedule, self.witness);
        controlled.outcome(&flight, self.schedule, self.system)
    }
}
