//! The largest multiplier of a settled motion, from the linear map of one turn.
//!
//! A tangent vector that is carried along for many periods tells the exponent only as far as it has aligned, and a pair of
//! complex multipliers lets it sway. A motion that has settled repeats: unit vectors carried through one turn each are the
//! columns of its monodromy matrix, whose powers grow as its largest multiplier does.

use crate::dynamics::Tangent;
use crate::model::{Real, State};

/// How often the matrix is squared: what its norm differs from that of its largest multiplier's power by is then divided
/// by 2¹⁶.
pub const SQUARINGS: u32 = 16;

/// What stands for the exponent −∞ of a motion that every deviation dies out on within a few turns: a kernel has no infinity.
pub const FORGETS: f64 = -2e38;
/// What stands for the exponent of a deviation that grew beyond all bounds.
pub const EXPLODES: f64 = 2e38;

/// An exponent as it is reported.
pub fn reported(exponent: f32) -> f32 {
    if exponent == FORGETS as f32 { f32::NEG_INFINITY } else { exponent }
}

/// The monodromy matrix of a motion of N coordinates, column by column, as turns complete it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn<T, const N: usize> {
    /// The forcing periods of a turn; 0 where none is measured.
    pub n: u32,
    /// What becomes of a unit displacement of each coordinate …
    x: [State<T, N>; N],
    /// … and of a unit velocity.
    v: [State<T, N>; N],
    /// The largest Lyapunov exponent per forcing period, once all columns are there.
    pub exponent: T,
}

impl<T: Real, const N: usize> Turn<T, N> {
    /// The turns in which all columns are measured.
    pub const COLUMNS: u32 = 2 * N as u32;

    /// Nothing to be measured.
    pub fn none() -> Self {
        Turn::over(0)
    }

    /// To be measured, over `n` forcing periods.
    pub fn over(n: u32) -> Self {
        Turn { n, x: [State::zero(); N], v: [State::zero(); N], exponent: T::of(EXPLODES) }
    }

    /// Whether it is measured.
    #[inline(always)]
    pub fn is_measured(&self) -> bool {
        self.n > 0
    }

    /// The deviation that is carried through the turn after `turns` others.
    pub fn begins_with(turns: u32) -> Tangent<T, N> {
        let unit = |i: u32| if i == turns { T::one() } else { T::zero() };
        Tangent(State {
            x: std::array::from_fn(|i| unit(i as u32)),
            v: std::array::from_fn(|i| unit((N + i) as u32)),
        })
    }

    /// Sees the tangent vector after `turns` ≥ 1 turns.
    pub fn complete(&mut self, turns: u32, tangent: &Tangent<T, N>) {
        let column = turns as usize - 1;
        if column < N {
            self.x[column] = tangent.0;
        } else if column < 2 * N {
            self.v[column - N] = tangent.0;
        }
        if turns == Self::COLUMNS {
            self.exponent = self.measured();
        }
    }

    /// ln of the spectral radius over n: the limit of ln ‖Mᵏ‖ / (kn).
    fn measured(&self) -> T {
        if !self.x.iter().chain(&self.v).all(State::is_finite) {
            return T::of(EXPLODES);
        }
        let mut power = *self;
        let mut sum = T::zero();
        let mut share = T::one();
        for _ in 0..=SQUARINGS {
            let size = power.largest();
            if size == T::zero() {
                return T::of(FORGETS);
            }
            sum = sum + share * size.logarithm();
            power = power.scaled(T::one() / size);
            power = power.squared();
            share = T::of(0.5) * share;
        }
        sum / T::of(f64::from(self.n))
    }

    /// The largest magnitude of an entry.
    fn largest(&self) -> T {
        let mut largest = T::zero();
        for column in self.x.iter().chain(&self.v) {
            for i in 0..2 * N {
                let size = column.get(i).abs();
                largest = if size > largest { size } else { largest };
            }
        }
        largest
    }

    fn scaled(&self, factor: T) -> Self {
        let mut scaled = *self;
        for i in 0..N {
            (scaled.x[i], scaled.v[i]) = (self.x[i].scaled(factor), self.v[i].scaled(factor));
        }
        scaled
    }

