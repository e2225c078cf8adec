//! How a trajectory leaves σ: from where, with which contacts, under which force.

use super::action::Action;
use super::components::Components;
use super::controlled::Controlled;
use super::force::under;
use super::progress::Progress;
use super::section_point::SectionPoint;
use crate::dynamics::{Contact, Point, Trajectory, holds};
use crate::model::vector::dot;
use crate::model::{Flight, Real};

/// A point on σ farther than this from 0, in units of [`Flight::reach`], is beyond all bounds.
pub const RUNAWAY: f64 = 1e3;

impl<T: Real, const N: usize, const M: usize> Controlled<T, N, M> {
    /// Whether a corrected point is on the section: the masses do not move into its stop, and are beyond no other.
    pub(super) fn admits(&self, flight: &Flight<T, M>, section: &SectionPoint<T, N>) -> bool {
        let state = self.surface.state(flight, &section.components);
        let zero = T::zero();
        self.surface.approach(flight, &state) <= zero && holds(flight, &Point::at_phase_zero(state))
    }

    /// d·v+ at a point on the section, d being the direction of the first stop on its normal.
    pub(super) fn velocity_along(&self, flight: &Flight<T, M>, section: &SectionPoint<T, N>) -> T {
        let state = self.surface.state(flight, &section.components);
        dot(&flight.normals[self.surface.end.normal].direction, &state.v)
    }

    /// The contacts that still hold at a corrected point: that with the section's stop where the masses rest on it, and
    /// those from which the correction moves nothing.
    fn kept(
        &self,
        flight: &Flight<T, M>,
        section: &SectionPoint<T, N>,
        correction: &Components<T, N>,
    ) -> Contact {
        let state = self.surface.state(flight, &section.components);
        let moved = self.surface.deviation(flight, correction);
        let mut kept = self.trajectory.contact;
        for (k, normal) in flight.normals().iter().enumerate() {
            let still = if k == self.surface.end.normal {
                self.surface.approach(flight, &state) == T::zero()
            } else {
                [&moved.x, &moved.v].into_iter().all(|part| dot(&normal.direction, part) == T::zero())
            };
            if !still && !kept.is_clamped_along(k) {
                kept = kept.without(k);
            }
        }
        kept
    }

    /// Leaves σ from a corrected point, under a force.
    pub(super) fn go_on_from(
        &mut self,
        flight: &Flight<T, M>,
        section: &SectionPoint<T, N>,
        action: &Action<T, N>,
    ) {
        if section.distance(&SectionPoint::zero(), flight.reach()) > T::of(RUNAWAY) {
            self.progress = Progress::Runaway;
            return;
        }
        if !action.correction.is_zero() {
            let contact = self.kept(flight, section, &action.correction);
            self.trajectory = section.trajectory(flight, &self.surface, contact);
            // A phase that is set back at every return never reaches a strobe.
            self.moves.pass_period();
        }
        self.set_force(flight, action);
    }
    /// Goes on from the present point under the force of an action.
    pub(super) fn set_force(&mut self, flight: &Flight<T, M>, action: &Action<T, N>) {
        let Trajectory { mut point, contact, step, offset, .. } = self.trajectory;
        point.state = under(action, point.state, self.controller.frequency(flight.omega));
        if point != self.trajectory.point {
            self.trajectory = Trajectory::from_point(flight, point, contact, step, offset);
        }
    }
}
