//! What the end of a step says of the way to it: d·x, a polynomial in the time that is left of the step.
//!
//! Free flight is linear: d·x a time s ago is a row, d exp(−G s), times the state, the forcing phasor and 1. Its series is
//! economized as that of a [`kick`](super::kick) is, but by its derivative: the speed must be as near as the place is, and the place
//! follows from it.

use nalgebra::SVector;

use super::economize::{Terms, economize, filled};
use super::equations::Equations;
use super::real::Real;
use super::row::Row;

/// The most coefficients of such a polynomial: those of f64.
pub const BACK_TERMS: usize = <f64 as Real>::BACK_ORDER + 1;

/// The coefficients of (s/h)ᵏ, 0 ≤ s ≤ h, of d·x a time s ago.
pub(super) fn back<const N: usize>(
    equations: &Equations<N>,
    h: f64,
    direction: SVector<f64, N>,
) -> [Row<f64, N>; BACK_TERMS] {
    let mut terms: Terms<_> = Row::along(&direction).series_back(equations, h).collect();
    economize_slope(&mut terms, f64::BACK_ORDER);
    filled(&terms)
}

/// The same in another precision, of as many terms as that needs; the others are 0.
pub(super) fn rounded<T: Real, const N: usize>(terms: &[Row<f64, N>; BACK_TERMS]) -> [Row<T, N>; BACK_TERMS] {
    let mut terms = *terms;
    economize_slope(&mut terms, T::BACK_ORDER);
    terms.map(|term| term.round())
}

/// Brings a polynomial to a lower order by its derivative; one of that order stays as it is.
fn economize_slope<const N: usize>(terms: &mut [Row<f64, N>], order: usize) {
    if terms.len() <= order + 1 {
        return;
    }
    let slope = &mut terms[1..];
    for (k, term) in (1..).zip(&mut *slope) {
        *term = term.scaled(f64::from(k));
    }
    economize(slope, order - 1);
    for (k, term) in (1..).zip(slope) {
        *term = term.scaled(1.0 / f64::from(k));
    }
}

#[cfg(test)]
mod tests {
    use super::super::row::Term;
    use super::*;
    use crate::model::common::STEP;
    use crate::model::{Setting, State, System};
    use crate::system::Family;

    /// How far place, speed and pull are from those of the whole series, the slowest of the fastest motions having come as far as a
    /// step allows, at all times within it: in units of the largest.
    fn left_out(order: usize) -> [f64; 3] {
        let paper = Setting::defaults(Family::paper()).with_named("omega", 0.05);
        let system = System::new(paper).unwrap();
        let equations = Equations::<2>::new(system.plant());
        let h = STEP / system.rate();
        let whole: Vec<_> = Row::along(&SVector::from([1.0, 0.0])).series_back(&equations, h).collect();
        let mut short = whole.clone();
        economize_slope(&mut short, order);
        let derivative = |terms: &[Row<f64, 2>], u: f64, m: usize| {
            let weight = |k: usize| (k + 1 - m..=k).map(|j| j as f64).product::<f64>();
            (m..terms.len()).fold(Row::zero(), |sum: Row<f64, 2>, k| {
                sum.plus(weight(k) * u.powi((k - m) as i32), &terms[k])
            })
        };
        let size = |row: Row<f64, 2>| {
            let State { x, v } = row.state;
            [x[0], x[1], v[0], v[1], row.sin, row.cos]
                .iter()
                .fold(0.0f64, |most, value| most.max(value.abs()))
        };
        [0, 1, 2].map(|m| {
            let (mut error, mut largest) = (0.0f64, 0.0f64);
            for u in (0..=64).map(|part| f64::from(part) / 64.0) {
                let exact = derivative(&whole, u, m);
                error = error.max(size(exact.plus(-1.0, &derivative(&short, u, m))));
                largest = largest.max(size(exact));
            }
            error / largest
        })
    }

    #[test]
    fn what_is_left_out_is_a_few_roundings_and_more_with_one_order_less() {
        let cases = [(f64::BACK_ORDER, f64::EPSILON, 8.0), (f32::BACK_ORDER, f64::from(f32::EPSILON), 4.0)];
        for (order, epsilon, most) in cases {
            let roundings = |order: usize| left_out(order).map(|error| error / epsilon);
            // What pulls only deviations and certificates ask for.
            let [place, speed, pull] = roundings(order);
            assert!(place < most && speed < most && pull < 2048.0, "order {order}: {place} {speed} {pull}");
            let [_, less, _] = roundings(order - 1);
            assert!(less > most, "order {order}: {less} with one less");
        }
    }

    #[test]
    fn in_the_same_precision_it_stays_the_same() {
        let system = System::new(Setting::defaults(Family::paper())).unwrap();
        let equations = Equations::<2>::new(system.plant());
        let terms = back(&equations, 0.3, SVector::from([1.0, 0.0]));
        assert_eq!(rounded::<f64, 2>(&terms), terms);
        let single = rounded::<f32, 2>(&terms);
        assert!(single[f32::BACK_ORDER + 1..].iter().all(|row| *row == Row::all(0.0)));
        assert_ne!(single[f32::BACK_ORDER], terms[f32::BACK_ORDER].round());
    }
}