    fn squared(&self) -> Self {
        let mut squared = *self;
        for i in 0..N {
            (squared.x[i], squared.v[i]) = (self.applied(&self.x[i]), self.applied(&self.v[i]));
        }
        squared
    }

    /// The matrix times a vector.
    fn applied(&self, to: &State<T, N>) -> State<T, N> {
        let mut sum = self.x[0].scaled(to.x[0]);
        for i in 1..N {
            sum = sum.plus(to.x[i], &self.x[i]);
        }
        for i in 0..N {
            sum = sum.plus(to.v[i], &self.v[i]);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exponent over one period of the matrix with these rows.
    fn exponent<T: Real>(rows: [[f64; 4]; 4]) -> f64 {
        let mut turn = Turn::<T, 2>::over(1);
        for k in 0..4 {
            let column: Vec<T> = rows.iter().map(|row| T::of(row[k])).collect();
            turn.complete(k as u32 + 1, &Tangent(State::from_slice(&column)));
        }
        turn.exponent.widen()
    }

    /// A matrix of blocks, one in either half.
    fn blocks([[a, b], [c, d]]: [[f64; 2]; 2], [[e, f], [g, h]]: [[f64; 2]; 2]) -> [[f64; 4]; 4] {
        [[a, b, 0.0, 0.0], [c, d, 0.0, 0.0], [0.0, 0.0, e, f], [0.0, 0.0, g, h]]
    }

    /// Known multipliers: real ones of either sign, a complex pair, a Jordan block, and a matrix that is far from normal.
    #[test]
    fn it_is_the_logarithm_of_the_spectral_radius() {
        let rotation = |radius: f64, angle: f64| {
            let (sin, cos) = angle.sin_cos();
            [[radius * cos, -radius * sin], [radius * sin, radius * cos]]
        };
        let small = [[0.1, 0.0], [0.0, -0.2]];
        let cases: [([[f64; 4]; 4], f64); 6] = [
            (blocks([[0.5, 0.0], [0.0, -0.9]], small), 0.9),
            (blocks(small, rotation(0.7, 1.0)), 0.7),
            (blocks(rotation(0.99, 2.399_963), rotation(0.98, 0.3)), 0.99),
            (blocks([[0.5, 1.0], [0.0, 0.5]], small), 0.5),
            (blocks([[0.5, 1e4], [0.0, 0.4]], small), 0.5),
            (blocks([[1.5, 0.0], [0.0, 0.4]], small), 1.5),
        ];
        // The norm of the matrix alone would not do.
        assert!(
            cases
                .iter()
                .any(|(matrix, radius)| matrix.as_flattened().iter().any(|entry| *entry > 2.0 * radius))
        );
        for (matrix, radius) in cases {
            let exact = f64::ln(radius);
            let (double, single) = (exponent::<f64>(matrix), exponent::<f32>(matrix));
            assert!((double - exact).abs() < 4e-4, "{matrix:?}: {double} and {exact}");
            assert!((single - exact).abs() < 5e-4, "{matrix:?} in f32: {single} and {exact}");
        }
    }

    #[test]
    fn what_forgets_everything_or_grows_beyond_bounds_says_so() {
        let forgets = [
            exponent::<f64>(blocks([[0.0, 1.0], [0.0, 0.0]], [[0.0; 2]; 2])),
            exponent::<f32>([[0.0; 4]; 4]),
        ];
        assert_eq!(forgets.map(|exponent| reported(exponent as f32)), [f32::NEG_INFINITY; 2]);
        assert_eq!(reported(-0.5), -0.5);
        let explodes = blocks([[f64::INFINITY, 0.0], [0.0, 0.0]], [[0.0; 2]; 2]);
        assert_eq!(exponent::<f64>(explodes), EXPLODES);
    }

    #[test]
    fn turns_of_several_periods_share_the_growth() {
        let mut turn = Turn::<f64, 1>::over(3);
        turn.complete(1, &Tangent(State { x: [0.0], v: [-0.4] }));
        turn.complete(2, &Tangent(State { x: [0.9], v: [0.0] }));
        assert!((turn.exponent - 0.6f64.ln() / 3.0).abs() < 1e-4);
    }
}
