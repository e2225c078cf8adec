//! A whole step of flight: one matrix.

use super::flow::{self, Augmented};
use super::free_flight::FreeFlight;
use super::real::{Lanes, Real};
use super::state::State;
use super::width::{AtWidth, Width};

/// What a step of the length h makes of a state: y(t + h) = Φ y(t) + Γs sin φ + Γc cos φ + Γ₁ with y = (x1 … xN, v1 … vN).
///
/// The flow is linear, with any contacts that hold all the time as without; everything is non-dimensional. Φ and Γ come from the
/// exponential of the forced generator, so resonance without damping is no special case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<T, const N: usize> {
    /// Φ's first N columns: what it makes of unit displacements.
    pub phi_x: [State<T, N>; N],
    /// Φ's last N columns: what it makes of unit velocities.
    pub phi_v: [State<T, N>; N],
    /// Γs, what it adds per unit of sin φ at its beginning.
    pub gamma_sin: State<T, N>,
    /// Γc, what it adds per unit of cos φ at its beginning.
    pub gamma_cos: State<T, N>,
    /// Γ₁, what the constant load adds.
    pub gamma_one: State<T, N>,
}

impl<const N: usize> Step<f64, N> {
    /// That of free flight, of a length at which few terms of its series count.
    pub(super) fn of(free: &FreeFlight<N>, h: f64) -> Self {
        Width::widest().compute(Columns { free, h })
    }

    /// Rounded to another precision.
    pub(super) fn round<T: Real>(&self) -> Step<T, N> {
        let state = |s: State<f64, N>| s.map(T::of);
        Step {
            phi_x: self.phi_x.map(state),
            phi_v: self.phi_v.map(state),
            gamma_sin: state(self.gamma_sin),
            gamma_cos: state(self.gamma_cos),
            gamma_one: state(self.gamma_one),
        }
    }
}

/// A step that is to be found column by column, as many of them at once as there are lanes.
#[derive(Clone, Copy)]
pub(super) struct Columns<'a, const N: usize> {
    pub free: &'a FreeFlight<N>,
    pub h: f64,
}

impl<const N: usize> AtWidth<f64> for Columns<'_, N> {
    type Output = Step<f64, N>;
    /// There are seven of two coordinates.
    const PAIRED: bool = false;

    #[inline(always)]
    fn call<L: Lanes<Real = f64>>(self, zero: L) -> Step<f64, N> {
        let mut step = Step::blank(0.0);
        for first in (0..2 * N + 3).step_by(L::WIDTH) {
            let lanes = 0..L::WIDTH.min(2 * N + 3 - first);
            let mut units = Augmented::all(zero);
            for lane in lanes.clone() {
                units.component(first + lane).set_lane(lane, 1.0);
            }
            let stepped = flow::over(self.free, self.h, units).mechanical();
            for lane in lanes {
                *step.column(first + lane) = stepped.lane(lane);
            }
        }
        step
    }
}

impl<T: Copy, const N: usize> Step<T, N> {
    pub(super) fn blank(zero: T) -> Self {
        let state = State { x: [zero; N], v: [zero; N] };
        Step { phi_x: [state; N], phi_v: [state; N], gamma_sin: state, gamma_cos: state, gamma_one: state }
    }

    /// What it makes of component `i` of (x, v, sin φ, cos φ, 1), to be changed.
    pub(super) fn column(&mut self, i: usize) -> &mut State<T, N> {
        let Step { phi_x, phi_v, gamma_sin, gamma_cos, gamma_one } = self;
        phi_x
            .iter_mut()
            .chain(phi_v)
            .chain([gamma_sin, gamma_cos, gamma_one])
            .nth(i)
            .expect("a column of 2N + 3")
    }
}

impl<L: Lanes, const N: usize> Step<L, N> {
    /// The state after it, from that before it and the forcing phasor then.
    #[inline(always)]
    pub fn of_state(&self, state: &State<L, N>, sin: L, cos: L) -> State<L, N> {
        let mut after = self.gamma_one.plus(sin, &self.gamma_sin).plus(cos, &self.gamma_cos);
        for i in 0..N {
            after = after.plus(state.x[i], &self.phi_x[i]);
        }
        for i in 0..N {
            after = after.plus(state.v[i], &self.phi_v[i]);
        }
        after
    }

