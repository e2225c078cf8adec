//! The constants of several cells side by side: those that free flight and impacts need.

use super::contact_normal::ContactNormal;
use super::flight::Flight;
use super::real::Lanes;

impl<L: Lanes, const N: usize> Flight<L, N> {
    /// Puts the stops of a cell into a lane whose constants are those of another with the same flow.
    pub fn restop_lane(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        for (normal, from) in self.normals.iter_mut().zip(flight.normals()) {
            normal.set_stops(lane, from);
        }
        self.unit.set_lane(lane, flight.unit);
    }

    /// Puts the constants of a cell into one lane. What sticking, symmetry and the end of a trajectory need stays out.
    ///
    /// # Panics
    /// If the cell has another number of contact normals.
    pub fn set_lane(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        assert_eq!(self.count, flight.count, "contact normals");
        self.h.set_lane(lane, flight.h);
        self.inverse_h.set_lane(lane, flight.inverse_h);
        self.turn_sin.set_lane(lane, flight.turn_sin);
        self.turn_cos.set_lane(lane, flight.turn_cos);
        self.rate.set_lane(lane, flight.rate);
        self.unit.set_lane(lane, flight.unit);
        self.step.set_lane(lane, &flight.step);
        for i in 0..N {
            set_vector(&mut self.stiffness[i], lane, &flight.stiffness[i]);
            set_vector(&mut self.damping[i], lane, &flight.damping[i]);
        }
        for (normal, from) in self.normals.iter_mut().zip(flight.normals()) {
            normal.set_lane(lane, from);
        }
    }
}

impl<L: Lanes, const N: usize> ContactNormal<L, N> {
    fn set_stops(&mut self, lane: usize, from: &ContactNormal<L::Real, N>) {
        set_vector(&mut self.gap, lane, &from.gap);
        set_vector(&mut self.restitution, lane, &from.restitution);
    }

    fn set_lane(&mut self, lane: usize, from: &ContactNormal<L::Real, N>) {
        set_vector(&mut self.direction, lane, &from.direction);
        set_vector(&mut self.response, lane, &from.response);
        self.mass.set_lane(lane, from.mass);
        self.set_stops(lane, from);
        set_vector(&mut self.bound.x, lane, &from.bound.x);
        set_vector(&mut self.bound.v, lane, &from.bound.v);
        self.bound.forcing.set_lane(lane, from.bound.forcing);
        self.coupling.set_lane(lane, from.coupling);
        self.drag.set_lane(lane, from.drag);
        for (term, from) in self.kick.iter_mut().zip(&from.kick) {
            term.set_lane(lane, from);
        }
        for (term, from) in self.back.iter_mut().zip(&from.back) {
            term.state.set_lane(lane, &from.state);
            term.sin.set_lane(lane, from.sin);
            term.cos.set_lane(lane, from.cos);
            term.one.set_lane(lane, from.one);
        }
    }
}

fn set_vector<L: Lanes, const M: usize>(vector: &mut [L; M], lane: usize, from: &[L::Real; M]) {
    for (value, &from) in vector.iter_mut().zip(from) {
        value.set_lane(lane, from);
    }
}
