//! Flights of half a step at most, from either end of it: a Taylor polynomial of fixed order.

use super::point::Point;
use super::series::INVERSE_FACTORIALS;
use crate::model::vector::{added, applied, applied_onto, axpy, scaled, scaled_columns};
use crate::model::{Flight, Lanes, Real, State};

impl<L: Lanes, const N: usize> Point<L, N> {
    /// The point of free flight a time `s` later, |s| ≤ ½ h, with as many Taylor terms in every lane.
    ///
    /// The terms are those of [`Point::flown`]: Vₖ = v⁽ᵏ⁾ sᵏ, by a recurrence of second order. The forcing's own derivatives
    /// are the powers of ωs times the forcing now and a quarter of its period later, in turn, with the sign changed after every
    /// second one.
    #[inline(always)]
    pub fn flown_near(&self, flight: &Flight<L, N>, s: L) -> Self {
        const { assert!(L::Real::CONTACT_ORDER.is_multiple_of(2), "terms are summed by pairs") };
        let square = s * s;
        let turn = flight.omega * s;
        let opposite = -(turn * turn);
        let springs = scaled_columns(square, &flight.stiffness);
        let dampers = scaled_columns(s, &flight.damping);
        let now = scaled(s, &axpy(self.cos, &flight.cos, &scaled(self.sin, &flight.sin)));
        let later = scaled(s, &axpy(-self.sin, &flight.cos, &scaled(self.cos, &flight.sin)));
        let mut before = self.state.v;
        let loaded = added(&applied(&flight.stiffness, &self.state.x), &flight.load);
        let mut last = applied_onto(&dampers, &before, &axpy(s, &loaded, &now));
        let (mut velocity, mut mean) = (before, before);
        // sin ωs and cos ωs − 1 are the sums of the odd and of the even powers, each over its factorial.
        let (mut even, mut odd) = (opposite, turn);
        let (mut sine, mut versed) = (turn, s.all(0.0));
        for pair in 0..L::Real::CONTACT_ORDER / 2 {
            let k = 2 * pair + 1;
            let (weight, lower) = (s.all(INVERSE_FACTORIALS[k]), s.all(INVERSE_FACTORIALS[k + 1]));
            let lowest = s.all(INVERSE_FACTORIALS[k + 2]);
            velocity = axpy(weight, &last, &velocity);
            mean = axpy(lower, &last, &mean);
            versed = even.times_plus(lower, versed);
            let pulled = applied_onto(&springs, &before, &scaled(odd, &later));
            (before, last) = (last, applied_onto(&dampers, &last, &pulled));
            odd = odd * opposite;
            velocity = axpy(lower, &last, &velocity);
            mean = axpy(lowest, &last, &mean);
            sine = odd.times_plus(lowest, sine);
            let pulled = applied_onto(&springs, &before, &scaled(even, &now));
            (before, last) = (last, applied_onto(&dampers, &last, &pulled));
            even = even * opposite;
        }
        let x = axpy(s, &mean, &self.state.x);
        let sin = self.cos.times_plus(sine, self.sin.times_plus(versed, self.sin));
        let cos = (-self.sin).times_plus(sine, self.cos.times_plus(versed, self.cos));
        Point { state: State { x, v: velocity }, sin, cos }
    }

    /// The point a time `s` later, so short that its fourth power is lost in rounding, from its x'', x''' and x''''; and x''
    /// then, without the third power.
    #[inline(always)]
    pub fn slid(
        &self,
        flight: &Flight<L, N>,
        s: L,
        [acceleration, jerk, snap]: [&[L; N]; 3],
    ) -> (Self, [L; N]) {
        let half = s * s.all(0.5);
        let third = s * s.all(1.0 / 3.0);
        let mean = axpy(half, &axpy(third, jerk, acceleration), &self.state.v);
        let steady = axpy(half, &axpy(third, snap, jerk), acceleration);
        let later = axpy(s, &axpy(half, snap, jerk), acceleration);
        let turn = flight.omega * s;
        let (half_turn, third_turn) = (turn * s.all(0.5), turn * s.all(1.0 / 3.0));
        let sin = third_turn.times_plus(self.cos, self.sin);
        let cos = (-third_turn).times_plus(self.sin, self.cos);
        let point = Point {
            state: State { x: axpy(s, &mean, &self.state.x), v: axpy(s, &steady, &self.state.v) },
            sin: turn.times_plus((-half_turn).times_plus(sin, self.cos), self.sin),
            cos: (-turn).times_plus(half_turn.times_plus(cos, self.sin), self.cos),
        };
        (point, later)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Contact;
    use crate::model::{Setting, System};
    use crate::system::Family;

    /// How far a flight of the share `reach` of the fastest motion's time scale is from that of the whole series, in roundings
    /// of the state: with the order of contacts, and slid.
    fn errors<T: Real>(reach: f64) -> [f64; 2] {
        let system = System::new(Setting::defaults(Family::paper())).unwrap();
        let flight = Flight::<f64, 2>::new(&system).round::<T>();
        let number = |value: f64| T::of(value);
        let state = State { x: [0.08, -0.31].map(number), v: [0.9, 0.4].map(number) };
        let (sin, cos) = 0.7f64.sin_cos();
        let point = Point { state, sin: number(sin), cos: number(cos) };
        let mut most = [0.0f64; 2];
        for s in [reach, -reach].map(|reach| T::of(reach) / flight.rate) {
            let acceleration = point.accelerations(&flight);
            let jerk = point.jerks(&flight, &acceleration);
            let snap = point.snaps(&flight, &acceleration, &jerk);
            let (slid, later) = point.slid(&flight, s, [&acceleration, &jerk, &snap]);
            let whole = point.flown(&flight, s, Contact::FREE);
            let pulls = whole.accelerations(&flight);
            let numbers = |point: &Point<T, 2>, pulls: [T; 2]| {
                let Point { state: State { x, v }, sin, cos } = *point;
                [x[0], x[1], v[0], v[1], sin, cos, pulls[0], pulls[1]].map(Real::widen)
            };
            let exact = numbers(&whole, pulls);
            let near = point.flown_near(&flight, s);
            for (most, found) in
                most.iter_mut().zip([numbers(&near, near.accelerations(&flight)), numbers(&slid, later)])
            {
                for (i, (found, exact)) in found.iter().zip(&exact).enumerate() {
                    // The accelerations, which only deviations depend on, lack the third power already.
                    let rounding = if i < 6 { T::EPSILON } else { T::EPSILON.max(T::STRAIGHT.powi(3)) };
                    *most = most.max((found - exact).abs() / (rounding * (1.0 + exact.abs())));
                }
            }
        }
        most
    }

    fn keeps_to_rounding<T: Real>() {
        let half_step = 0.5 * System::STEP;
        let [near, _] = errors::<T>(half_step);
        assert!(near < 8.0, "{near} roundings in half a step");
        assert!(errors::<T>(2.5 * half_step)[0] > 8.0, "the check can fail");
        let [_, slid] = errors::<T>(T::STRAIGHT);
        assert!(slid < 8.0, "{slid} roundings in the way that is left");
        assert!(errors::<T>(30.0 * T::STRAIGHT)[1] > 8.0, "the check can fail");
    }

    #[test]
    fn what_is_left_out_on_the_way_to_a_contact_is_lost_in_rounding() {
        keeps_to_rounding::<f64>();
        keeps_to_rounding::<f32>();
    }
}
