//! A whole run under control, in either precision.

use super::controlled::Controlled;
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
    let flown = controller.flown(system)?;
    let run = Run { system, flown: &flown, start, controller, schedule };
    Ok(match (system.plant().n, flown.plant().n) {
        (1, 1) => run.follow::<T, 1, 1>(witness),
        (1, _) => run.follow::<T, 1, 2>(witness),
        (2, 2) => run.follow::<T, 2, 2>(witness),
        (2, _) => run.follow::<T, 2, 3>(witness),
        (3, 3) => run.follow::<T, 3, 3>(witness),
        (3, _) => run.follow::<T, 3, 4>(witness),
        (_, 4) => run.follow::<T, 4, 4>(witness),
        _ => run.follow::<T, 4, 5>(witness),
    })
}

/// What is run, `flown` being the system with a coordinate for the force where there is one.
struct Run<'a> {
    system: &'a System,
    flown: &'a System,
    start: &'a [f64],
    controller: &'a Controller<f64>,
    schedule: &'a ControlSchedule,
}

impl Run<'_> {
    fn follow<T: Real, const N: usize, const M: usize>(&self, witness: &mut impl Witness<T>) -> Outcome {
        let flight = Flight::<f64, M>::new(self.flown).round::<T>();
        let surface = Surface::new(self.system, &flight, self.controller.stop());
        let given = State::<f64, N>::from_slice(self.start).map(T::of);
        let mut start = State::zero();
        start.x[..N].copy_from_slice(&given.x);
        start.v[..N].copy_from_slice(&given.v);
        let (begun, controller) = (Trajectory::new(&flight, start), Controller::rounded(self.controller));
        let mut controlled = Controlled::<T, N, M>::new(begun, surface, controller, self.schedule);
        controlled.follow(&flight, self.schedule, witness);
        controlled.outcome(&flight, self.schedule, self.system)
    }
}
