//! Figs. 7, 8, 10 and 11: phase portraits and time series of periodic and chaotic motions at δ = 0.1.

use serde_json::json;

use super::paper_point::{PaperPoint, Plot, draw, words};
use super::stability_loss::{grazes, lost};
use super::{Claim, Outcome, PaperFigure, Produced};
use crate::analysis::Verdict;
use crate::dynamics::Stop;
use crate::model::System;
use crate::theory::{Spectrum, settled_motion, symmetric_motions};

const SYMMETRIC: PaperPoint = PaperPoint::new(3.7, 0.1);
const UNSYMMETRIC: PaperPoint = PaperPoint::new(3.5, 0.1);
pub(super) const DOUBLED: PaperPoint = PaperPoint::new(2.95, 0.1);
const GRAZING: PaperPoint = PaperPoint::new(2.93193, 0.1);
pub(super) const CHAOS: PaperPoint = PaperPoint::new(2.83, 0.1);
const TWO: PaperPoint = PaperPoint::new(1.72, 0.1);
const TWO_UNSYMMETRIC: PaperPoint = PaperPoint::new(1.65, 0.1);
const FOUR: PaperPoint = PaperPoint::new(1.63, 0.1);
const EIGHT: PaperPoint = PaperPoint::new(1.628, 0.1);

/// The printed fixed point of the 1-1-1 motion at ω = 3.7; the sign of the first component is that of v1+ at A.
const FIXED_POINT: [(&str, &str); 4] =
    [("v1+", "-0.34545790"), ("x2", "-0.00634090"), ("v2", "0.02116031"), ("τ", "1.80213070")];

/// How far the printed fixed point may be from the closed form; non-dimensional.
const FIXED_POINT_TOLERANCE: f64 = 5e-6;

/// Where the 2-2-2 motion is printed to graze, ω at δ = 0.1.
const GRAZES_AT: &str = "2.93193";

/// The claim that a point has a printed motion.
pub(super) fn settles(figure: u32, point: &PaperPoint, printed: &str) -> (Claim, Verdict) {
    let verdict = point.verdict();
    let computed = words(&verdict);
    let holds = computed == printed || (verdict.label() == printed && !printed.contains(' '));
    let claim = format!("motion at {}", point.words());
    (Claim::new(figure, claim, printed, computed, holds), verdict)
}

const PLOTS_7: [Plot; 2] = [Plot::new("a", SYMMETRIC, "portrait", 2), Plot::new("b", SYMMETRIC, "time", 4)];

/// 1-1-1 symmetric motion.
pub(super) const FIGURE_7: PaperFigure = PaperFigure {
    number: 7,
    caption: "Phase portrait and time series of the 1-1-1 symmetric motion, δ = 0.1, ω = 3.7.",
    settings: || json!({ "plots": PLOTS_7 }),
    make: |config, _| {
        let (claim, _) = settles(7, &SYMMETRIC, "1-1-1 symmetric");
        let mut claims = vec![claim];
        let recording = SYMMETRIC.recorded(1, 0);
        let simulated = recording.impacts.iter().find(|impact| impact.stop == Stop::A);
        let simulated = simulated.map(|i| [i.velocity_after, i.state[1], i.state[3], i.phase]);
        let solved = symmetric_motions(&SYMMETRIC.system()).ok().and_then(|motions| {
            motions
                .into_iter()
                .find(|motion| motion.at_phase_zero.is_ok())
                .and_then(|motion| <[f64; 4]>::try_from(motion.motion.section()).ok())
        });
        for (i, (name, printed)) in FIXED_POINT.into_iter().enumerate() {
            let component = |section: [f64; 4]| section[i];
            let exact = solved.map(component);
            let followed =
                simulated.map_or_else(|| "none".to_owned(), |section| format!("{:.10}", component(section)));
            let sign = if i == 0 { "; the sign, lost in print, is that of leaving A" } else { "" };
            let mut claim = Claim::within(
                7,
                format!("X* of the 1-1-1 motion, {name}"),
                printed,
                exact,
                FIXED_POINT_TOLERANCE,
            );
            claim.note.push_str(&format!("; closed form, and the followed orbit has {followed}{sign}"));
            claims.push(claim);
        }
        Ok(Produced::one(draw(&PLOTS_7, 2, config)?, claims))
    },
};

