//! Random plants against the oracle.

use impact_atlas::model::Real;
use rayon::prelude::*;

use crate::common::general::conditioning::{Case, Horizon, cases, deviation};
use crate::general::subject::{Period, follow};

/// The precision that is compared, and what it is held to.
struct Standard {
    horizon: fn(&Case) -> &Horizon,
    tolerance: f64,
    /// The largest error of a release, in units of time.
    release: f64,
    penetration: f64,
}

const FINE: Standard =
    Standard { horizon: |case| &case.fine, tolerance: 1e-9, release: 1e-5, penetration: 1e-12 };
const COARSE: Standard =
    Standard { horizon: |case| &case.coarse, tolerance: 1e-4, release: 5e-2, penetration: 1e-5 };

/// What is allowed once rebounds without loss were closed: they are slower than 1e-6 then, but not gone.
const DRAGGED: f64 = 2e-5;

/// A case with what the library made of it.
struct Compared {
    case: &'static Case,
    index: usize,
    periods: Vec<Period>,
}

fn compared<T: Real>(standard: &Standard) -> Vec<Compared> {
    let follow = |(index, case): (usize, &'static Case)| {
        let periods = (standard.horizon)(case).periods;
        Compared { case, index, periods: follow::<T>(&case.setup.plant, &case.setup.start, periods) }
    };
    cases().par_iter().enumerate().map(follow).collect()
}

fn report(what: &str, offences: &[String]) {
    let shown = offences[..offences.len().min(6)].join("\n");
    assert!(offences.is_empty(), "{what} in {} cases:\n{shown}", offences.len());
}

fn agree<T: Real>(standard: &Standard) {
    let mut wrong = Vec::new();
    let (mut states, mut counts, mut impacts, mut releases) = (0, 0, 0, 0);
    for Compared { case, index, periods } in compared::<T>(standard) {
        let Horizon { periods: horizon, countable } = (standard.horizon)(case);
        let horizon = *horizon;
        let describe = |what: String| format!("case {index}: {what}\n  {:?}", case.setup);
        if periods.len() < horizon {
            wrong.push(describe(format!("only {} of {horizon} periods", periods.len())));
            continue;
        }
        let mut offence = None;
        for (k, (period, exact)) in periods.iter().zip(&case.truth).enumerate() {
            states += 1;
            let off = deviation(&period.strobe, &exact.strobe);
            let tolerance = if period.dragged { DRAGGED } else { standard.tolerance };
            if off > tolerance.max(standard.tolerance) {
                offence = Some(format!("off by {off:e} after {} periods of {horizon}", k + 1));
            } else if period.penetration > standard.penetration {
                offence = Some(format!("{:e} beyond a stop in period {k}", period.penetration));
            } else if countable[k] {
                counts += 1;
                impacts += exact.impacts.iter().sum::<u32>();
                releases += exact.releases.len();
                if period.impacts != exact.impacts {
                    offence =
                        Some(format!("period {k}: impacts {:?}, not {:?}", period.impacts, exact.impacts));
                } else if !same_releases(period, exact, standard.release) {
                    offence =
                        Some(format!("period {k}: left {:?}, not {:?}", period.releases, exact.releases));
                }
            } else if exact.chatters
                && !exact.coincides
                && !last_releases_agree(period, exact, standard.release)
            {
                offence = Some(format!("period {k}: left {:?}, not {:?}", period.releases, exact.releases));
            }
            if offence.is_some() {
                break;
            }
        }
        wrong.extend(offence.map(describe));
    }
    let chatter = cases().iter().flat_map(|case| &case.truth).filter(|period| period.chatters).count();
    println!(
        "{} cases: {states} states, {counts} counts of {impacts} impacts, {releases} releases, {chatter} chatters",
        cases().len()
    );
    assert!(states > 2000 && impacts > 2000 && chatter > 200);
    report("disagreement", &wrong);
}

/// Whether the same stops were left at the same times; what is left within the tolerance of the end counts for neither.
fn same_releases(period: &Period, exact: &crate::common::general::Period, tolerance: f64) -> bool {
    period.releases.len() == exact.releases.len()
        && period
            .releases
            .iter()
            .zip(&exact.releases)
            .all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= tolerance)
}

/// Whether the last stop was left at the same time: rebounds may be followed differently before it.
fn last_releases_agree(period: &Period, exact: &crate::common::general::Period, tolerance: f64) -> bool {
    match (period.releases.last(), exact.releases.last()) {
        (Some(a), Some(b)) => a.0 == b.0 && (a.1 - b.1).abs() <= tolerance,
        _ => true,
    }
}

#[test]
fn random_plants_in_f64() {
    agree::<f64>(&FINE);
}

#[test]
fn random_plants_in_f32() {
    agree::<f32>(&COARSE);
}

#[test]
fn a_wrong_restitution_is_noticed() {
    let mut impacting = 0;
    let mut noticed = 0;
    for case in cases().iter().step_by(4) {
        let horizon = case.fine.periods;
        let struck = case.truth[..horizon].iter().any(|period| period.impacts.iter().sum::<u32>() > 0);
        let Some(exact) = case.truth[..horizon].last().filter(|_| struck) else { continue };
        impacting += 1;
        let mut plant = case.setup.plant.clone();
        for stop in &mut plant.stops {
            stop.restitution += if stop.restitution < 0.5 { 1e-6 } else { -1e-6 };
        }
        let periods = follow::<f64>(&plant, &case.setup.start, horizon);
        let last = periods.last().expect("the first period is followed");
        noticed += usize::from(deviation(&last.strobe, &exact.strobe) > FINE.tolerance);
    }
    println!("{noticed} of {impacting} noticed");
    assert!(2 * noticed > impacting && impacting > 30);
}
