//! What an impact does to the rest of a step: a polynomial in the time that is left of it.
//!
//! Flight is linear, so a change of d·v by 1 just adds exp(G s)(0, response) to the state a time s later. Its Taylor series
//! converges as if every time mattered as much as the longest one. On 0 ≤ s ≤ h a polynomial of far lower order is as near: the
//! series [economized](super::economize).

use nalgebra::SVector;

use super::economize::{Terms, economize, filled};
use super::equations::Equations;
use super::flow::{self, Augmented};
use super::real::{Lanes, Real};
use super::state::State;

/// The most coefficients of a kick's polynomial: those of f64.
pub const KICK_TERMS: usize = <f64 as Real>::KICK_ORDER + 1;

/// The coefficients of (s/h)ᵏ, 0 ≤ s ≤ h, of what a change of the velocities by `response` has become a time s later.
pub(super) fn kick<const N: usize>(
    equations: &Equations<N>,
    h: f64,
    response: SVector<f64, N>,
) -> [State<f64, N>; KICK_TERMS] {
    let unit = Augmented { v: response.into(), ..Augmented::all(0.0) };
    let mut terms: Terms<_> = flow::series(equations, h, unit).map(|term| term.mechanical()).collect();
    economize(&mut terms, f64::KICK_ORDER);
    filled(&terms)
}

/// Such a polynomial at u = s/h, 0 ≤ u ≤ 1, by Horner's scheme.
#[inline(always)]
pub(super) fn polynomial<L: Lanes, const N: usize>(terms: &[State<L, N>; KICK_TERMS], u: L) -> State<L, N> {
    let mut sum = terms[L::Real::KICK_ORDER];
    for k in (0..L::Real::KICK_ORDER).rev() {
        sum = terms[k].plus(u, &sum);
    }
    sum
}