const PLOTS_8: [Plot; 4] = [
    Plot::new("a", UNSYMMETRIC, "portrait", 2),
    Plot::new("b", DOUBLED, "portrait", 4),
    Plot::new("c", GRAZING, "portrait", 4),
    Plot::new("d", CHAOS, "portrait", 60),
];
/// Forcing periods over which exponents are measured.
const PERIODS_8: u32 = 20_000;
/// To which frequency the 2-2-2 motion is followed.
const UNTIL_8: f64 = 2.92;

/// From 1-1-1 unsymmetric motion to chaos.
pub(super) const FIGURE_8: PaperFigure = PaperFigure {
    number: 8,
    caption: "Phase portraits, δ = 0.1: (a) 1-1-1 unsymmetric motion, ω = 3.5; (b) 2-2-2 motion, ω = 2.95; (c) \
              2-2-2 motion that grazes a stop, ω = 2.93193; (d) chaos, ω = 2.83.",
    settings: || json!({ "plots": PLOTS_8, "exponents": PERIODS_8, "until": UNTIL_8 }),
    make: |config, _| {
        let mut claims = Vec::new();
        for (point, printed) in
            [(UNSYMMETRIC, "1-1-1 unsymmetric"), (DOUBLED, "2-2-2"), (GRAZING, "2-2-2"), (CHAOS, "chaotic")]
        {
            claims.push(settles(8, &point, printed).0);
        }
        claims.push(grazing_claim(&DOUBLED, &GRAZING, GRAZES_AT, UNTIL_8));
        claims.push(largest_exponent(8, &CHAOS, PERIODS_8, "positive", |mean, error| mean > 5.0 * error));
        Ok(Produced::one(draw(&PLOTS_8, 2, config)?, claims))
    },
};

/// The claim about the largest exponent of a point, per iterate of the impact map.
pub(super) fn largest_exponent(
    figure: u32,
    point: &PaperPoint,
    periods: u32,
    printed: &str,
    holds: impl Fn(f64, f64) -> bool,
) -> Claim {
    let system = point.system();
    let claim = format!("largest Lyapunov exponent per iterate at {}", point.words());
    let found = Spectrum::of(&system, &point.start.state(&system)[..], point.transient, periods);
    let per_iterate =
        found.as_ref().ok().and_then(|spectrum| Some((spectrum, spectrum.per_iterate(Stop::A)?)));
    match per_iterate {
        Some((spectrum, exponents)) => {
            let scale =
                if spectrum.per_period[0] == 0.0 { 1.0 } else { exponents[0] / spectrum.per_period[0] };
            let error = spectrum.standard_error[0] * scale.abs();
            let computed = format!("{} ± {}", rounded(exponents[0]), rounded(error).trim_start_matches('+'));
            Claim::new(figure, claim, printed, computed, holds(exponents[0], error)).noted(format!(
                "all four: {}",
                exponents.iter().copied().map(rounded).collect::<Vec<_>>().join(", ")
            ))
        }
        None => Claim::new(figure, claim, printed, "none", false),
    }
}

/// A signed number in four decimals, in powers of ten where those would show little but zeros.
fn rounded(value: f64) -> String {
    if value == 0.0 || value.abs() >= 1e-3 { format!("{value:+.4}") } else { format!("{value:+.0e}") }
}

/// The claim that the motion of one point grazes a stop at another: it does if the motion, followed there, touches a stop at
/// the printed frequency, to its digits, and is still stable when it does.
fn grazing_claim(from: &PaperPoint, point: &PaperPoint, printed: &str, until: f64) -> Claim {
    let touches = grazes(from, until);
    let lost = lost(from, until);
    let gap = |point: &PaperPoint| {
        nearest_miss(point).map_or_else(|| "no near miss".to_owned(), |gap| format!("{gap:.2e}"))
    };
    let first = match (&lost, touches) {
        (Some(loss), touches) if touches.is_none_or(|omega| omega < loss.omega) => format!(
            "; before it would touch, {} loses its stability at ω = {:.5}, {}",
            loss.label,
            loss.omega,
            loss.kind()
        ),
        _ => String::new(),
    };
    let at = Claim::number(8, format!("the motion at {} grazes a stop", point.words()), printed, touches);
    let holds = at.verdict == Outcome::Agrees && first.is_empty();
    let where_it_does =
        touches.map_or_else(|| format!("not down to ω = {until}"), |omega| format!("at ω = {omega:.5}"));
    let computed = format!("turns back {} before a stop; touches it {where_it_does}{first}", gap(point));
    Claim::new(8, at.claim, format!("grazing at ω = {printed}"), computed, holds).noted(format!(
        "{} at ω = {}",
        gap(from),
        from.omega
    ))
}

