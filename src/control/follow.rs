//! The loop that takes a controlled trajectory from move to move.

use super::controlled::Controlled;
use super::progress::Progress;
use super::schedule::ControlSchedule;
use super::witness::Witness;
use crate::model::{Flight, Real};

impl<T: Real, const N: usize, const M: usize> Controlled<T, N, M> {
    /// Follows the trajectory to its end.
    #[inline(always)]
    pub fn follow(
        &mut self,
        flight: &Flight<T, M>,
        schedule: &ControlSchedule,
        witness: &mut impl Witness<T>,
    ) {
        while matches!(self.progress, Progress::Settling | Progress::Observed) {
            self.advance(flight, schedule, self.progress == Progress::Observed, witness);
        }
    }

    /// Follows the trajectory for so many returns at most, without observing it; whether it made them.
    pub fn iterate(
        &mut self,
        flight: &Flight<T, M>,
        schedule: &ControlSchedule,
        returns: u32,
        witness: &mut impl Witness<T>,
    ) -> bool {
        let end = self.iterates + returns;
        while self.iterates < end && !self.progress.is_over() {
            self.advance(flight, schedule, false, witness);
        }
        self.iterates == end
    }

    #[inline(always)]
    fn advance(
        &mut self,
        flight: &Flight<T, M>,
        schedule: &ControlSchedule,
        observed: bool,
        witness: &mut impl Witness<T>,
    ) {
        let mut trajectory = self.trajectory;
        let tangents = if observed { std::slice::from_mut(&mut self.tangent) } else { &mut [] };
        let taken = trajectory.advance(flight, tangents);
        witness.moved::<N, M>(flight, &self.trajectory, &taken, &trajectory);
        self.trajectory = trajectory;
        self.note(flight, schedule, &taken, witness);
    }
}
