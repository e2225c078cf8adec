//! Series brought to lower orders on an interval: term by term, with Chebyshev polynomials of it (Lanczos, *Applied Analysis*,
//! 1956).

use std::borrow::Cow;
use std::sync::LazyLock;

use pulp::NullaryFnOnce;
use smallvec::SmallVec;

use super::real::Real;
use super::row::Term;

/// About as many terms as a series has over a step.
const USUAL_TERMS: usize = 32;

/// The terms of a series, on the heap only where they are more than usual.
pub(super) type Terms<V> = SmallVec<[V; USUAL_TERMS]>;

/// The first of these terms, as many as there is room for; 0 where there are fewer.
pub(super) fn filled<V: Term, const M: usize>(terms: &[V]) -> [V; M] {
    std::array::from_fn(|k| terms.get(k).copied().unwrap_or(V::zero()))
}

/// Brings a polynomial Σ cₖ uᵏ, 0 ≤ u ≤ 1, to a lower order; what it was brought down from is left 0.
///
/// Of all polynomials of order m with the highest coefficient 1, T*ₘ(u)/2²ᵐ⁻¹ is nowhere more than 2¹⁻²ᵐ on the interval, T*ₘ
/// being Chebyshev's polynomial of 2u − 1. So cₖ uᵏ is made one of lower order by taking cₖ u T*ₖ₋₁(u)/2²ᵏ⁻³ from it. The factor
/// u keeps the value at u = 0 exact, and the error in proportion to the time near it.
pub(super) fn economize<V: Term>(terms: &mut [V], order: usize) {
    f64::fused(Economizing { terms, order });
}

/// A polynomial that is yet to be brought to an order; a type of its own, since what a closure does is not compiled with the
/// instructions that [`Real::fused`] asks for.
struct Economizing<'a, V> {
    terms: &'a mut [V],
    order: usize,
}

impl<V: Term> NullaryFnOnce for Economizing<'_, V> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Economizing { terms, order } = self;
        for highest in (order + 1..terms.len()).rev() {
            let term = std::mem::replace(&mut terms[highest], V::zero());
            let known = LOWER.get(highest).map_or_else(|| Cow::Owned(lower(highest)), Cow::from);
            for k in 1..highest {
                terms[k] = terms[k].plus(-known[k - 1], &term);
            }
        }
    }
}

/// The coefficients of u, u² … uᵏ⁻¹ in u T*ₖ₋₁(u)/2²ᵏ⁻³, where that of uᵏ is 1.
fn lower(k: usize) -> Vec<f64> {
    let m = k as f64 - 1.0;
    let mut coefficients = vec![0.0; k.saturating_sub(1)];
    let mut coefficient = 1.0;
    for (i, place) in coefficients.iter_mut().enumerate().rev() {
        let j = (i + 1) as f64;
        coefficient *= -j * (2.0 * j - 1.0) / (2.0 * (m + j - 1.0) * (m - j + 1.0));
        *place = coefficient;
    }
    coefficients
}

/// Those of terms that most series have.
static LOWER: LazyLock<[Vec<f64>; USUAL_TERMS]> = LazyLock::new(|| std::array::from_fn(lower));

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::State;

    #[test]
    fn however_many_terms_there_are_the_polynomial_stays_near() {
        for count in [USUAL_TERMS - 1, USUAL_TERMS, USUAL_TERMS + 1, USUAL_TERMS + 9] {
            let long: Vec<State<f64, 1>> =
                (0..count).map(|k| State { x: [1.0 / (k + 1) as f64], v: [(k as f64).cos()] }).collect();
            let mut short = long.clone();
            economize(&mut short, count - 3);
            assert!(short[count - 2..].iter().all(|term| *term == State::zero()));
            let at = |terms: &[State<f64, 1>], u: f64| {
                terms.iter().rev().fold(State::zero(), |sum: State<f64, 1>, term| term.plus(u, &sum))
            };
            for u in (0..=16).map(|part| f64::from(part) / 16.0) {
                let (exact, found) = (at(&long, u), at(&short, u));
                assert!((exact.x[0] - found.x[0]).abs() < 1e-8, "{count} terms at {u}");
                assert!((exact.v[0] - found.v[0]).abs() < 1e-8, "{count} terms at {u}");
            }
            let cut = at(&long[..count - 2], 1.0);
            assert!((at(&long, 1.0).x[0] - cut.x[0]).abs() > 1e-3, "the check can fail");
        }
    }
}
