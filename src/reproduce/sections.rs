//! Figs. 9 and 14: projected impact Poincaré sections, and the orbits around the Neimark–Sacker bifurcation at δ = 0.6.

use serde_json::json;

use super::orbits::{CHAOS, DOUBLED, largest_exponent, settles};
use super::paper_point::{PaperPoint, Plot, draw};
use super::{Claim, PaperFigure, Produced};
use crate::dynamics::Stop;

const CIRCLE: PaperPoint = PaperPoint::new(3.03, 0.1);
const BEFORE: PaperPoint = PaperPoint::symmetric(2.582, 0.6, 8000);
const AFTER: PaperPoint = PaperPoint::symmetric(2.57, 0.6, 8000);
/// Forcing periods that a section shows, and over which exponents are measured.
const SHOWN: u32 = 4000;
const PERIODS: u32 = 20_000;
/// Points of a section that are nearer to each other are one; non-dimensional.
const APART: f64 = 1e-6;

/// How many distinct points of the section σ an orbit visits, up to 100.
fn distinct(point: &PaperPoint) -> usize {
    let recording = point.recorded(400, 0);
    let mut points: Vec<[f64; 3]> = Vec::new();
    for impact in recording.impacts.iter().filter(|impact| impact.stop == Stop::A) {
        let place = [impact.velocity_after, impact.state[1], impact.state[3]];
        let known = |other: &[f64; 3]| other.iter().zip(place).all(|(a, b)| (a - b).abs() < APART);
        if points.len() < 100 && !points.iter().any(known) {
            points.push(place);
        }
    }
    points.len()
}

fn neutral(mean: f64, error: f64) -> bool {
    mean.abs() < (5.0 * error).max(2e-3)
}

const PLOTS_9: [Plot; 3] = [
    Plot::new("a", CIRCLE, "section:x2,v2", SHOWN),
    Plot::new("b", DOUBLED, "section:x2,v2", SHOWN),
    Plot::new("c", CHAOS, "section:x2,v2", 5 * SHOWN),
];

/// Sections of a circle, of two points, of chaos.
pub(super) const FIGURE_9: PaperFigure = PaperFigure {
    number: 9,
    caption: "Projected impact Poincaré sections, δ = 0.1: (a) quasi-periodic attractor around the 1-1-1 \
              unsymmetric motion, ω = 3.03; (b) fixed points of the 2-2-2 motion, ω = 2.95; (c) chaos, ω = 2.83.",
    settings: || json!({ "plots": PLOTS_9, "exponents": PERIODS }),
    make: |config, _| {
        let points = distinct(&DOUBLED);
        let claims = vec![
            settles(9, &CIRCLE, "quasi-periodic").0,
            largest_exponent(9, &CIRCLE, PERIODS, "zero (an invariant circle)", neutral),
            Claim::new(
                9,
                "points of the 2-2-2 motion on the section, ω = 2.95",
                "2",
                points.to_string(),
                points == 2,
            ),
            settles(9, &CHAOS, "chaotic").0,
        ];
        let picture = draw(&PLOTS_9, 3, config)?;
        Ok(Produced::one(picture, claims))
    },
};

const PLOTS_14: [Plot; 3] = [
    Plot::new("a", BEFORE, "portrait", 2),
    Plot::new("a1", BEFORE, "section:x2,v2", SHOWN),
    Plot::new("b", AFTER, "section:x2,v2", SHOWN),
];

/// The Neimark–Sacker bifurcation of the 1-1-1 symmetric motion at δ = 0.6.
pub(super) const FIGURE_14: PaperFigure = PaperFigure {
    number: 14,
    caption: "δ = 0.6: (a) phase portrait of the 1-1-1 symmetric motion, ω = 2.582, with (a1) its fixed point \
              on the section; (b) attracting invariant circle around it, ω = 2.57.",
    settings: || json!({ "plots": PLOTS_14, "exponents": PERIODS }),
    make: |config, _| {
        let rest = PaperPoint::new(BEFORE.omega, BEFORE.delta).verdict();
        let from_rest = format!("from rest the trajectory settles on: {}", rest.label());
        let claims = vec![
            settles(14, &BEFORE, "1-1-1 symmetric").0.noted(from_rest),
            settles(14, &AFTER, "quasi-periodic").0,
            largest_exponent(14, &AFTER, PERIODS, "zero (an invariant circle)", neutral),
        ];
        let picture = draw(&PLOTS_14, 3, config)?;
        Ok(Produced::one(picture, claims))
    },
};
