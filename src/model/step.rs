//! A whole step of flight: one matrix.

use super::at_width::{AtWidth, at_width};
use super::equations::Equations;
use super::flow::{self, Augmented};
use super::real::{Lanes, Real};
use super::state::State;

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
    /// That of some equations.
    pub(super) fn of(equations: &Equations<N>, h: f64) -> Self {
        at_width(Columns { equations, h })
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
struct Columns<'a, const N: usize> {
    equations: &'a Equations<N>,
    h: f64,
}

impl<const N: usize> AtWidth for Columns<'_, N> {
    type Output = Step<f64, N>;

    #[inline(always)]
    fn call<L: Lanes<Real = f64>>(self, zero: L) -> Step<f64, N> {
        let mut step = Step::blank(0.0);
        for first in (0..2 * N + 3).step_by(L::WIDTH) {
            let lanes = 0..L::WIDTH.min(2 * N + 3 - first);
            let mut units = Augmented::all(zero);
            for lane in lanes.clone() {
                units.component(first + lane).set_lane(lane, 1.0);
            }
            let stepped = flow::over(self.equations, self.h, units).mechanical();
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
    fn column(&mut self, i: usize) -> &mut State<T, N> {
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
    use nalgebra::{DMatrix, DVector};

    use super::super::at_width::at_every_width;
    use super::*;
    use crate::model::{Setting, System};
    use crate::system::{BUILTIN, Family, Plant};

    fn is_the_same_at_every_width<const N: usize>(system: &System) {
        let equations = Equations::<N>::new(system.plant());
        let h = system.period() / f64::from(system.steps());
        let bits = |step: &Step<f64, N>| {
            let mut step = *step;
            let columns = (0..2 * N + 3).map(|i| step.column(i).values().map(f64::to_bits).collect());
            columns.collect::<Vec<Vec<u64>>>()
        };
        let found = at_every_width(Columns { equations: &equations, h });
        let own = bits(&Step::of(&equations, h));
        assert!(found.iter().all(|step| bits(step) == own), "{:?}", system.setting());
        assert_ne!(bits(&Step::of(&equations, 0.99 * h)), own, "the check can fail");
    }

    #[test]
    fn a_step_is_the_same_to_the_bit_at_every_width() {
        let mut sizes = [false; 4];
        for builtin in &BUILTIN {
            let system = System::new(Setting::defaults(Family::builtin(builtin.name))).unwrap();
            sizes[system.coordinates() - 1] = true;
            match system.coordinates() {
                1 => is_the_same_at_every_width::<1>(&system),
                2 => is_the_same_at_every_width::<2>(&system),
                3 => is_the_same_at_every_width::<3>(&system),
                _ => is_the_same_at_every_width::<4>(&system),
            }
        }
        assert!(sizes[..3].iter().all(|&met| met), "{sizes:?}");
    }

    #[test]
    fn a_step_of_an_undamped_mass_is_a_rotation() {
        let equations = undamped();
        let h = 0.3_f64;
        let step = Step::of(&equations, h);
        let near = |found: [f64; 2], wanted: [f64; 2]| {
            found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 4e-16)
        };
        let column = |state: State<f64, 1>| [state.x[0], state.v[0]];
        assert!(near(column(step.phi_x[0]), [h.cos(), -h.sin()]));
        assert!(near(column(step.phi_v[0]), [h.sin(), h.cos()]));
        let [begun_at_sin, begun_at_cos] = [
            [(h.cos() - (2.0 * h).cos()) / 3.0, (2.0 * (2.0 * h).sin() - h.sin()) / 3.0],
            [(2.0 * h.sin() - (2.0 * h).sin()) / 3.0, 2.0 * (h.cos() - (2.0 * h).cos()) / 3.0],
        ];
        assert!(near(column(step.gamma_sin), begun_at_sin));
        assert!(near(column(step.gamma_cos), begun_at_cos));
        assert!(!near(column(step.gamma_sin), begun_at_cos), "the check can fail");
    }

    /// x″ = −x + sin 2t.
    fn undamped() -> Equations<1> {
        Equations::new(&Plant {
            n: 1,
            mass: DMatrix::identity(1, 1),
            damping: DMatrix::zeros(1, 1),
            stiffness: DMatrix::identity(1, 1),
            force_sin: DVector::from_element(1, 1.0),
            force_cos: DVector::zeros(1),
            load: DVector::zeros(1),
            omega: 2.0,
            stops: Vec::new(),
        })
    }
}
