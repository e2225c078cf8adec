//! The Taylor series of flight: one recurrence for motions and deviations.

use crate::model::{Flight, Real};

/// 1/0!, 1/1!, 1/2!, …
pub const INVERSE_FACTORIALS: [f64; 19] = {
    let mut inverses = [1.0; 19];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = inverses[k - 1] / k as f64;
        k += 1;
    }
    inverses
};

/// One value for each mass, or a sine and a cosine.
pub(super) type Pair<T> = [T; 2];

/// a x + y.
#[inline(always)]
pub(super) fn axpy<T: Real>(a: T, x: Pair<T>, y: Pair<T>) -> Pair<T> {
    [y[0] + a * x[0], y[1] + a * x[1]]
}

/// The unforced part of Vₖ₊₁ = s² K Vₖ₋₁ + s C Vₖ (+ forcing), with Vₖ = v⁽ᵏ⁾ sᵏ for both masses.
///
/// `free` is 1 in free flight and 0 while the first mass rests on a stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series<T> {
    /// s² K, column by column.
    springs: [Pair<T>; 2],
    /// s C, column by column.
    dampers: [Pair<T>; 2],
    /// s, and s in the equations of the first mass that moves freely only.
    times: Pair<T>,
    /// rate·s.
    reach: T,
}

impl<T: Real> Series<T> {
    /// For a flight of length `s`.
    #[inline(always)]
    pub fn new(flight: &Flight<T>, s: T, free: T) -> Self {
        let damper = flight.inverse_mass * flight.coupling_damping;
        let first = s * free;
        let square = s * s;
        let spring = s * first;
        let damping = first * flight.coupling_damping;
        Series {
            springs: [
                [-spring, square * flight.inverse_mass],
                [spring, -(square * (flight.inverse_mass + flight.ground_stiffness))],
            ],
            dampers: [[-damping, s * damper], [damping, -(s * (damper + flight.ground_damping))]],
            times: [first, s],
            reach: flight.rate * s,
        }
    }

    /// V₁ from the displacements and V₀, the velocities.
    #[inline(always)]
    pub fn first(&self, flight: &Flight<T>, x: Pair<T>, v: Pair<T>) -> Pair<T> {
        let stretch = x[1] - x[0];
        let springs = [stretch, -(flight.inverse_mass * stretch) - flight.ground_stiffness * x[1]];
        let damped = axpy(v[1], self.dampers[1], [v[0] * self.dampers[0][0], v[0] * self.dampers[0][1]]);
        [damped[0] + self.times[0] * springs[0], damped[1] + self.times[1] * springs[1]]
    }

    /// Vₖ₊₁ from Vₖ₋₁, Vₖ and what the forcing adds; the newest term comes last, for the shortest chain.
    #[inline(always)]
    pub fn next(&self, before: Pair<T>, last: Pair<T>, forced: Pair<T>) -> Pair<T> {
        let [k0, k1] = self.springs;
        let [c0, c1] = self.dampers;
        let known = axpy(before[1], k1, axpy(before[0], k0, forced));
        let damped = axpy(last[1], c1, [last[0] * c0[0], last[0] * c0[1]]);
        [known[0] + damped[0], known[1] + damped[1]]
    }

    /// The bound (rate·s)ᵏ/k! on the k-th term, from that of (rate·s)ᵏ⁻¹, and whether it may be neglected.
    #[inline(always)]
    pub fn grow(&self, power: T, k: usize) -> (T, bool) {
        let power = power * self.reach;
        (power, power * T::of(INVERSE_FACTORIALS[k]) < T::of(T::TRUNCATION))
    }
}