    /// The deviation after it, from that before it.
    #[inline(always)]
    pub fn of_deviation(&self, deviation: &State<L, N>) -> State<L, N> {
        let mut after = self.phi_x[0].scaled(deviation.x[0]);
        for i in 1..N {
            after = after.plus(deviation.x[i], &self.phi_x[i]);
        }
        for i in 0..N {
            after = after.plus(deviation.v[i], &self.phi_v[i]);
        }
        after
    }

    /// The step of twice the length: itself and once more; the sine and cosine are those of the forcing phase that it takes.
    #[inline(always)]
    pub(super) fn doubled(&self, (sin, cos): (L, L)) -> Self {
        let again = |first: &State<L, N>| self.of_deviation(first);
        let [gamma_sin, gamma_cos, gamma_one] = [&self.gamma_sin, &self.gamma_cos, &self.gamma_one];
        Step {
            phi_x: self.phi_x.map(|column| again(&column)),
            phi_v: self.phi_v.map(|column| again(&column)),
            gamma_sin: again(gamma_sin).plus(cos, gamma_sin).plus(-sin, gamma_cos),
            gamma_cos: again(gamma_cos).plus(sin, gamma_sin).plus(cos, gamma_cos),
            gamma_one: again(gamma_one).plus(sin.all(1.0), gamma_one),
        }
    }

    /// Puts a step into one lane.
    pub(super) fn set_lane(&mut self, lane: usize, step: &Step<L::Real, N>) {
        for i in 0..N {
            self.phi_x[i].set_lane(lane, &step.phi_x[i]);
            self.phi_v[i].set_lane(lane, &step.phi_v[i]);
        }
        self.gamma_sin.set_lane(lane, &step.gamma_sin);
        self.gamma_cos.set_lane(lane, &step.gamma_cos);
        self.gamma_one.set_lane(lane, &step.gamma_one);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::equations::Equations;
    use crate::model::example::{coupled, for_every_size};
    use crate::model::width::at_every_width;

    const H: f64 = 0.3;

    fn columns<const N: usize>(mut step: Step<f64, N>) -> Vec<Vec<f64>> {
        (0..2 * N + 3).map(|i| step.column(i).values().collect()).collect()
    }

    fn is_the_same_at_every_width<const N: usize>() {
        let bits = |step| columns::<N>(step).into_iter().flatten().map(f64::to_bits).collect::<Vec<_>>();
        let free = coupled::<N>();
        for equations in [free, free.held_along(0)] {
            let own = bits(Step::of(&equations, H));
            let found = at_every_width(Columns { free: &equations, h: H });
            assert!(found.into_iter().all(|step| bits(step) == own), "{N} coordinates");
            assert_ne!(bits(Step::of(&equations, 0.99 * H)), own, "the check can fail");
        }
    }

    #[test]
    fn a_step_is_the_same_to_the_bit_at_every_width() {
        for_every_size!(is_the_same_at_every_width);
    }

    fn is_the_exponential<const N: usize>() {
        let equations = coupled::<N>();
        let generator = equations.generator();
        let away = |h: f64| {
            let exact = (&generator * h).exp();
            let found = columns(Step::of(&equations, H));
            (0..2 * N + 3)
                .flat_map(|j| (0..2 * N).map(move |i| (i, j)))
                .map(|(i, j)| (found[j][i] - exact[(i, j)]).abs())
                .fold(0.0, f64::max)
        };
        assert!(away(H) < 4e-15, "{N} coordinates: {}", away(H));
        assert!(away(1.001 * H) > 1e-5, "the check can fail");
    }

    #[test]
    fn a_step_is_the_exponential_of_the_forced_generator() {
        for_every_size!(is_the_exponential);
    }

    fn shows_what_is_infinite<const N: usize>() {
        let is_finite = |equations: &Equations<N>| {
            at_every_width(Columns { free: equations, h: H })
                .into_iter()
                .map(|step| columns(step).into_iter().flatten().all(f64::is_finite))
                .collect::<Vec<bool>>()
        };
        assert!(is_finite(&coupled()).into_iter().all(|finite| finite), "the check can fail");
        for i in 0..N {
            for k in 0..3 {
                let mut equations = coupled();
                let FreeFlight { sin, cos, load, .. } = &mut equations.free;
                [sin, cos, load][k][i] = f64::INFINITY;
                assert!(!is_finite(&equations).contains(&true), "load {k} on coordinate {i} of {N}");
            }
        }
    }

    #[test]
    fn a_load_that_is_infinite_is_not_lost() {
        for_every_size!(shows_what_is_infinite);
    }
}
