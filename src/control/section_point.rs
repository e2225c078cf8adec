//! A point of the impact Poincaré section σ.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

use super::components::Components;
use super::surface::Surface;
use crate::dynamics::constants::INVERSE_FACTORIALS;
use crate::dynamics::{Contact, Point, Trajectory};
use crate::model::vector::applied;
use crate::model::{Flight, Real, State};

/// X = (v_c+, the other x, the other v, τ): just after an impact at the stop of a [`Surface`]; non-dimensional,
/// 0 ≤ τ < 2π. On the paper's, at stop A, it is (v1+, x2, v2, τ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionPoint<T, const N: usize> {
    /// The components, in the order of [`section_names`](super::section_names).
    pub components: Components<T, N>,
}

impl<T: Real, const N: usize> SectionPoint<T, N> {
    /// The section point with these components.
    ///
    /// # Panics
    /// If there are not 2N of them.
    pub fn new(components: &[T]) -> Self {
        SectionPoint { components: Components::from_slice(components) }
    }

    /// All zeros.
    pub fn zero() -> Self {
        SectionPoint { components: Components::zero() }
    }

    /// τ.
    #[inline(always)]
    pub fn tau(&self) -> T {
        self.components[Components::<T, N>::TAU]
    }

    /// Where a trajectory is that has just met the stop.
    #[inline(always)]
    pub fn of<const M: usize>(
        flight: &Flight<T, M>,
        surface: &Surface,
        trajectory: &Trajectory<T, M>,
    ) -> Self {
        let Trajectory { point, step, offset, .. } = trajectory;
        SectionPoint { components: surface.components(&point.state, phase_of(flight, *step, *offset)) }
    }

    /// The mirror image of where a trajectory is that has just met the stop's twin: a symmetric motion is there half its
    /// period after this stop. None where the system has no mirror.
    #[inline(always)]
    pub fn mirrored<const M: usize>(
        flight: &Flight<T, M>,
        surface: &Surface,
        trajectory: &Trajectory<T, M>,
    ) -> Option<Self> {
        let mirror = flight.mirror.as_ref()?;
        let Trajectory { point, step, offset, .. } = trajectory;
        let image = State { x: applied(mirror, &point.state.x), v: applied(mirror, &point.state.v) };
        let tau = into_turn(phase_of(flight, *step, *offset) + T::of(PI));
        Some(SectionPoint { components: surface.components(&image, tau) })
    }

    /// The trajectory that begins at this point with the given contacts, under no force besides the forcing.
    pub fn trajectory<const M: usize>(
        &self,
        flight: &Flight<T, M>,
        surface: &Surface,
        contact: Contact,
    ) -> Trajectory<T, M> {
        let tau = self.tau();
        let [sin, cos] = sine_and_cosine(tau);
        let state = surface.state(flight, &self.components);
        let point = Point { state, sin, cos };
        let steps = T::of(f64::from(flight.steps));
        let place = tau * T::of(1.0 / TAU) * steps;
        let last = steps - T::one();
        let step = if place < last { place.floor() } else { last };
        let offset = (place - step) * flight.h;
        let offset = if offset < flight.h { offset } else { flight.h * (T::one() - T::epsilon()) };
        Trajectory::from_point(flight, point, contact, step.widen() as u32, offset)
    }

    /// This point minus another; τ the short way round.
    #[inline(always)]
    pub fn minus(&self, other: &Self) -> Components<T, N> {
        let mut difference = Components::from_fn(|i| self.components[i] - other.components[i]);
        let tau = &mut difference[Components::<T, N>::TAU];
        *tau = short_way(*tau);
        difference
    }

    /// This point moved by a correction.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, correction: &Components<T, N>) -> Self {
        let mut components = self.components.added(correction);
        let tau = &mut components[Components::<T, N>::TAU];
        *tau = into_turn(*tau);
        SectionPoint { components }
    }

    /// The largest difference of a component, that of τ as it is, others in units of `unit`.
    #[inline(always)]
    pub fn distance(&self, other: &Self, unit: T) -> T {
        let mut difference = self.minus(other);
        let tau = &mut difference[Components::<T, N>::TAU];
        let late = tau.abs();
        *tau = T::zero();
        let mut largest = T::zero();
        for value in difference.values() {
            let size = value.abs();
            largest = if size > largest { size } else { largest };
        }
        let away = largest / unit;
        if away > late { away } else { late }
    }

    /// How far this point is from another that it may return to: their distance in units of `unit` where that point is of order one or
    /// less, relative to the largest of its displacements and velocities above, as strobes are told apart.
    #[inline(always)]
    pub fn away_from(&self, anchor: &Self, unit: T) -> T {
        let mut size = unit;
        for component in 0..Components::<T, N>::TAU {
            let extent = anchor.components[component].abs();
            size = if extent > size { extent } else { size };
        }
        self.distance(anchor, size)
    }

    /// Whether every component is a finite number.
    pub fn is_finite(&self) -> bool {
        self.components.values().all(|value| value.is_finite())
    }
}

/// The forcing phase, 0 ≤ τ < 2π, at a time `offset` after the beginning of a step.
pub fn phase_of<T: Real, const N: usize>(flight: &Flight<T, N>, step: u32, offset: T) -> T {
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
    use crate::dynamics::Stop;
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
        let system = System::new(Parameters::default()).unwrap();
        let flight = Flight::<f64, 2>::new(&system);
        for (stop, sign) in [(Stop::A, 1.0), (Stop::B, -1.0)] {
            let surface = Surface::new(&system, &flight, stop);
            for tau in [0.0, 1e-9, 1.8, PI, TAU - 1e-7] {
                let point = SectionPoint::<f64, 2>::new(&[-0.3 * sign, 0.01, 0.02, tau]);
                let trajectory = point.trajectory(&flight, &surface, Contact::FREE);
                assert_eq!(trajectory.point.state.x[0], 0.1 * sign);
                let found = SectionPoint::of(&flight, &surface, &trajectory);
                assert!(found.distance(&point, 1.0) < 1e-14, "{tau}: {found:?}");
            }
        }
        let nearly_round = SectionPoint::<f64, 2>::new(&[-0.3, 0.01, 0.02, TAU - 1e-8]);
        let begun = SectionPoint::<f64, 2>::new(&[-0.3, 0.01, 0.02, 1e-8]);
        assert!(nearly_round.distance(&begun, 1.0) < 1e-7);
    }

    #[test]
    fn the_mirror_image_lies_on_the_twins_section() {
        let system = System::new(Parameters::default()).unwrap();
        let flight = Flight::<f64, 2>::new(&system);
        let [at_a, at_b] = [Stop::A, Stop::B].map(|stop| Surface::new(&system, &flight, stop));
        assert_eq!((at_a.twin(), at_b.twin()), (Some(Stop::B), Some(Stop::A)));
        let point = SectionPoint::<f64, 2>::new(&[0.3, 0.01, 0.02, 4.0]);
        let trajectory = point.trajectory(&flight, &at_b, Contact::FREE);
        let image = SectionPoint::<f64, 2>::mirrored(&flight, &at_a, &trajectory).unwrap();
        assert!(
            image.distance(&SectionPoint::new(&[-0.3, -0.01, -0.02, 4.0 - PI]), 1.0) < 1e-14,
            "{image:?}"
        );
    }
}
