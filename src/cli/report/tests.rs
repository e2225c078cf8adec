//! What the report of two computations says.

use clap::Parser;
use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::model::Parameters;
use impact_atlas::plane::{Plane, RegionMap, Start};
use impact_atlas::validate::compare;

use super::*;
use crate::cli::Cli;

fn verdict(n: u16) -> Verdict {
    Verdict {
        regime: Regime::Periodic,
        n,
        counts: impact_atlas::analysis::Counts::new(&[n, n]),
        symmetric: true,
        lyapunov: -0.25,
        state: [0.05, -0.01, 0.3, 0.02].into(),
        impacts: 400,
        impacts_total: 1200,
        peak_impact_velocity: 0.4,
        periods: 600,
        returning: 0,
        measures: impact_atlas::analysis::Measures::default(),
    }
}

fn map(backend: &str) -> RegionMap {
    let provenance =
        Provenance { version: "1".to_owned(), backend: backend.to_owned(), adapter: "some".to_owned() };
    let schedule = Schedule { transient: 40, observe: 20, max_period: 8, fixed_periods: true };
    let start = Start::State([0.0, 0.5, -0.25, 1e-7].into());
    let mut plane = Plane::of_paper("x1=-0.05:0.05:5", "r=0.5:0.75:4", start, schedule).unwrap();
    plane.parameters = Parameters { zeta: 0.025, ..Parameters::default() }.into();
    RegionMap::new(plane, provenance, vec![verdict(1); 20])
}

fn report<'a>(
    ours: &'a RegionMap,
    theirs: &'a RegionMap,
    agreement: &'a Agreement,
    adapter: Option<&str>,
) -> Report<'a> {
    let made = [&ours.provenance, &theirs.provenance];
    Report::new(Compared::Free(&ours.plane), made, agreement, &Thresholds::default(), adapter)
}

#[test]
fn agreement_is_success() {
    let (ours, theirs) = (map("cpu"), map("gpu"));
    let agreement = compare(&ours, &theirs);
    let report = report(&ours, &theirs, &agreement, None);
    assert!(report.verdict().is_ok());
    assert!(!report.text().contains("DOES NOT HOLD"));
}

#[test]
fn a_failure_names_the_threshold_and_gives_commands_that_reproduce_it() {
    let (ours, mut theirs) = (map("cpu"), map("gpu"));
    theirs.verdicts[15] = verdict(2);
    let agreement = compare(&ours, &theirs);
    let report = report(&ours, &theirs, &agreement, Some("it's"));

    let error = report.verdict().unwrap_err();
    assert!(matches!(error, CliError::CheckFailed(_)));
    let message = error.to_string();
    assert!(message.contains("agreement inside regions is 0.95000, at least 0.995"), "{message}");

    let text = report.text();
    let expected = "impact-atlas validate --x x1=-0.05:-0.05:1 --y r=0.75:0.75:1 --set zeta=0.025 \
                    --start=0,0.5,-0.25,1e-7 --transient 40 --observe 20 --max-period 8 --fixed-periods \
                    --backend gpu";
    assert!(text.contains(&format!(r"{expected} --adapter 'it'\''s'")), "{text}");
    Cli::try_parse_from(expected.split_whitespace()).unwrap();

    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["holds"], false);
    assert_eq!((&json["worst"][0]["x"], &json["worst"][0]["y"]), (&(-0.05).into(), &0.75.into()));
    assert_eq!(json["worst"][0]["candidate"], "2-2-2");
    assert_eq!(json["confusion"][2][2], 20);
}
