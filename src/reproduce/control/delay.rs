//! Figs. 19 to 23: delayed feedback.

use rayon::prelude::*;

use super::super::{Claim, PaperFigure, Produced};
use super::{
    FROM, PORTRAIT, Plot, RESPONSES, Run, STARTS, TAU, TIME, components, draw, motion, settings, start,
};
use crate::analysis::Reading;
use crate::control::methods::{DelaySetting, Sign};
use crate::control::{Scheme, SectionValues};
use crate::dynamics::Stop;

const ITERATES: u32 = 4000;
const LONG: u32 = 6000;
const PRINTED: [&str; 4] = ["-0.41959444", "-0.02899695", "0.02903516", "1.80121257"];
const HALF: f64 = 0.5;
/// The gains of Fig. 21, and those that are called more effective.
const GAINS: [f64; 4] = [0.8, 0.6, 0.3, 0.25];
const EFFECTIVE: [f64; 3] = [0.3, 0.4, 0.5];
const LARGE: f64 = 0.97;
const LARGEST: &str = "0.9677";
const SMALL: f64 = 0.1;
const DOUBLED: &str = "2-4-2";

const fn feedback(gain: f64, sign: Sign) -> Scheme {
    Scheme::Delay(DelaySetting { stop: Stop::A, gains: SectionValues::new([gain; 4]), delay: 1, sign })
}

const fn stabilising(gain: f64) -> Scheme {
    feedback(gain, Sign::Stabilising)
}

/// How many of the starts end like that, of trajectories of so many iterates.
fn ends(gain: f64, iterates: u32, like: impl Fn(&Run) -> bool + Sync) -> usize {
    let run = |number| Run::new(stabilising(gain), iterates, start(number));
    (0..STARTS).into_par_iter().filter(|&number| like(&run(number))).count()
}

/// The run that is shown of those with the gain of Figs. 19 and 20, where several motions are stable and which of them chaos
/// ends on depends on the start.
fn shown_run() -> Run {
    Run::first(stabilising(HALF), ITERATES, STARTS, Run::is_captured)
}

fn captured(gain: f64, iterates: u32) -> String {
    format!("{} of {STARTS} starts are captured", ends(gain, iterates, Run::is_captured))
}

fn shown(time: Option<u32>) -> String {
    time.map_or_else(|| "never".to_owned(), |time| time.to_string())
}

/// Time responses.
pub(in super::super) const FIGURE_19: PaperFigure = PaperFigure {
    number: 19,
    caption: "Time responses under delayed feedback, g = 0.5, p = 1, ω = 2.83: (a) length of the correction, \
              (b) τ, (c) x1'+, (d) x2, (e) x2'; control from iterate 2000.",
    settings: || settings(&[stabilising(HALF), feedback(HALF, Sign::Printed)], ITERATES),
    make: |config, _| {
        let run = shown_run();
        let point = run.is_captured().then(|| run.point());
        let captured = captured(HALF, ITERATES);
        let mut claims: Vec<Claim> = components(19, "fixed point X*", PRINTED, point, 5e-6)
            .into_iter()
            .map(|claim| claim.noted(&captured))
            .collect();
        let printed_sign = feedback(HALF, Sign::Printed);
        let largest = point.and_then(|point| Run::largest_multiplier(&printed_sign, point));
        let ended = Run::new(printed_sign, ITERATES, run.start).label();
        claims.push(
            Claim::new(
                19,
                "Eq. (30) as printed, G (X(n−p) − X(n)), reaches the fixed point",
                "1-2-1",
                format!("{ended}; largest multiplier {:.4}", largest.unwrap_or(f64::NAN)),
                ended == "1-2-1",
            )
            .noted("the opposite sign, G (X(n) − X(n−p)), stabilises and is used everywhere here"),
        );
        Ok(Produced::one(draw(&RESPONSES.map(|plot| (&run, plot)), None, config)?, claims))
    },
};

/// The motion.
pub(in super::super) const FIGURE_20: PaperFigure = PaperFigure {
    number: 20,
    caption: "The motion under delayed feedback, g = 0.5, ω = 2.83: (a) phase portrait, (b) time series.",
    settings: || settings(&[stabilising(HALF)], ITERATES),
    make: |config, _| {
        let run = shown_run();
        let claim = motion(20, "phase portrait under control", "1-2-1", &run);
        let claims = vec![claim.noted(captured(HALF, ITERATES))];
        let picture = draw(&[(&run, PORTRAIT), (&run, TIME)], None, config)?;
        Ok(Produced::one(picture, claims))
    },
};

