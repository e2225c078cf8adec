//! Between what a motion lies that is known at both ends of a time: the hull of five Bernstein coefficients.

use crate::model::Lanes;

/// What the error of a cubic Hermite interpolant adds to the middle one of five Bernstein coefficients, in w⁴·max|f''''|.
pub const SWELLING: f64 = 1.0 / 144.0;

/// A time, and what hulls need of it.
#[derive(Clone, Copy, Debug)]
pub struct Span<L> {
    /// How long it is.
    pub time: L,
    quarter: L,
    sixth: L,
    /// By what a bound on the fourth derivative is multiplied.
    swelling: L,
}

impl<L: Lanes> Span<L> {
    /// Of such a length.
    #[inline(always)]
    pub fn of(time: L) -> Self {
        let square = time * time;
        Span {
            time,
            quarter: time * time.all(0.25),
            sixth: time * time.all(1.0 / 6.0),
            swelling: (square * square) * time.all(SWELLING),
        }
    }
}

/// The inner three of the five Bernstein coefficients of what bounds f from above and from below; the outer two are f at both ends.
///
/// f differs from its cubic Hermite interpolant by s²(w − s)²/24·max|f''''| at most: a polynomial of fourth degree, so that
/// what bounds f lies within the hull of its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Hull<L> {
    second: L,
    fourth: L,
    /// The middle one of the lower bound: a NaN where anything is.
    lower: L,
    /// The middle one of the upper bound, likewise.
    upper: L,
}

impl<L: Lanes> Hull<L> {
    /// Of what is `ends` at both ends of a time, with the derivatives `slopes`; `bound` is on its fourth derivative.
    #[inline(always)]
    pub fn of(ends: [L; 2], slopes: [L; 2], bound: L, span: &Span<L>) -> Self {
        let margin = span.swelling * bound;
        let half = bound.all(0.5);
        let second = slopes[0].times_plus(span.quarter, ends[0]);
        let fourth = (-slopes[1]).times_plus(span.quarter, ends[1]);
        let begins = slopes[0].times_plus(span.sixth, ends[0] * half);
        let middle = ends[1].times_plus(half, (-slopes[1]).times_plus(span.sixth, begins));
        Hull { second, fourth, lower: middle - margin, upper: middle + margin }
    }

    /// The lowest of the inner three; here and below the middle one is asked last, so that it is a NaN where anything is, and the
    /// others do not wait for it.
    #[inline(always)]
    pub fn lowest(&self) -> L {
        self.second.smaller(self.fourth).smaller(self.lower)
    }

    /// The highest.
    #[inline(always)]
    pub fn highest(&self) -> L {
        self.second.larger(self.fourth).larger(self.upper)
    }

    /// The lowest of the inner three and an outer one.
    #[inline(always)]
    pub fn lowest_with(&self, outer: L) -> L {
        self.second.smaller(self.fourth).smaller(outer).smaller(self.lower)
    }

    /// The highest.
    #[inline(always)]
    pub fn highest_with(&self, outer: L) -> L {
        self.second.larger(self.fourth).larger(outer).larger(self.upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x and v of a motion a time s after a phase, and a bound on x''''.
    fn motion(phase: f64, s: f64) -> [f64; 2] {
        [
            (phase + s).sin() + 0.3 * (2.0 * (phase + s)).cos(),
            (phase + s).cos() - 0.6 * (2.0 * (phase + s)).sin(),
        ]
    }
    const BOUND: f64 = 1.0 + 0.3 * 16.0;

    /// How far beyond the hull a motion gets, and how far it stays within it at most.
    fn beyond(bound: f64) -> f64 {
        let mut most = f64::NEG_INFINITY;
        for phase in (0..64).map(|i| 0.1 * f64::from(i)) {
            for window in [0.01, 0.3, 1.0, 2.0] {
                let [from, to] = [motion(phase, 0.0), motion(phase, window)];
                let hull = Hull::of([from[0], to[0]], [from[1], to[1]], bound, &Span::of(window));
                let (lowest, highest) =
                    (hull.lowest().min(from[0]).min(to[0]), hull.highest().max(from[0]).max(to[0]));
                for part in 0..=256 {
                    let x = motion(phase, window * f64::from(part) / 256.0)[0];
                    most = most.max(x - highest).max(lowest - x);
                }
            }
        }
        most
    }

    #[test]
    fn a_motion_lies_within_its_hull() {
        assert!(beyond(BOUND) < 1e-14, "{}", beyond(BOUND));
        // Without the bound on its fourth derivative it does not.
        assert!(beyond(0.0) > 1e-3, "{}", beyond(0.0));
    }

    #[test]
    fn nothing_is_known_of_a_motion_that_is_not_a_number() {
        let all = |hull: &Hull<f64>, to: f64| {
            [hull.lowest(), hull.highest(), hull.lowest_with(to), hull.highest_with(to)]
        };
        for wrong in 0..6 {
            let mut values = [0.1f64, 0.2, 0.3, 0.4, 0.5, 0.6];
            values[wrong] = f64::NAN;
            let [from, to, leaves, arrives, bound, window] = values;
            let hull = Hull::of([from, to], [leaves, arrives], bound, &Span::of(window));
            assert!(all(&hull, to).iter().all(|value| value.is_nan()), "{wrong}");
        }
        let hull = Hull::of([0.1f64, 0.2], [0.3, 0.4], 0.5, &Span::of(0.6));
        assert!(all(&hull, 0.2).iter().all(|value| value.is_finite()));
    }
}
