//! The report of `validate`, as JSON and as text.

use std::fmt::Write;

use impact_atlas::analysis::Regime;
use impact_atlas::model::Number;
use impact_atlas::model::StateVector;
use impact_atlas::plane::Provenance;
use impact_atlas::validate::{Agreement, Boundaries, Check, Share, Spread, Thresholds, WorstCell};
use serde::Serialize;

use super::CliError;
use super::compared::Compared;

/// Everything that `validate` says.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    holds: bool,
    checks: Vec<Check>,
    plane: Compared<'a>,
    reference: &'a Provenance,
    candidate: &'a Provenance,
    /// The regimes in the order of the rows and columns of `confusion`.
    codes: [&'static str; 8],
    #[serde(flatten)]
    agreement: &'a Agreement,
    /// The map's boundaries against the bifurcation curves, where those were asked for.
    boundaries: Option<Boundaries>,
    worst: Vec<Suspect>,
}

/// One of the worst cells, with the command that holds the back ends against each other on it alone.
#[derive(Debug, Serialize)]
struct Suspect {
    x: f64,
    y: f64,
    fault: &'static str,
    reference: String,
    candidate: String,
    difference: Option<f64>,
    reference_state: StateVector,
    candidate_state: StateVector,
    command: String,
}

impl<'a> Report<'a> {
    /// The report on two computations of a plane; `adapter` is how the candidate's adapter was chosen.
    pub fn new(
        plane: Compared<'a>,
        [reference, candidate]: [&'a Provenance; 2],
        agreement: &'a Agreement,
        thresholds: &Thresholds,
        adapter: Option<&str>,
    ) -> Self {
        let [x, y] = plane.axes();
        let chosen = adapter.map(|text| format!(" --adapter {}", quoted(text))).unwrap_or_default();
        let candidate_options = format!("--backend {}{chosen}", candidate.backend);
        let suspect = |cell: &WorstCell| Suspect {
            x: x.value(cell.column),
            y: y.value(cell.row),
            fault: cell.fault.name(),
            reference: cell.reference.label(),
            candidate: cell.candidate.label(),
            difference: cell.difference,
            reference_state: cell.reference.state,
            candidate_state: cell.candidate.state,
            command: plane.command(cell.column, cell.row, &candidate_options),
        };
        Report {
            holds: agreement.holds(thresholds),
            checks: agreement.checks(thresholds),
            plane,
            reference,
            candidate,
            codes: Regime::ALL.map(Regime::name),
            agreement,
            boundaries: None,
            worst: agreement.worst.iter().map(suspect).collect(),
        }
    }

    /// The same report with the map's boundaries held against the bifurcation curves.
    pub fn with_boundaries(mut self, boundaries: Boundaries) -> Self {
        let check = boundaries.check();
        self.holds &= check.holds;
        self.checks.push(check);
        self.boundaries = Some(boundaries);
        self
    }

    /// Success if every check holds, otherwise which do not.
    pub fn verdict(&self) -> Result<(), CliError> {
        if self.holds {
            return Ok(());
        }
        let failing = self.checks.iter().filter(|check| !check.holds).map(|check| {
            let value = check.value.map_or_else(|| "none".to_owned(), figure);
            format!("{} is {value}, {}", check.name, bound(check))
        });
        Err(CliError::CheckFailed(failing.collect::<Vec<_>>().join("; ")))
    }

    /// The report as text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("a string takes everything");
        text.truncate(text.trim_end().len());
        text
    }

    fn write_layers(&self, to: &mut String) -> std::fmt::Result {
        if !self.agreement.layers.is_empty() {
            writeln!(to, "layers, differences in cells of equal regime and label")?;
        }
        for row in &self.agreement.layers {
            let kind = if row.relative { "relative" } else { "absolute" };
            writeln!(
                to,
                "  {:<22} {kind}  {}; defined alike {}",
                row.layer,
                spread(row.difference),
                share(row.defined)
            )?;
        }
        Ok(())
    }

    fn write(&self, to: &mut String) -> std::fmt::Result {
        let agreement = self.agreement;
        let [x, y] = self.plane.axes();
        writeln!(to, "{} cells: {x} by {y}", agreement.cells)?;
        writeln!(to, "reference  {}: {}", self.reference.backend, self.reference.adapter)?;
        writeln!(to, "candidate  {}: {}\n", self.candidate.backend, self.candidate.adapter)?;
        self.write_confusion(to)?;
        self.write_regimes(to)?;
        writeln!(to, "regime and label agree")?;
        writeln!(to, "  inside regions            {}", share(agreement.inside))?;
        writeln!(to, "  on boundaries             {}", share(agreement.boundary))?;
        writeln!(to, "  all non-chaotic cells     {}", share(agreement.non_chaotic))?;
        writeln!(
            to,
            "  {} of the others are decided otherwise by the reference itself within a rounding error: they do not count",
            agreement.tipped.cells
        )?;
        writeln!(to, "symmetry agrees             {}\n", share(agreement.symmetry))?;
        writeln!(to, "end states of equal periodic motions, largest difference of a component")?;
        writeln!(to, "  {}", spread(agreement.end_state))?;
        if let Compared::Free(_) = self.plane {
            let continued = agreement.continued;
            writeln!(to, "  {continued} of them on another branch or phase, continued on the reference")?;
        }
        self.write_layers(to)?;
        let failed = agreement.failed;
        writeln!(to, "failed cells: {} reference, {} candidate\n", failed.reference, failed.candidate)?;
        self.write_worst(to)?;
        self.write_boundaries(to)?;
        self.write_checks(to)
    }

