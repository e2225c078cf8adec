//! The force of a controller: one coordinate more than the system has, the last of those that are flown.

use super::action::Action;
use super::methods::Controller;
use crate::model::{Real, State, System, SystemError};

impl<T: Real> Controller<T> {
    /// γω, the frequency of the force of a trajectory whose forcing has the frequency `omega`; 0 without one.
    pub(super) fn frequency(&self, omega: T) -> T {
        self.force().map_or(T::zero(), |(_, ratio)| ratio * omega)
    }
}

impl Controller<f64> {
    /// The system as its trajectories fly: with a coordinate for the force, where the controller has one between impacts.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where the steps of a forced flight would be too many.
    ///
    /// # Panics
    /// If the coordinate that the force acts on is none of the system's.
    pub fn flown(&self, system: &System) -> Result<System, SystemError> {
        self.force()
            .map_or_else(|| Ok(system.clone()), |(coordinate, ratio)| system.driven(coordinate, ratio))
    }

    /// Does something with the system as its trajectories fly, in as many coordinates as they and the system have.
    ///
    /// # Errors
    /// As [`Controller::flown`].
    pub(super) fn fly<A: InFlight>(&self, system: &System, what: A) -> Result<A::Output, SystemError> {
        let flown = self.flown(system)?;
        Ok(match (system.plant().n, flown.plant().n) {
            (1, 1) => what.fly::<1, 1>(&flown),
            (1, _) => what.fly::<1, 2>(&flown),
            (2, 2) => what.fly::<2, 2>(&flown),
            (2, _) => what.fly::<2, 3>(&flown),
            (3, 3) => what.fly::<3, 3>(&flown),
            (3, _) => what.fly::<3, 4>(&flown),
            (_, 4) => what.fly::<4, 4>(&flown),
            _ => what.fly::<4, 5>(&flown),
        })
    }
}

/// What is done with a system of N coordinates whose trajectories fly in M, one of which may be the force.
pub trait InFlight {
    /// What comes of it.
    type Output;

    /// Does it; `flown` is the system of M coordinates.
    fn fly<const N: usize, const M: usize>(self, flown: &System) -> Self::Output;
}

/// The state of a system of N coordinates under the force of an action, θ' = `frequency`; without a coordinate for the force,
/// M = N, it is the state.
#[inline(always)]
pub fn under<T: Real, const N: usize, const M: usize>(
    action: &Action<T, N>,
    mut state: State<T, M>,
    frequency: T,
) -> State<T, M> {
    if M > N {
        let [sin, cos] = action.phase;
        state.x[N] = action.force * sin;
        state.v[N] = frequency * (action.force * cos);
    }
    state
}
