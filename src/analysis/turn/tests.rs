//! Matrices whose multipliers, and whose sums, are known.

use super::*;

/// A turn of one period, whose matrix has these rows.
fn measured<T: Real>(rows: [[f64; 4]; 4]) -> Turn<T, 2> {
    let mut turn = Turn::<T, 2>::over(1);
    for k in 0..4 {
        let column: Vec<T> = rows.iter().map(|row| T::of(row[k])).collect();
        turn.complete(k as u32 + 1, &Tangent(State::from_slice(&column)));
    }
    turn
}

/// Its exponent.
fn exponent<T: Real>(rows: [[f64; 4]; 4]) -> f64 {
    measured::<T>(rows).exponent.widen()
}

/// A matrix of blocks, one in either half.
fn blocks([[a, b], [c, d]]: [[f64; 2]; 2], [[e, f], [g, h]]: [[f64; 2]; 2]) -> [[f64; 4]; 4] {
    [[a, b, 0.0, 0.0], [c, d, 0.0, 0.0], [0.0, 0.0, e, f], [0.0, 0.0, g, h]]
}

fn rotation(radius: f64, angle: f64) -> [[f64; 2]; 2] {
    let (sin, cos) = angle.sin_cos();
    [[radius * cos, -radius * sin], [radius * sin, radius * cos]]
}

/// Known multipliers: real ones of either sign, a complex pair, a Jordan block, and a matrix that is far from normal.
#[test]
fn it_is_the_logarithm_of_the_spectral_radius() {
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
        cases.iter().any(|(matrix, radius)| matrix.as_flattened().iter().any(|entry| *entry > 2.0 * radius))
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
    let forgets =
        [exponent::<f64>(blocks([[0.0, 1.0], [0.0, 0.0]], [[0.0; 2]; 2])), exponent::<f32>([[0.0; 4]; 4])];
    assert_eq!(forgets.map(|exponent| reported(exponent as f32)), [f32::NEG_INFINITY; 2]);
    assert_eq!(reported(-0.5), -0.5);
    let explodes = blocks([[f64::INFINITY, 0.0], [0.0, 0.0]], [[0.0; 2]; 2]);
    assert_eq!(exponent::<f64>(explodes), EXPLODES);
}

/// s = y + M s, in roundings of the largest component of s.
fn misses<T: Real>(rows: [[f64; 4]; 4], powers_of: impl Fn(&Turn<T, 2>) -> Turn<T, 2>) -> f64 {
    let turn = measured::<T>(rows);
    let y = State { x: [1.0, -0.3].map(T::of), v: [0.2, 0.7].map(T::of) };
    let sum = powers_of(&turn).followed_for_ever(&y);
    let missed = y.added(&turn.applied(&sum)).plus(-T::one(), &sum);
    let size = |state: &State<T, 2>| (0..4).map(|i| state.get(i).abs().widen()).fold(0.0, f64::max);
    size(&missed) / (T::EPSILON * size(&sum))
}

fn follows_to_the_end<T: Real>() {
    let small = [[0.1, 0.0], [0.0, -0.2]];
    for matrix in [
        blocks([[0.5, 0.0], [0.0, -0.9]], small),
        blocks([[0.998, 0.0], [0.0, 0.3]], rotation(0.7, 1.0)),
        blocks(rotation(0.99, 0.1), rotation(0.9, 2.0)),
        blocks([[0.5, 1e3], [0.0, 0.4]], small),
        blocks([[0.0; 2]; 2], [[0.0; 2]; 2]),
    ] {
        let missed = misses::<T>(matrix, |turn| *turn);
        assert!(missed < 1e3, "{matrix:?} misses by {missed} roundings");
    }
    let matrix = blocks([[0.998, 0.0], [0.0, 0.3]], small);
    assert!(misses::<T>(matrix, |turn| turn.squared()) > 1e4, "the check can fail");
}

#[test]
fn a_deviation_is_followed_for_ever() {
    follows_to_the_end::<f64>();
    follows_to_the_end::<f32>();
}

#[test]
fn turns_of_several_periods_share_the_growth() {
    let mut turn = Turn::<f64, 1>::over(3);
    turn.complete(1, &Tangent(State { x: [0.0], v: [-0.4] }));
    turn.complete(2, &Tangent(State { x: [0.9], v: [0.0] }));
    assert!((turn.exponent - 0.6f64.ln() / 3.0).abs() < 1e-4);
}
