//! Figs. 15 and 16: the adapted sine force.

use rayon::prelude::*;

use super::super::{Claim, PaperFigure, Produced};
use super::{PORTRAIT, RESPONSES, Run, STARTS, TARGET, TIME, components, draw, motion, settings, system};
use crate::control::Scheme;
use crate::control::methods::{Convention, SineSetting};
use crate::dynamics::Stop;

const ITERATES: u32 = 6000;
/// Iterates after which captures are counted again: what is not captured yet may still be.
const LONGER: u32 = 24_000;
const PRINTED: [&str; 4] = ["-0.419595312", "-0.02899704", "0.02903741", "1.80213090"];
const AMPLITUDE: &str = "0.152618";
/// Starts that adaptation is tried from.
const TRIED: u32 = STARTS / 2;

const fn scheme(convention: Convention, alpha: f64, dead_band: f64) -> SineSetting {
    SineSetting {
        stop: Stop::A,
        convention,
        coordinate: 0,
        amplitude: 0.0,
        alpha,
        dead_band,
        gamma: 1.0,
        phase: 0.0,
        component: 3,
        target: TARGET,
    }
}

const KICK: SineSetting = scheme(Convention::Kick, 0.1, 0.0055);
const FORCE: SineSetting = scheme(Convention::Force, 0.05, 1e-4);

fn captured() -> Run {
    Run::first(Scheme::Sine(KICK), ITERATES, TRIED, Run::is_captured)
}

/// The amplitudes at which adaptation has come to rest after so many iterates, for every start that is captured then.
fn amplitudes(iterates: u32) -> Vec<f64> {
    (0..TRIED)
        .into_par_iter()
        .map(|number| Run::new(Scheme::Sine(KICK), iterates, super::start(number)))
        .filter(Run::is_captured)
        .map(|run| f64::from(run.outcome.signal))
        .collect()
}

/// The amplitudes of a kick for which a fixed point is stable, on either side of a stable one, to 1e-4.
fn stable_amplitudes(point: [f64; 4], inside: f64) -> Option<[f64; 2]> {
    let stable = |amplitude: f64| {
        let held = SineSetting { amplitude, alpha: 0.0, ..KICK };
        Run::largest_multiplier(&Scheme::Sine(held), point).is_some_and(|largest| largest < 1.0)
    };
    let edge = |mut outside: f64| {
        let mut inside = inside;
        while (outside - inside).abs() > 1e-4 {
            let middle = 0.5 * (outside + inside);
            if stable(middle) { inside = middle } else { outside = middle }
        }
        inside
    };
    (stable(inside) && !stable(0.0) && !stable(1.0)).then(|| [edge(0.0), edge(1.0)])
}

/// Time responses.
pub(in super::super) const FIGURE_15: PaperFigure = PaperFigure {
    number: 15,
    caption: "Time responses under the adapted sine force (as a kick at each return to the section), ω = 2.83: \
              (a) amplitude B, (b) τ, (c) x1'+, (d) x2, (e) x2'; control from iterate 2000.",
    settings: || settings(&[Scheme::Sine(KICK), Scheme::Sine(FORCE)], ITERATES),
    make: |config, _| {
        let run = captured();
        let held = run.is_captured();
        let point = held.then(|| run.point());
        let [amplitudes, longer] = [ITERATES, LONGER].map(amplitudes);
        let [least, most] = longer
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &b| [low.min(b), high.max(b)]);
        let printed_amplitude: f64 = AMPLITUDE.parse().expect("a printed number is a number");
        let stable = point.and_then(|point| stable_amplitudes(point, printed_amplitude));
        let range = stable.map_or_else(|| "none".to_owned(), |[low, high]| format!("{low:.4} to {high:.4}"));
        let mut claims = vec![
            motion(15, "motion under control", "1-2-1", &run).noted(format!(
                "the fixed point is that of the uncontrolled map, where the kick vanishes; of {TRIED} starts {} \
                 are captured within {ITERATES} iterates, {} within {LONGER}",
                amplitudes.len(),
                longer.len()
            )),
            Claim::number(15, "B*, where the amplitude comes to rest", AMPLITUDE, held.then(|| run.outcome.signal.into()))
                .noted(format!(
                    "it depends on the start: {least:.4} to {most:.4} over those captured within {LONGER} iterates; the motion is stable for any \
                     constant B from {range}"
                )),
            Claim::new(
                15,
                "B* holds the motion",
                AMPLITUDE,
                format!("stable for B from {range}"),
                stable.is_some_and(|[low, high]| (low..high).contains(&printed_amplitude)),
            ),
        ];
        claims.extend(components(15, "end state X*", PRINTED, point, 5e-6));
        let controller = Scheme::Sine(KICK).resolve(&system()).ok();
        if let (Some(point), Some(crate::control::Controller::Sine(sine))) = (point, controller) {
            let away = (point[3] - sine.target).abs();
            claims.push(Claim::new(15, "τ tends to τ0", "0", format!("{away:.6}"), away < 1e-6).noted(
                "the distance of the fixed point's τ from that of the target; it lies within the dead band",
            ));
        }
        let forced = Run::first(Scheme::Sine(FORCE), ITERATES, TRIED, |run| run.outcome.period == 1);
        claims.push(
            Claim::new(
                15,
                "the same with a force on M1 between impacts, u = B sin(ωt + τ)",
                format!("B* = {AMPLITUDE}, 1-2-1"),
                format!("B* = {:.6}, {}", forced.outcome.signal, forced.label()),
                forced.label() == "1-2-1",
            )
            .noted("another reading of Eq. (21), whose convention is not printed"),
        );
        Ok(Produced::one(draw(&RESPONSES.map(|plot| (&run, plot)), None, config)?, claims))
    },
};

/// The motion.
pub(in super::super) const FIGURE_16: PaperFigure = PaperFigure {
    number: 16,
    caption: "The motion under the adapted sine force, ω = 2.83: (a) phase portrait, (b) time series.",
    settings: || settings(&[Scheme::Sine(KICK)], ITERATES),
    make: |config, _| {
        let run = captured();
        let claims = vec![motion(16, "phase portrait under control", "1-2-1", &run)];
        let picture = draw(&[(&run, PORTRAIT), (&run, TIME)], None, config)?;
        Ok(Produced::one(picture, claims))
    },
};