/// The transitional process with different gains.
pub(in super::super) const FIGURE_21: PaperFigure = PaperFigure {
    number: 21,
    caption: "τ under delayed feedback, ω = 2.83: (a) g = 0.8, (b) g = 0.6, (c) g = 0.3, (d) g = 0.25; control \
              from iterate 2000.",
    settings: || settings(&GAINS.map(stabilising), LONG),
    make: |config, _| {
        // The largest gain captures the fewest starts: the others follow it.
        let first = Run::first(stabilising(GAINS[0]), LONG, STARTS, Run::is_captured);
        let runs: Vec<Run> =
            GAINS.iter().map(|&gain| Run::new(stabilising(gain), LONG, first.start)).collect();
        let time = |gain: f64| Run::new(stabilising(gain), LONG, first.start).time();
        let mut claims: Vec<Claim> = GAINS
            .iter()
            .zip(&runs)
            .map(|(&gain, run)| {
                let claim = motion(21, &format!("motion with g = {gain}"), "1-2-1", run);
                claim.noted(format!(
                    "converged after {} iterates; {}",
                    shown(run.time()),
                    captured(gain, LONG)
                ))
            })
            .collect();
        let effective = EFFECTIVE.map(time);
        let others = GAINS.iter().filter(|gain| !EFFECTIVE.contains(gain)).map(|&gain| time(gain));
        let others: Vec<Option<u32>> = others.collect();
        let slowest = effective.iter().map(|time| time.unwrap_or(u32::MAX)).max();
        let holds = others.iter().all(|time| time.is_none_or(|time| Some(time) > slowest));
        let listed =
            |times: &[Option<u32>]| times.iter().map(|&time| shown(time)).collect::<Vec<_>>().join(", ");
        claims.push(Claim::new(
            21,
            "iterates to convergence: g = 0.3, 0.4, 0.5 against 0.8, 0.6, 0.25",
            "fewer",
            format!("{} against {}", listed(&effective), listed(&others)),
            holds,
        ));
        let plots: Vec<_> = runs.iter().map(|run| (run, TAU)).collect();
        let picture = draw(&plots, Some([FROM - 200, FROM + 1400]), config)?;
        Ok(Produced::one(picture, claims))
    },
};

/// A gain that is too large.
pub(in super::super) const FIGURE_22: PaperFigure = PaperFigure {
    number: 22,
    caption: "Delayed feedback with g = 0.97, ω = 2.83: (a) τ; (b), (c) projected sections of the first \
              iterates under control; (d) phase portrait at the end.",
    settings: || settings(&[stabilising(LARGE)], LONG),
    make: |config, _| {
        let run = Run::first(stabilising(LARGE), LONG, STARTS, Run::is_captured);
        let fixed = shown_run().point();
        let modulus = |gain: f64| Run::largest_multiplier(&stabilising(gain), fixed).unwrap_or(f64::NAN);
        let largest: f64 = LARGEST.parse().expect("a printed number is a number");
        let stable = modulus(largest + 1e-3) < 1.0;
        let claims = vec![
            Claim::new(
                22,
                "the fixed point cannot be reached for g above",
                LARGEST,
                format!("|μ| = {:.4} at g = {LARGE}, {:.4} at g = 1", modulus(LARGE), modulus(1.0)),
                !stable,
            )
            .noted("each multiplier λ of F gives μ² − (λ + g) μ + g = 0, whose roots have the product g: stable up to 1"),
            Claim::new(22, "attractor with g = 0.97", "invariant circle", run.label(), run.label() == "quasi-periodic")
                .noted(format!(
                    "{} of {STARTS} starts are captured, {} run away; the run shown converged after {} iterates: cut \
                     short, its slow spiral looks like a circle",
                    ends(LARGE, LONG, Run::is_captured),
                    ends(LARGE, LONG, |run| run.outcome.runaway),
                    shown(run.time())
                )),
        ];
        let plots = [
            (&run, TAU),
            (&run, Plot::Section([Reading::Tau, Reading::VAfter], 60)),
            (&run, Plot::Section([Reading::X2, Reading::V2], 60)),
            (&run, PORTRAIT),
        ];
        Ok(Produced::one(draw(&plots, None, config)?, claims))
    },
};

/// A gain that is too small.
pub(in super::super) const FIGURE_23: PaperFigure = PaperFigure {
    number: 23,
    caption: "Delayed feedback with g = 0.1, ω = 2.83: (a) τ, (b) phase portrait of the 2-4-2 motion.",
    settings: || settings(&[stabilising(SMALL)], ITERATES),
    make: |config, _| {
        let is_printed = |run: &Run| run.label() == DOUBLED;
        let run = Run::first(stabilising(SMALL), ITERATES, STARTS, is_printed);
        let number = ends(SMALL, ITERATES, is_printed);
        let claims = vec![
            motion(23, "motion with g = 0.1", DOUBLED, &run)
                .noted(format!("{number} of {STARTS} starts end on it")),
        ];
        let picture = draw(&[(&run, TAU), (&run, PORTRAIT)], None, config)?;
        Ok(Produced::one(picture, claims))
    },
};