    fn write_boundaries(&self, to: &mut String) -> std::fmt::Result {
        let Some(boundaries) = &self.boundaries else { return Ok(()) };
        writeln!(
            to,
            "bifurcation curves and the map's boundaries: distances in cells, where the map shows the motion"
        )?;
        writeln!(
            to,
            "  {:<40}{:>8}{:>8}{:>9}{:>8}{:>8}",
            "", "places", "shown", "median", "95 %", "largest"
        )?;
        for curve in &boundaries.curves {
            let Some(Spread { cells, median, p95, max }) = curve.distance else { continue };
            let symmetry = if curve.symmetric { "symmetric" } else { "unsymmetric" };
            let name = format!("{} {symmetry}, {}", curve.motion, curve.kind.name());
            writeln!(to, "  {name:<40}{:>8}{cells:>8}{median:>9.2}{p95:>8.2}{max:>8.2}", curve.places)?;
        }
        writeln!(to)
    }

    fn write_confusion(&self, to: &mut String) -> std::fmt::Result {
        let confusion = &self.agreement.confusion;
        let occurs = |code: usize| (0..8).any(|other| confusion[code][other] + confusion[other][code] > 0);
        let codes: Vec<usize> = (0..8).filter(|&code| occurs(code)).collect();
        let heads: String = codes.iter().map(|code| format!("{code:>9}")).collect();
        writeln!(to, "cells by regime: rows are the reference, columns the candidate")?;
        writeln!(to, "  {:<26}{heads}", "")?;
        for &row in &codes {
            let cells: String =
                codes.iter().map(|&column| format!("{:>9}", confusion[row][column])).collect();
            writeln!(to, "  {row} {:<24}{cells}", self.codes[row])?;
        }
        writeln!(to)
    }

    fn write_regimes(&self, to: &mut String) -> std::fmt::Result {
        for regime in &self.agreement.regimes {
            writeln!(to, "{}", regime.regime)?;
            writeln!(to, "  inside regions            {}", share(regime.inside))?;
            writeln!(to, "  on boundaries             {}", share(regime.boundary))?;
            if regime.end_state.is_some() {
                writeln!(to, "  end states                {}", spread(regime.end_state))?;
            }
            writeln!(to, "  Lyapunov exponents        {}", spread(regime.lyapunov))?;
        }
        writeln!(to)
    }

    fn write_worst(&self, to: &mut String) -> std::fmt::Result {
        let [x, y] = self.plane.axes().map(|axis| axis.quantity.name());
        for cell in &self.worst {
            let difference = cell.difference.map(|d| format!(", difference {d:.1e}")).unwrap_or_default();
            writeln!(
                to,
                "{x} = {}, {y} = {}: {} ({}, reference {}{difference})",
                Number(cell.x),
                Number(cell.y),
                cell.fault,
                cell.candidate,
                cell.reference
            )?;
            writeln!(to, "  {}", cell.command)?;
        }
        if self.worst.is_empty() { Ok(()) } else { writeln!(to) }
    }

    fn write_checks(&self, to: &mut String) -> std::fmt::Result {
        for check in &self.checks {
            let value = check.value.map_or_else(|| "no such cell".to_owned(), figure);
            let holds = if check.holds { "holds" } else { "DOES NOT HOLD" };
            writeln!(to, "{:<32} {value:>12}  {:<18} {holds}", check.name, bound(check))?;
        }
        Ok(())
    }
}

fn figure(value: f64) -> String {
    if value >= 2.0 && value.fract() == 0.0 {
        return format!("{value:.0}");
    }
    if value == 0.0 || value.abs() >= 1e-3 { format!("{value:.5}") } else { format!("{value:.2e}") }
}

fn bound(check: &Check) -> String {
    format!("{} {}", if check.at_least { "at least" } else { "at most" }, check.bound)
}

fn share(share: Share) -> String {
    match share.value() {
        Some(value) => format!("{value:.5}  ({} of {})", share.agree, share.cells),
        None => "no such cell".to_owned(),
    }
}

fn spread(spread: Option<Spread>) -> String {
    match spread {
        Some(Spread { cells, median, p95, max }) => {
            format!("median {median:.1e}, 95 % {p95:.1e}, largest {max:.1e}  ({cells} cells)")
        }
        None => "no such cell".to_owned(),
    }
}

/// A word for the shell.
fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
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
        let plane = Plane {
            x: "x1=-0.05:0.05:5".parse().unwrap(),
            y: "r=0.5:0.75:4".parse().unwrap(),
            parameters: Parameters { zeta: 0.025, ..Parameters::default() }.into(),
            start: Start::State([0.0, 0.5, -0.25, 1e-7].into()),
            schedule: Schedule { transient: 40, observe: 20, max_period: 8, fixed_periods: true },
        };
        RegionMap { plane, provenance, verdicts: vec![verdict(1); 20], multipliers: None, extents: None }
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
}
