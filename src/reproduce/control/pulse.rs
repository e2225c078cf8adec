//! Figs. 17 and 18: period pulses.

use super::super::{Claim, PaperFigure, Produced};
use super::{FROM, PORTRAIT, RESPONSES, Run, TARGET, TIME, components, draw, settings};
use crate::control::Scheme;
use crate::control::methods::PulseSetting;
use crate::dynamics::Stop;
use crate::plane::Start;

const ITERATES: u32 = 4000;
const PULSE: Scheme =
    Scheme::Pulse(PulseSetting { stop: Stop::A, period: 1, target: TARGET, noise: 0.0, seed: 1 });
/// X0 as printed, the sign of the first taken from the section, which has x1'+ ≤ 0.
const PRINTED: [&str; 4] = ["-0.34545790", "-0.00634090", "0.02116031", "1.80213070"];

fn run() -> Run {
    Run::new(PULSE, ITERATES, Start::Rest)
}

/// Time responses.
pub(in super::super) const FIGURE_17: PaperFigure = PaperFigure {
    number: 17,
    caption: "Time responses under the period pulse, P = 1, E = 0, ω = 2.83: (a) length of the pulse, (b) τ, \
              (c) x1'+, (d) x2, (e) x2'; control from iterate 2000.",
    settings: || settings(&[PULSE], ITERATES),
    make: |config, _| {
        let run = run();
        let last = run.history.returns.last();
        let scatter = run.history.returns[FROM as usize..]
            .iter()
            .zip(last.into_iter().cycle())
            .map(|(met, last)| met.section.distance(&last.section, 1.0))
            .fold(0.0, f64::max);
        let mut claims = components(17, "point held by the pulses, X0", PRINTED, Some(run.point()), 5e-6);
        claims.push(
            Claim::new(17, "scatter of the points under control", "0", format!("{scatter:.1e}"), scatter < 1e-12)
                .noted(format!(
                    "the pulse itself does not vanish, since X0 is no fixed point at ω = 2.83: its length is {:.4}",
                    run.outcome.signal
                )),
        );
        let picture = draw(&RESPONSES.map(|plot| (&run, plot)), Some([FROM - 100, FROM + 100]), config)?;
        Ok(Produced::one(picture, claims))
    },
};

/// The motion.
pub(in super::super) const FIGURE_18: PaperFigure = PaperFigure {
    number: 18,
    caption: "The motion under the period pulse, ω = 2.83: (a) phase portrait, (b) time series.",
    settings: || settings(&[PULSE], ITERATES),
    make: |config, _| {
        let run = run();
        let periodic = run.outcome.period == 1;
        let claims = vec![
            Claim::new(18, "motion under control", "periodic", run.label(), periodic)
                .noted("with a jump in phase at each pulse, so that N counts flight time, rounded"),
        ];
        let picture = draw(&[(&run, PORTRAIT), (&run, TIME)], None, config)?;
        Ok(Produced::one(picture, claims))
    },
};
