//! Truncated power series: a motion's neighbours to third order.

use std::ops::{Add, Mul};

use nalgebra::DVector;

use super::flow::Flow;
use super::newton::next;
use super::pattern::Pattern;
use super::section_vector::{Node, SectionVector, phase};
use crate::dynamics::Stop;

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
    fn phasor(self) -> (Jet, Jet) {
        let (sin, cos) = libm::sincos(self.0[0]);
        let rest = Jet([0.0, self.0[1], self.0[2], self.0[3]]);
        let square = rest * rest;
        let small_sin = rest + (square * rest).scaled(-1.0 / 6.0);
        let small_cos = Jet([1.0, 0.0, 0.0, 0.0]) + square.scaled(-0.5);
        (small_sin.scaled(cos) + small_cos.scaled(sin), small_cos.scaled(cos) + small_sin.scaled(-sin))
    }
}

/// A vector of series, coefficient by coefficient.
type Jets = [DVector<f64>; TERMS];

/// Where one turn around a motion takes the sections u₀ + ε·direction: the coefficients of 1, ε, ε² and ε³.
///
/// The second is J·d, the third ½B(d, d) and the fourth ⅙C(d, d, d) with the derivatives J, B, C of the map of one
/// turn (of half of it and the mirror, where the pattern is mirrored). None where an impact grazes.
pub(super) fn turn(
    flow: &Flow,
    pattern: &Pattern,
    sections: &[SectionVector],
    direction: &SectionVector,
) -> Option<[SectionVector; TERMS]> {
    let zero = || SectionVector::zeros(direction.len());
    let mut jets: Jets = [sections[0].clone(), direction.clone(), zero(), zero()];
    for i in 0..sections.len() {
        let due = next(flow, pattern, sections, i);
        let time = (phase(&due.section) - phase(&sections[i])) / flow.omega;
        jets = arc(flow, pattern.stops[i], &jets, time, due.stop)?;
    }
    jets[0][direction.len() - 1] -= pattern.turn();
    let reopening = pattern.reopening_matrix(flow);
    let [begin, ..] = &jets;
    let image = Node { stop: pattern.closing_stop(), section: begin.clone() };
    let begin = if pattern.mirrored { flow.mirror_image(&image).section } else { image.section };
    let [_, first, second, third] = jets;
    Some([begin, &reopening * first, &reopening * second, &reopening * third])
}

/// One arc: flight for `time`, then for the little longer or shorter that the stop is away, then the impact.
fn arc(flow: &Flow, from: Stop, sections: &Jets, time: f64, to: Stop) -> Option<Jets> {
    let last = 2 * flow.n - 1;
    let series = |j: usize| Jet(std::array::from_fn(|k| sections[k][j]));
    let (sin, cos) = series(last).phasor();
    let over = flow.over(time);
    let (departure, arrived) = (flow.face(from), flow.face(to));
    let arrival: Jets = std::array::from_fn(|k| {
        let mut z = if k == 0 { departure.lifted(&sections[k]) } else { &departure.lift * &sections[k] };
        z[2 * flow.n] = sin.0[k];
        z[2 * flow.n + 1] = cos.0[k];
        over.as_ref() * z
    });
    let [place, speed] = arrived.along(&arrival[0]);
    debug_assert!((place - arrived.gap).abs() < 1e-6 * (flow.unit() + arrived.gap.abs()));
    let terms = terms(flow, arrival);
    let place_of = |z: &DVector<f64>| arrived.along(z)[0];
    let places: Vec<Vec<f64>> = terms.iter().map(|term| term.iter().map(place_of).collect()).collect();
    // The remaining time σ has no constant term; each pass finds one more coefficient.
    let mut left = Jet([0.0; TERMS]);
    for _ in 1..TERMS {
        let reached = flown(&places, left);
        for (left, reached) in left.0.iter_mut().zip(reached).skip(1) {
            *left -= reached / speed;
        }
    }
    if !left.0.iter().all(|c| c.is_finite()) {
        return None;
    }
    let reached = flown(&terms, left);
    Some(std::array::from_fn(|k| {
        let constant = if k == 0 { flow.omega * time } else { 0.0 };
        let mut section = &arrived.restituted * &reached[k];
        section[last] = sections[k][last] + constant + flow.omega * left.0[k];
        section
    }))
}

