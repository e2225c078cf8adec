//! The loop that takes a controlled trajectory from move to move.

use super::controlled::Controlled;
use super::progress::Progress;
use super::schedule::ControlSchedule;
use super::witness::Witness;
use crate::dynamics::Variation;
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
        loop {
            match self.progress {
                Progress::Settling => {
                    self.advance(flight, schedule, (), |_, ()| (), witness);
                }
                Progress::Observed => {
                    let keep = |controlled: &mut Self, tangent| controlled.tangent = tangent;
                    self.advance(flight, schedule, self.tangent, keep, witness);
                }
                _ => return,
            }
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
            self.advance(flight, schedule, (), |_, ()| (), witness);
        }
        self.iterates == end
    }

    #[inline(always)]
    fn advance<V: Variation<T, M>>(
        &mut self,
        flight: &Flight<T, M>,
        schedule: &ControlSchedule,
        mut variation: V,
        keep: impl Fn(&mut Self, V),
        witness: &mut impl Witness<T>,
    ) {
        let mut trajectory = self.trajectory;
        let taken = trajectory.advance(flight, &mut variation);
        witness.moved::<N, M>(flight, &self.trajectory, &taken, &trajectory);
        self.trajectory = trajectory;
        keep(self, variation);
        self.note(flight, schedule, &taken, witness);
    }
}
