//! A point of the impact Poincaré section σ.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

use crate::dynamics::constants::INVERSE_FACTORIALS;
use crate::dynamics::{Contact, Drive, End, Point, Trajectory};
use crate::model::{Flight, Real, State};

/// X = (v1+, x2, v2, τ): just after an impact at stop A, x1 = +δ; non-dimensional, 0 ≤ τ < 2π.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section<T> {
    /// (v1+, x2, v2, τ).
    pub components: [T; 4],
}

/// Where τ stands in a section point.
pub const TAU_INDEX: usize = 3;

impl<T: Real> Section<T> {
    /// The section point with these components.
    pub fn new(components: [T; 4]) -> Self {
        Section { components }
    }

    /// Where a trajectory is that has just met stop A.
    pub fn of<D>(flight: &Flight<T, 2>, trajectory: &Trajectory<T, 2, D>) -> Self {
        let Trajectory { point, step, offset, .. } = trajectory;
        let State { x: [_, x2], v: [v1, v2] } = point.state;
        Section { components: [v1, x2, v2, phase_of(flight, *step, *offset)] }
    }

    /// The mirror image of where a trajectory is that has just met stop Ā: a symmetric motion is there half its
    /// period after A.
    pub fn mirrored<D>(flight: &Flight<T, 2>, trajectory: &Trajectory<T, 2, D>) -> Self {
        let [v1, x2, v2, tau] = Section::of(flight, trajectory).components;
        Section { components: [-v1, -x2, -v2, into_turn(tau + T::of(PI))] }
    }

    /// The trajectory that begins at this point; `resting` says whether the first mass stays on the stop if its velocity
    /// is 0.
    pub fn trajectory<D: Drive<T, 2>>(
        &self,
        flight: &Flight<T, 2>,
        resting: bool,
        drive: D,
    ) -> Trajectory<T, 2, D> {
        let [v1, x2, v2, tau] = self.components;
        let [sin, cos] = sine_and_cosine(tau);
        let point = Point {
            state: State { x: [flight.normals[0].gap[0], x2], v: [v1, v2] },
            sin,
            cos,
            one: T::one(),
            drive,
        };
        let at_a = Contact::FREE.with(End { normal: 0, side: 0 });
        let contact = if resting && v1 == T::zero() { at_a } else { Contact::FREE };
        let steps = T::of(f64::from(flight.steps));
        let place = tau * T::of(1.0 / TAU) * steps;
        let last = steps - T::one();
        let step = if place < last { place.floor() } else { last };
        let offset = (place - step) * flight.h;
        let offset = if offset < flight.h { offset } else { flight.h * (T::one() - T::epsilon()) };
        Trajectory::from_point(flight, point, contact, step.widen() as u32, offset)
    }

    /// This point minus another; τ the short way round.
    pub fn minus(&self, other: &Self) -> [T; 4] {
        let mut difference: [T; 4] = std::array::from_fn(|i| self.components[i] - other.components[i]);
        difference[TAU_INDEX] = short_way(difference[TAU_INDEX]);
        difference
    }

    /// This point moved by a correction.
    pub fn plus(&self, correction: &[T; 4]) -> Self {
        let mut components: [T; 4] = std::array::from_fn(|i| self.components[i] + correction[i]);
        components[TAU_INDEX] = into_turn(components[TAU_INDEX]);
        Section { components }
    }

    /// The largest difference of a component.
    pub fn distance(&self, other: &Self) -> T {
        let difference = self.minus(other);
        let mut largest = T::zero();
        for value in difference {
            let size = value.abs();
            largest = if size > largest { size } else { largest };
        }
        largest
    }

    /// Whether every component is a finite number.
    pub fn is_finite(&self) -> bool {
        self.components.iter().all(|value| value.is_finite())
    }
}

/// The forcing phase, 0 ≤ τ < 2π, at a time `offset` after the beginning of a step.
pub fn phase_of<T: Real>(flight: &Flight<T, 2>, step: u32, offset: T) -> T {
    let whole = T::of(f64::from(step)) / T::of(f64::from(flight.steps));
    into_turn(T::of(TAU) * whole + flight.omega * offset)
}

/// An angle, −2π ≤ angle < 4π, brought between 0 and 2π.
pub fn into_turn<T: Real>(angle: T) -> T {
    let turn = T::of(TAU);
    let angle = if angle < T::zero() { angle + turn } else { angle };
    let angle = if angle >= turn { angle - turn } else { angle };
    if angle < turn { angle } else { T::zero() }
}

/// A difference of two phases, the short way round.
pub fn short_way<T: Real>(difference: T) -> T {
    let (half, turn) = (T::of(PI), T::of(TAU));
    if difference > half {
        difference - turn
    } else if difference < -half {
        difference + turn
    } else {
        difference
    }
}

/// The sine and the cosine of an angle, by their Taylor series about the nearest quarter turn.
pub fn sine_and_cosine<T: Real>(angle: T) -> [T; 2] {
    let quarter = (angle * T::of(FRAC_2_PI) + T::of(0.5)).floor();
    let rest = angle - quarter * T::of(FRAC_PI_2);
    let mut term = [T::zero(), T::one()];
    let mut sum = term;
    for factorial in &INVERSE_FACTORIALS[1..=T::ORDER] {
        term = [term[1] * rest, -(term[0] * rest)];
        let weight = T::of(*factorial);
        sum = [sum[0] + weight * term[0], sum[1] + weight * term[1]];
    }
    match (quarter.widen() as i64).rem_euclid(4) {
        0 => sum,
        1 => [sum[1], -sum[0]],
        2 => [-sum[0], -sum[1]],
        _ => [-sum[1], sum[0]],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, System};

    #[test]
    fn sines_are_right_all_round() {
        for i in -700..1400 {
            let angle = f64::from(i) * 0.01;
            let [sin, cos] = sine_and_cosine(angle);
            assert!((sin - angle.sin()).abs() < 4e-15 && (cos - angle.cos()).abs() < 4e-15, "{angle}");
            let [sin, cos] = sine_and_cosine(angle as f32);
            let exact = f64::from(angle as f32);
            assert!((f64::from(sin) - exact.sin()).abs() < 2e-6, "{angle}");
            assert!((f64::from(cos) - exact.cos()).abs() < 2e-6, "{angle}");
        }
    }

    #[test]
    fn a_point_is_found_again_on_its_trajectory() {
        let flight = Flight::<f64, 2>::new(&System::new(Parameters::default()).unwrap());
        for tau in [0.0, 1e-9, 1.8, PI, TAU - 1e-7] {
            let point = Section::new([-0.3, 0.01, 0.02, tau]);
            let found = Section::of(&flight, &point.trajectory(&flight, false, ()));
            assert!(found.distance(&point) < 1e-14, "{tau}: {found:?}");
        }
        let nearly_round = Section::new([-0.3, 0.01, 0.02, TAU - 1e-8]);
        let begun = Section::new([-0.3, 0.01, 0.02, 1e-8]);
        assert!(nearly_round.distance(&begun) < 1e-7);
    }
}