/// Such a polynomial in another precision, of as many terms as that needs; the others are 0.
pub(super) fn rounded<T: Real, const N: usize>(
    kick: &[State<f64, N>; KICK_TERMS],
) -> [State<T, N>; KICK_TERMS] {
    let mut terms = *kick;
    economize(&mut terms, T::KICK_ORDER);
    terms.map(|term| term.map(T::of))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Flight, Setting, System};
    use crate::system::Family;

    /// What a whole step of another length does: the largest error at times within it, with x in units of the step, per unit
    /// of the largest kick.
    fn largest_error<const N: usize>(system: &System, longer: f64, order: usize) -> f64 {
        let equations = Equations::<N>::new(system.plant());
        let h = longer * system.period() / f64::from(system.steps());
        let (mut error, mut size) = (0.0f64, 0.0f64);
        for normal in equations.normals() {
            let mut terms = kick(&equations, h, normal.response);
            economize(&mut terms, order);
            assert_eq!(terms[0], State { x: [0.0; N], v: normal.response.into() }, "no time, no change");
            for part in 1..=64 {
                let u = f64::from(part) / 64.0;
                let found = (0..=order).rev().fold(State::zero(), |sum, k| terms[k].plus(u, &sum));
                let start = Augmented { v: normal.response.into(), ..Augmented::all(0.0) };
                let exact = flow::over(&equations, u * h, start).mechanical();
                for i in 0..N {
                    error =
                        error.max((found.x[i] - exact.x[i]).abs() / h).max((found.v[i] - exact.v[i]).abs());
                    size = size.max((exact.x[i] / h).abs()).max(exact.v[i].abs());
                }
            }
        }
        error / size
    }

    fn error(system: &System, longer: f64, order: usize) -> f64 {
        match system.plant().n {
            1 => largest_error::<1>(system, longer, order),
            2 => largest_error::<2>(system, longer, order),
            3 => largest_error::<3>(system, longer, order),
            _ => largest_error::<4>(system, longer, order),
        }
    }

    /// Every family that comes with the program at its defaults, and the paper's oscillator stiff, soft and overdamped.
    fn systems() -> Vec<System> {
        let paper = Setting::defaults(Family::paper());
        let changed = [("omega", 0.05), ("omega", 9.0), ("mu_k", 0.9999), ("zeta", 30.0), ("zeta", 0.0)];
        (crate::system::BUILTIN.iter())
            .map(|builtin| Setting::defaults(Family::builtin(builtin.name)))
            .chain(changed.map(|(name, value)| paper.with_named(name, value)))
            .map(|setting| System::new(setting).unwrap())
            .collect()
    }

    /// A bound on what economizing down to an order leaves out, with x in units of the step, per unit of the largest kick: what
    /// rounding would hide.
    fn left_out<const N: usize>(system: &System, order: usize) -> f64 {
        let equations = Equations::<N>::new(system.plant());
        let h = system.period() / f64::from(system.steps());
        let length = |term: &State<f64, N>| {
            term.x.iter().map(|x| x / h).chain(term.v).fold(0.0, |most: f64, value| most.max(value.abs()))
        };
        let of_normal = |normal: &crate::model::equations::Normal<N>| {
            let start = Augmented { v: normal.response.into(), ..Augmented::all(0.0) };
            let mut terms: Vec<_> =
                flow::series(&equations, h, start).map(|term| term.mechanical()).collect();
            let (mut sum, size) = (0.0, length(&terms[0]));
            for highest in (order + 1..terms.len()).rev() {
                sum += length(&terms[highest]) * 2f64.powi(3 - 2 * highest as i32);
                economize(&mut terms, highest - 1);
            }
            sum / size
        };
        equations.normals().iter().map(of_normal).fold(0.0, f64::max)
    }

    fn loss(system: &System, order: usize) -> f64 {
        match system.plant().n {
            1 => left_out::<1>(system, order),
            2 => left_out::<2>(system, order),
            3 => left_out::<3>(system, order),
            _ => left_out::<4>(system, order),
        }
    }

    #[test]
    fn what_is_left_out_is_less_than_half_a_rounding_and_would_not_be_with_one_order_less() {
        for (order, epsilon) in [(f64::KICK_ORDER, f64::EPSILON), (f32::KICK_ORDER, f64::from(f32::EPSILON))]
        {
            let most = |order: usize| systems().iter().map(|system| loss(system, order)).fold(0.0, f64::max);
            let (own, less) = (most(order), most(order - 1));
            assert!(own < 0.25 * epsilon, "order {order}: {own}");
            assert!(less > epsilon, "order {order}: {less}");
        }
    }

    #[test]
    fn kicks_are_those_of_the_exponential() {
        for (order, most) in [(f64::KICK_ORDER, 1e-15), (f32::KICK_ORDER, 3e-8)] {
            let largest = systems().iter().map(|system| error(system, 1.0, order)).fold(0.0, f64::max);
            assert!(largest < most, "order {order}: {largest}");
        }
        let less = systems().iter().map(|system| error(system, 1.0, f32::KICK_ORDER - 1)).fold(0.0, f64::max);
        assert!(less > 1e-7, "{less}");
    }

    /// How far d·x before the share u of a step is from what the deviation after it says, relative to the deviation.
    fn missed<T: Real, const N: usize>(system: &System, u: f64, said: f64) -> f64 {
        let flight = Flight::<f64, N>::new(system);
        let rounded = flight.round::<T>();
        let equations = Equations::<N>::new(system.plant());
        let mut missed = 0.0f64;
        for (normal, of_equations) in rounded.normals().iter().zip(equations.normals()) {
            for k in 0..2 * N {
                let mut before = Augmented::all(0.0);
                if k < N {
                    before.x[k] = 1.0
                } else {
                    before.v[k - N] = 1.0
                }
                let after = flow::over(&equations, u * flight.h, before).mechanical();
                let found = normal.look_back(T::of(said)).map(Real::widen).dot(&after);
                missed = missed.max(
                    (found - of_equations.direction.dot(&SVector::from(before.x))).abs() / after.length(),
                );
            }
        }
        missed
    }

    fn missed_of<T: Real>(system: &System, u: f64, said: f64) -> f64 {
        match system.plant().n {
            1 => missed::<T, 1>(system, u, said),
            2 => missed::<T, 2>(system, u, said),
            3 => missed::<T, 3>(system, u, said),
            _ => missed::<T, 4>(system, u, said),
        }
    }

    #[test]
    fn the_end_of_a_flight_tells_where_a_deviation_was() {
        for system in systems() {
            for u in [0.0, 0.03, 0.5, 1.0] {
                let missed = [missed_of::<f64>(&system, u, u), missed_of::<f32>(&system, u, u)];
                assert!(missed[0] < 4e-15 && missed[1] < 1e-6, "{missed:?} at {u} of a step");
                assert!(missed_of::<f64>(&system, u, (u + 0.1).min(0.9)) > 1e-5, "the check can fail");
            }
        }
    }

    #[test]
    fn steps_that_are_too_long_lose_what_the_order_cannot_follow() {
        for (order, lost) in [(f64::KICK_ORDER, 1e-14), (f32::KICK_ORDER, 2e-7)] {
            let largest = systems().iter().map(|system| error(system, 2.0, order)).fold(0.0, f64::max);
            assert!(largest > lost, "order {order}: {largest}");
        }
    }

    #[test]
    fn another_precision_has_the_polynomial_of_its_own_order() {
        let flight = Flight::<f64, 2>::new(&System::new(Setting::defaults(Family::paper())).unwrap());
        for normal in &flight.normals {
            let single = rounded::<f32, 2>(&normal.kick);
            assert!(single[f32::KICK_ORDER + 1..].iter().all(|term| *term == State::zero()));
            assert_eq!(rounded::<f64, 2>(&normal.kick), normal.kick);
        }
        let kick = &flight.normals[0].kick;
        assert_ne!(rounded::<f32, 2>(kick)[f32::KICK_ORDER], kick[f32::KICK_ORDER].map(|x| x as f32));
    }
}
