//! What the cases cover, and for how long they can be compared.

use crate::common::cases::{Family, setups};
use crate::common::conditioning::{Case, cases};

/// Cases per length of a horizon, for the record.
fn report(name: &str, cases: &[Case], length: impl Fn(&Case) -> usize) {
    let edges = [0, 1, 3, 5, 10, 20, 40, usize::MAX];
    let among = |low, high| cases.iter().filter(|case| (low..high).contains(&length(case))).count();
    let table = edges.windows(2).map(|pair| format!("{}+: {}", pair[0], among(pair[0], pair[1])));
    println!("{name}, cases per horizon in periods: {}", table.collect::<Vec<_>>().join(", "));
}

#[test]
fn the_cases_cover_every_family_and_most_can_be_compared_for_long() {
    let cases = cases();
    report("f64 states", cases, |case| case.fine.periods);
    report("f64 impacts", cases, |case| case.fine.countable);
    report("f32 states", cases, |case| case.coarse.periods);
    report("f32 impacts", cases, |case| case.coarse.countable);
    let share =
        |is: &dyn Fn(&Case) -> bool| cases.iter().filter(|case| is(case)).count() as f64 / cases.len() as f64;
    assert!(cases.len() >= setups().len() - 5, "{} of {} can be followed", cases.len(), setups().len());
    assert!(share(&|case| case.fine.periods >= 20) > 0.8);
    assert!(share(&|case| case.coarse.periods >= 20) > 0.5);
    assert!(share(&|case| case.fine.countable >= 10) > 0.35);
}

#[test]
fn the_special_families_are_what_they_claim() {
    let cases = cases();
    let of = |family: Family| cases.iter().filter(move |case| case.family == family);
    let chatters = |case: &&Case| case.truth.iter().any(|period| period.chatters != [0, 0]);
    let releases =
        |case: &&Case| case.truth.iter().flat_map(|p| &p.sticks).any(|stick| stick.until.is_some());
    assert!(of(Family::Chatter).filter(chatters).filter(releases).count() >= 60);
    let slowest = |case: &&Case| {
        let speeds =
            case.truth[..3].iter().flat_map(|p| &p.impacts).map(|impact| impact.velocity_before.abs());
        speeds.fold(f64::INFINITY, f64::min)
    };
    assert!(of(Family::Grazing).filter(|case| slowest(case) < 0.1).count() >= 10);
    assert!(
        of(Family::OnStop).filter(|case| case.truth[0].sticks.first().is_some_and(|s| s.from == 0.0)).count()
            >= 5
    );
}