/// Gᵏ z/k! by k, each with as many coefficients as have a share in those of [`flown`] that are kept.
fn terms(flow: &Flow, z: Jets) -> Vec<Vec<DVector<f64>>> {
    let mut terms = vec![Vec::from(z)];
    for k in 1..TERMS {
        let before = &terms[k - 1][..TERMS - k];
        terms.push(before.iter().map(|z| flow.generator() * z / k as f64).collect());
    }
    terms
}

/// exp(Gσ) z for a series σ without constant term, or what is linear in it: the sum of Gᵏ z/k! · σᵏ, of which σᵏ begins with εᵏ.
fn flown<V>(terms: &[Vec<V>], sigma: Jet) -> [V; TERMS]
where
    V: Clone + Add<Output = V> + Mul<f64, Output = V>,
{
    let mut powers = [Jet([1.0, 0.0, 0.0, 0.0]); TERMS];
    for k in 1..TERMS {
        powers[k] = powers[k - 1] * sigma;
    }
    std::array::from_fn(|m| {
        let shares = (1..=m).flat_map(|k| (0..=m - k).map(move |j| (k, j)));
        shares.fold(terms[0][m].clone(), |sum, (k, j)| sum + terms[k][j].clone() * powers[k].0[m - j])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theory::example::chain;
    use crate::theory::{PeriodicMotion, impact_map, symmetric_motions};

    /// The whole period of the chain's symmetric motion, as a motion that is not mirrored.
    fn motion() -> PeriodicMotion {
        let solutions = symmetric_motions(&chain()).unwrap();
        let physical = solutions.into_iter().find(|solution| solution.at_phase_zero.is_ok()).unwrap();
        let mut motion = physical.motion;
        let flow = Flow::new(&chain());
        let again = motion.pattern.closing(&flow, &motion.sections[0]);
        motion.sections.push(again.section);
        motion.pattern = Pattern::new(&chain(), vec![motion.pattern.stops[0], again.stop], 2, false);
        motion
    }

    /// First and second derivatives of the return map against differences of the simulated one.
    #[test]
    fn the_series_is_that_of_the_simulated_map() {
        let (system, motion) = (chain(), motion());
        let flow = Flow::new(&system);
        let direction = SectionVector::from_row_slice(&[0.5, -0.3, 0.2, 0.4, -0.6, 0.3]);
        let series = turn(&flow, &motion.pattern, &motion.sections, &direction).unwrap();
        let at = |h: f64| {
            let section = &motion.sections[0] + &direction * h;
            SectionVector::from_vec(impact_map(&system, section.as_slice()).unwrap().section)
        };
        let h = 1e-3;
        let first = ((at(h) - at(-h)) * 8.0 - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let second = (at(h) + at(-h) - at(0.0) * 2.0) / (h * h);
        let third = (at(2.0 * h) - at(-2.0 * h) - (at(h) - at(-h)) * 2.0) / (2.0 * h * h * h);
        let off =
            |found: &SectionVector, simulated: &SectionVector| (found - simulated).amax() / simulated.amax();
        assert!(off(&series[1], &first) < 1e-7, "{}{first}", series[1]);
        assert!(off(&(&series[2] * 2.0), &second) < 1e-3, "{}{second}", &series[2] * 2.0);
        assert!(off(&(&series[3] * 6.0), &third) < 1e-2, "{}{third}", &series[3] * 6.0);
        assert!(off(&(&series[2] * 2.1), &second) > 1e-3, "the check can fail");
    }
}
