//! Truncated power series: a motion's neighbours to third order.

use std::ops::{Add, Mul};

use nalgebra::{SVector, Vector6};

use super::flow::{Flow, PHASE, Section, V1_PLUS, V2, X2, Z_V1, Z_V2, Z_X1, Z_X2};
use super::newton::next;
use super::pattern::Pattern;

/// The order that is kept, and the number of coefficients.
const TERMS: usize = 4;

/// c₀ + c₁ε + c₂ε² + c₃ε³.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Jet([f64; TERMS]);

impl Add for Jet {
    type Output = Jet;

    fn add(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Mul for Jet {
    type Output = Jet;

    fn mul(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|k| (0..=k).map(|i| self.0[i] * other.0[k - i]).sum()))
    }
}

impl Jet {
    fn scaled(self, factor: f64) -> Jet {
        Jet(self.0.map(|c| factor * c))
    }

    /// The sine and cosine, by the addition theorem and the series about c₀.
    fn sin_cos(self) -> (Jet, Jet) {
        let (sin, cos) = self.0[0].sin_cos();
        let rest = Jet([0.0, self.0[1], self.0[2], self.0[3]]);
        let square = rest * rest;
        let small_sin = rest + (square * rest).scaled(-1.0 / 6.0);
        let small_cos = Jet([1.0, 0.0, 0.0, 0.0]) + square.scaled(-0.5);
        (small_sin.scaled(cos) + small_cos.scaled(sin), small_cos.scaled(cos) + small_sin.scaled(-sin))
    }
}

/// A vector of series, coefficient by coefficient.
type Jets<const N: usize> = [SVector<f64, N>; TERMS];

/// Where one turn around a motion takes the sections u₀ + ε·direction: the coefficients of 1, ε, ε² and ε³.
///
/// The second is J·d, the third ½B(d, d) and the fourth ⅙C(d, d, d) with the derivatives J, B, C of the map of one
/// turn (of half of it and the mirror, where the pattern is mirrored). None where an impact grazes.
pub(super) fn turn(
    flow: &Flow,
    pattern: &Pattern,
    sections: &[Section],
    direction: &Section,
) -> Option<[Section; TERMS]> {
    let mut jets: Jets<4> = [sections[0], *direction, Section::zeros(), Section::zeros()];
    for i in 0..sections.len() {
        let due = next(pattern, sections, i);
        let time = (due.section[PHASE] - sections[i][PHASE]) / flow.omega;
        jets = arc(flow, pattern.stops[i].side(), &jets, time, due.stop.side())?;
    }
    let factors = pattern.closing_factors();
    let mut closed = jets.map(|section| section.component_mul(&factors));
    closed[0][PHASE] -= f64::from(pattern.half_turns) * std::f64::consts::PI;
    Some(closed)
}

/// One arc: flight for `time`, then for the little longer or shorter that the stop is away, then restitution.
fn arc(flow: &Flow, from: f64, sections: &Jets<4>, time: f64, to: f64) -> Option<Jets<4>> {
    let series = |j: usize| Jet(sections.map(|section| section[j]));
    let (sin, cos) = series(PHASE).sin_cos();
    let over = flow.over(time);
    let start: Jets<6> = std::array::from_fn(|k| {
        let x1 = if k == 0 { from * flow.delta } else { 0.0 };
        let section = &sections[k];
        Vector6::new(x1, section[X2], section[V1_PLUS], section[V2], sin.0[k], cos.0[k])
    });
    let arrival = start.map(|z| over * z);
    let speed = arrival[0][Z_V1];
    // The remaining time σ has no constant term; each pass finds one more coefficient.
    let mut left = Jet([0.0; TERMS]);
    let mut reached = arrival;
    for _ in 1..TERMS {
        for (left, reached) in left.0.iter_mut().zip(&reached).skip(1) {
            *left -= reached[Z_X1] / speed;
        }
        reached = flown(flow, &arrival, left);
    }
    if !left.0.iter().all(|c| c.is_finite()) {
        return None;
    }
    debug_assert!((reached[0][Z_X1] - to * flow.delta).abs() < 1e-6);
    Some(std::array::from_fn(|k| {
        let z = &reached[k];
        let constant = if k == 0 { flow.omega * time } else { 0.0 };
        Section::new(
            -flow.r * z[Z_V1],
            z[Z_X2],
            z[Z_V2],
            sections[k][PHASE] + constant + flow.omega * left.0[k],
        )
    }))
}

/// exp(Gσ) z for a series σ without constant term.
fn flown(flow: &Flow, z: &Jets<6>, sigma: Jet) -> Jets<6> {
    let mut sum = *z;
    let mut term = *z;
    for k in 1..TERMS {
        let rate = term.map(|z| flow.generator * z / k as f64);
        term = std::array::from_fn(|k| (0..=k).map(|i| rate[i] * sigma.0[k - i]).sum());
        for (sum, term) in sum.iter_mut().zip(&term) {
            *sum += term;
        }
    }
    sum
}
