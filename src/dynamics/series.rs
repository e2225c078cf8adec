//! The Taylor series of flight: one recurrence for motions and deviations.

use super::held::spared;
use super::stop::Contact;
use crate::model::vector::{added, applied, scaled, scaled_columns};
use crate::model::{Flight, Real};

/// 1/0!, 1/1!, 1/2!, …
pub const INVERSE_FACTORIALS: [f64; f64::ORDER + 2] = {
    let mut inverses = [1.0; f64::ORDER + 2];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = inverses[k - 1] / k as f64;
        k += 1;
    }
    inverses
};

/// The unforced part of Vₖ₊₁ = s² A Vₖ₋₁ + s B Vₖ (+ forcing), with Vₖ = v⁽ᵏ⁾ sᵏ for all coordinates, A = −M⁻¹K and
/// B = −M⁻¹C, but for what contacts take from them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series<T, const N: usize> {
    /// s² A, column by column.
    springs: [[T; N]; N],
    /// s B, column by column.
    dampers: [[T; N]; N],
    /// s.
    time: T,
    /// rate·|s|.
    reach: T,
}

impl<T: Real, const N: usize> Series<T, N> {
    /// For a flight of length `s` with the contacts that hold, backwards where that is negative.
    #[inline(always)]
    pub fn new(flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        let square = s * s;
        let mut springs = scaled_columns(square, &flight.stiffness);
        let mut dampers = scaled_columns(s, &flight.damping);
        for column in springs.iter_mut().chain(&mut dampers) {
            *column = spared(flight, contact, *column);
        }
        Series { springs, dampers, time: s, reach: flight.rate * s.abs() }
    }

    /// V₁ from the displacements and V₀, the velocities.
    #[inline(always)]
    pub fn first(&self, flight: &Flight<T, N>, contact: Contact, x: &[T; N], v: &[T; N]) -> [T; N] {
        let pulled = spared(flight, contact, applied(&flight.stiffness, x));
        added(&applied(&self.dampers, v), &scaled(self.time, &pulled))
    }

    /// Vₖ₊₁ from Vₖ₋₁, Vₖ and what the forcing adds; the newest term comes last, for the shortest chain.
    #[inline(always)]
    pub fn next(&self, before: &[T; N], last: &[T; N], forced: &[T; N]) -> [T; N] {
        let known = added(forced, &applied(&self.springs, before));
        added(&known, &applied(&self.dampers, last))
    }

    /// The bound (rate·|s|)ᵏ/k! on the k-th term, from that of (rate·|s|)ᵏ⁻¹, and whether it may be neglected.
    #[inline(always)]
    pub fn grow(&self, power: T, k: usize) -> (T, bool) {
        let power = power * self.reach;
        (power, power * T::of(INVERSE_FACTORIALS[k]) < T::of(T::TRUNCATION))
    }
}

/// A flight that is yet to be made; a type of its own, since what a closure does is not compiled with the instructions that
/// [`Real::fused`] asks for.
#[derive(Debug)]
pub(super) struct Flown<'a, F, T, const N: usize> {
    /// Where it begins.
    pub from: &'a F,
    /// The constants of the system.
    pub flight: &'a Flight<T, N>,
    /// How long it takes.
    pub s: T,
    /// The contacts that hold.
    pub contact: Contact,
}
