//! Flights of half a step at most, from either end of it: a Taylor polynomial of fixed order.

use super::point::Point;
use super::series::INVERSE_FACTORIALS;
use crate::model::vector::{added, applied, applied_onto, axpy, scaled, scaled_columns};
use crate::model::{Flight, Lanes, Real, State};

impl<L: Lanes, const N: usize> Point<L, N> {
    /// The point of free flight a time `s` later, |s| ≤ ½ h, with as many Taylor terms in every lane.
    ///
    /// The terms are those of [`Point::flown`]: Vₖ = v⁽ᵏ⁾ sᵏ, by a recurrence of second order.
    #[inline(always)]
    pub fn flown_near(&self, flight: &Flight<L, N>, s: L) -> Self {
        let square = s * s;
        let turn = flight.omega * s;
        let springs = scaled_columns(square, &flight.stiffness);
        let dampers = scaled_columns(s, &flight.damping);
        let (force_sin, force_cos) = (scaled(s, &flight.sin), scaled(s, &flight.cos));
        let mut before = self.state.v;
        let loaded = added(&applied(&flight.stiffness, &self.state.x), &flight.load);
        let first = axpy(self.cos, &force_cos, &axpy(self.sin, &force_sin, &scaled(s, &loaded)));
        let mut last = applied_onto(&dampers, &before, &first);
        let mut phasor = [self.cos * turn, -(self.sin * turn)];
        let mut velocity = before;
        let mut mean = before;
        let mut phase = [self.sin, self.cos];
        for k in 1..=L::Real::CONTACT_ORDER {
            let weight = s.all(INVERSE_FACTORIALS[k]);
            velocity = axpy(weight, &last, &velocity);
            mean = axpy(s.all(INVERSE_FACTORIALS[k + 1]), &last, &mean);
            phase = axpy(weight, &phasor, &phase);
            let forced = axpy(phasor[1], &force_cos, &scaled(phasor[0], &force_sin));
            let forced = applied_onto(&springs, &before, &forced);
            (before, last) = (last, applied_onto(&dampers, &last, &forced));
            phasor = [phasor[1] * turn, -(phasor[0] * turn)];
        }
        Point { state: State { x: axpy(s, &mean, &self.state.x), v: velocity }, sin: phase[0], cos: phase[1] }
    }

    /// The point a time `s` later, so short that its fourth power is lost in rounding, from its x'' and x'''; and x'' then.
    #[inline(always)]
    pub fn slid(&self, flight: &Flight<L, N>, s: L, acceleration: &[L; N], jerk: &[L; N]) -> (Self, [L; N]) {
        let half = s * s.all(0.5);
        let turn = flight.omega * s;
        let later = axpy(s, jerk, acceleration);
        let third = s * s.all(1.0 / 3.0);
        let mean = axpy(half, &axpy(third, jerk, acceleration), &self.state.v);
        let half_turn = turn * s.all(0.5);
        let point = Point {
            state: State {
                x: axpy(s, &mean, &self.state.x),
                v: axpy(s, &axpy(half, jerk, acceleration), &self.state.v),
            },
            sin: turn.times_plus((-half_turn).times_plus(self.sin, self.cos), self.sin),
            cos: (-turn).times_plus(half_turn.times_plus(self.cos, self.sin), self.cos),
        };
        (point, later)
    }
}
