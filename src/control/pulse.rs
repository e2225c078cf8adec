//! Period pulses that bring every P-th point back to the target: Eqs. (26) to (29).

use super::action::{Action, Method, Seen};
use super::components::Components;
use super::section_point::SectionPoint;
use super::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::Real;

/// The period pulse at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse<T> {
    /// The stop on whose section it acts.
    pub stop: Stop,
    /// P, iterates from one pulse to the next.
    pub period: u32,
    /// X0.
    pub target: SectionValues<T>,
    /// E: each component of X is measured with an error of up to so much.
    pub noise: T,
    /// What the errors are drawn from.
    pub seed: u32,
}

impl<T: Real, const N: usize> Method<T, N> for Pulse<T> {
    /// Q = X(n) − X0 is taken away, X(n) as measured.
    #[inline(always)]
    fn act(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        if !self.is_due(seen) {
            return Action::none();
        }
        let away = SectionPoint::new(&self.target).minus(&seen.section);
        let error = |i: usize| self.noise * uniform(self.seed, seen.controlled, i as u32);
        Action::correcting(Components::from_fn(|i| away[i] - error(i)))
    }
}

impl<T: Real> Pulse<T> {
    /// Whether a pulse falls on this iterate.
    pub fn is_due<const N: usize>(&self, seen: &Seen<T, N>) -> bool {
        seen.controlled.is_multiple_of(self.period)
    }
}

/// Errors are drawn with numbers that lie so far apart from one iterate to the next.
pub const ERRORS_APART: u32 = 4;
/// Low bits of a hash that are left out, so that what is left is exact in single precision …
pub const HASH_DROPPED: u32 = 8;
/// … and what the lowest bit that is left stands for, between −1 and 1.
pub const HASH_UNIT: f64 = 1.0 / 8_388_608.0;

// The 32-bit PCG hash RXS-M-XS: M. Jarzynski, M. Olano, Journal of Computer Graphics Techniques 9(3) (2020) 20-38.
pub const HASH_MULTIPLIER: u32 = 747_796_405;
pub const HASH_INCREMENT: u32 = 2_891_336_453;
pub const HASH_FACTOR: u32 = 277_803_737;
/// The highest bits, above this one, choose by how many more than [`HASH_LEAST`] a word is shifted.
pub const HASH_CHOICE: u32 = 28;
pub const HASH_LEAST: u32 = 4;
pub const HASH_LAST: u32 = 22;

/// A number between −1 and 1 that depends on nothing but these three: two rounds of the PCG hash.
fn uniform<T: Real>(seed: u32, iterate: u32, component: u32) -> T {
    let mixed =
        hash(hash(seed ^ iterate.wrapping_mul(ERRORS_APART).wrapping_add(component)).wrapping_add(iterate));
    T::of(f64::from(mixed >> HASH_DROPPED)) * T::of(HASH_UNIT) - T::one()
}

fn hash(value: u32) -> u32 {
    let state = value.wrapping_mul(HASH_MULTIPLIER).wrapping_add(HASH_INCREMENT);
    let word = ((state >> ((state >> HASH_CHOICE) + HASH_LEAST)) ^ state).wrapping_mul(HASH_FACTOR);
    (word >> HASH_LAST) ^ word
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_fill_their_range_evenly() {
        let drawn: Vec<f64> = (0..4000).map(|i| uniform(7, i / 4, i % 4)).collect();
        let mean = drawn.iter().sum::<f64>() / 4000.0;
        let square = drawn.iter().map(|x| x * x).sum::<f64>() / 4000.0;
        assert!(drawn.iter().all(|x| (-1.0..1.0).contains(x)));
        assert!(mean.abs() < 0.03 && (square - 1.0 / 3.0).abs() < 0.02, "{mean} {square}");
        assert_ne!(uniform::<f64>(7, 3, 1), uniform::<f64>(8, 3, 1));
    }
}
