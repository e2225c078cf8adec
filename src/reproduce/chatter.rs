//! Figs. 12 and 13: time series with chattering impacts, with and without sticking.

use serde_json::json;

use super::paper_point::{PaperPoint, Plot, draw, words};
use super::{Claim, PaperFigure, Produced};
use crate::analysis::{CHATTER_RUN, Probe, Reading, Regime, Schedule, Section};
use crate::backend::{Job, trace};
use crate::dynamics::Stop;

/// What is printed of a chattering motion.
struct Printed {
    point: PaperPoint,
    words: &'static str,
    sticks: bool,
    /// Whether it repeats, where that is said.
    periodic: Option<bool>,
}

/// Forcing periods that are looked at.
const LOOKED_AT: u32 = 100;

/// The claim about a chattering motion: whether it chatters, sticks, repeats.
fn check(figure: u32, printed: &Printed) -> Claim {
    let point = &printed.point;
    let system = point.system();
    let probe = Probe { section: Section::A, reading: Reading::VBefore };
    let schedule = Schedule { transient: point.transient, observe: 500, max_period: 32, fixed_periods: true };
    let start = point.start.state(&system);
    let job = Job { system, start };
    let found = trace::<f64>(&job, &schedule, probe, 0);
    let verdict = found.verdict;
    let recording = point.recorded(LOOKED_AT, 0);
    let sticks = recording.sticks.len() as f64 / f64::from(LOOKED_AT);
    let per_period = |stop: Stop| {
        let impacts = recording.impacts.iter().filter(|impact| impact.stop == stop).count();
        impacts as f64 / f64::from(LOOKED_AT)
    };
    let chatters = found.rebounds >= CHATTER_RUN;
    let repeats = verdict.regime.is_periodic();
    let stuck = matches!(verdict.regime, Regime::PeriodicSticking | Regime::AperiodicSticking);
    let holds = chatters && stuck == printed.sticks && printed.periodic.is_none_or(|said| said == repeats);
    let computed = format!(
        "{}, {}, rows of up to {} rebounds",
        words(&verdict),
        if stuck { "sticking" } else { "no sticking" },
        found.rebounds
    );
    Claim::new(figure, format!("motion at {}", point.words()), printed.words, computed, holds).noted(format!(
        "{:.2} impacts at A and {:.2} at Ā per forcing period, {sticks:.2} rests",
        per_period(Stop::A),
        per_period(Stop::B),
    ))
}

/// Where sticking begins, with falling ω: the largest frequency of a grid at which the motion sticks.
fn sticking_from(delta: f64, high: f64, low: f64, count: u32) -> Option<f64> {
    let at = |i: u32| high + (low - high) * f64::from(i) / f64::from(count);
    let sticks = |omega: f64| !PaperPoint::new(omega, delta).recorded(20, 0).sticks.is_empty();
    (0..=count).map(at).find(|&omega| sticks(omega))
}

const PLOTS_12: [Plot; 4] = [
    Plot::new("a", PaperPoint::new(0.65, 0.1), "time", 3),
    Plot::new("b", PaperPoint::new(0.6, 0.1), "time", 3),
    Plot::new("c", PaperPoint::new(0.57, 0.1), "time", 3),
    Plot::new("c1", PaperPoint::new(0.57, 0.1), "time", 1).zoomed("t=0:0.5"),
];
/// Where the beginning of sticking is looked for.
const STICKING_12: (f64, f64, u32) = (0.57, 0.54, 60);

/// Chatter at δ = 0.1.
pub(super) const FIGURE_12: PaperFigure = PaperFigure {
    number: 12,
    caption: "Time series with chattering impacts, δ = 0.1: (a) ω = 0.65; (b) ω = 0.6; (c) ω = 0.57, printed as \
              sticking; (c1) enlarged.",
    settings: || json!({ "plots": PLOTS_12, "sticking": STICKING_12, "periods": LOOKED_AT }),
    make: |config, _| {
        let printed = |omega, words, sticks, periodic| Printed {
            point: PaperPoint::new(omega, 0.1),
            words,
            sticks,
            periodic,
        };
        let mut claims: Vec<Claim> = [
            printed(0.65, "chattering, non-periodic, no sticking", false, Some(false)),
            printed(0.6, "chattering, periodic, no sticking", false, Some(true)),
            printed(0.57, "chattering with sticking, periodic", true, Some(true)),
        ]
        .iter()
        .map(|printed| check(12, printed))
        .collect();
        let (high, low, count) = STICKING_12;
        if let (Some(claim), Some(omega)) = (claims.last_mut(), sticking_from(0.1, high, low, count)) {
            claim.note.push_str(&format!("; sticking from ω = {omega:.4} down"));
        }
        let picture = draw(&PLOTS_12, 2, config)?;
        Ok(Produced::one(picture, claims))
    },
};

const PLOTS_13: [Plot; 3] = [
    Plot::new("a", PaperPoint::new(0.35, 0.545), "time", 3),
    Plot::new("b", PaperPoint::new(0.3, 0.545), "time", 3),
    Plot::new("c", PaperPoint::new(0.25, 0.545), "time", 3),
];

/// Chatter at δ = 0.545.
pub(super) const FIGURE_13: PaperFigure = PaperFigure {
    number: 13,
    caption: "Time series with chattering impacts, δ = 0.545: (a) without sticking, ω = 0.35; (b) without \
              sticking, ω = 0.3; (c) with sticking, ω = 0.25.",
    settings: || json!({ "plots": PLOTS_13, "periods": LOOKED_AT }),
    make: |config, _| {
        let printed = |omega, words, sticks| Printed {
            point: PaperPoint::new(omega, 0.545),
            words,
            sticks,
            periodic: None,
        };
        let claims = [
            printed(0.35, "chattering without sticking", false),
            printed(0.3, "chattering without sticking", false),
            printed(0.25, "chattering with sticking", true),
        ]
        .iter()
        .map(|printed| check(13, printed))
        .collect();
        let picture = draw(&PLOTS_13, 1, config)?;
        Ok(Produced::one(picture, claims))
    },
};