/// How near to a stop the first mass turns back without touching it, over two periods of the motion; δ is the unit's
/// scale. None where every turn is an impact.
fn nearest_miss(point: &PaperPoint) -> Option<f64> {
    let recording = point.recorded(4, 20_000);
    let turns = recording.samples.windows(3).filter_map(|three| {
        let side = three[1].state[0].signum();
        let [a, b, c] = [0, 1, 2].map(|i| side * three[i].state[0]);
        let struck = recording.impacts.iter().any(|i| (three[0].time..=three[2].time).contains(&i.time));
        let turns = b > a && b >= c && three[0].state[2] * three[2].state[2] <= 0.0 && !struck;
        // The top of the parabola through the three.
        turns.then(|| point.delta - (b + (c - a).powi(2) / (8.0 * (2.0 * b - a - c)).max(1e-300)))
    });
    turns.reduce(f64::min)
}

const PLOTS_10: [Plot; 2] = [Plot::new("a", TWO, "portrait", 2), Plot::new("b", TWO, "time", 4)];

/// 1-2-2 symmetric motion.
pub(super) const FIGURE_10: PaperFigure = PaperFigure {
    number: 10,
    caption: "Phase portrait and time series of the 1-2-2 symmetric motion, δ = 0.1, ω = 1.72.",
    settings: || json!({ "plots": PLOTS_10 }),
    make: |config, _| {
        let (claim, verdict) = settles(10, &TWO, "1-2-2 symmetric");
        let stable = multipliers(&TWO.system(), &verdict);
        let computed = stable.map_or_else(|| "none".to_owned(), |largest| format!("{largest:.4}"));
        let holds = stable.is_some_and(|largest| largest < 1.0);
        let stability =
            Claim::new(10, "its largest multiplier in modulus", "below 1 (stable)", computed, holds);
        Ok(Produced { pictures: vec![("", draw(&PLOTS_10, 2, config)?)], claims: vec![claim, stability] })
    },
};

/// The largest modulus among the multipliers of the motion that a trajectory settled on.
fn multipliers(system: &System, verdict: &Verdict) -> Option<f64> {
    let motion = settled_motion(system, &verdict.state[..], verdict.n.into()).ok()?;
    Some(motion.multipliers(system)?[0].norm())
}

const PLOTS_11: [Plot; 3] = [
    Plot::new("a", TWO_UNSYMMETRIC, "portrait", 2),
    Plot::new("b", FOUR, "portrait", 4),
    Plot::new("c", EIGHT, "portrait", 8),
];
/// Between which frequencies the doubling of 2-4-4 is looked for.
const DOUBLING_11: [f64; 2] = [1.63, 1.62];

/// The beginning of the period-doubling cascade.
pub(super) const FIGURE_11: PaperFigure = PaperFigure {
    number: 11,
    caption: "Phase portraits, δ = 0.1: (a) 1-2-2 unsymmetric motion, ω = 1.65; (b) 2-4-4, ω = 1.63; (c) ω = \
              1.628, printed as 4-8-8.",
    settings: || json!({ "plots": PLOTS_11, "doubling": DOUBLING_11 }),
    make: |config, _| {
        let mut claims: Vec<Claim> =
            [(TWO_UNSYMMETRIC, "1-2-2 unsymmetric"), (FOUR, "2-4-4"), (EIGHT, "4-8-8")]
                .map(|(point, printed)| settles(11, &point, printed).0)
                .into();
        let [from, until] = DOUBLING_11;
        if let (Some(claim), Some(loss)) = (claims.last_mut(), lost(&PaperPoint::new(from, 0.1), until)) {
            claim.note =
                format!("{} loses its stability at ω = {:.6}, {}", loss.label, loss.omega, loss.kind());
        }
        Ok(Produced::one(draw(&PLOTS_11, 3, config)?, claims))
    },
};
