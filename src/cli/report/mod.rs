//! The report of `validate`, as JSON and as text.

mod figures;
#[cfg(test)]
mod tests;
mod text;

use impact_atlas::analysis::Regime;
use impact_atlas::plane::Provenance;
use impact_atlas::validate::{Agreement, Boundaries, Check, Thresholds, WorstCell};
use serde::Serialize;

use self::figures::{bound, figure};
use super::compared::Compared;
use super::{CliError, Result};

/// Everything that `validate` says.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    holds: bool,
    checks: Vec<Check>,
    plane: Compared<'a>,
    reference: &'a Provenance,
    candidate: &'a Provenance,
    /// The regimes in the order of the rows and columns of `confusion`.
    codes: [&'static str; Regime::ALL.len()],
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
    reference_state: Vec<f64>,
    candidate_state: Vec<f64>,
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
            reference_state: cell.places[0].clone(),
            candidate_state: cell.places[1].clone(),
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
    pub fn verdict(&self) -> Result<()> {
        if self.holds {
            return Ok(());
        }
        let failing = self.checks.iter().filter(|check| !check.holds).map(|check| {
            let value = check.value.map_or_else(|| "none".to_owned(), figure);
            format!("{} is {value}, {}", check.name, bound(check))
        });
        Err(CliError::CheckFailed(failing.collect::<Vec<_>>().join("; ")))
    }
}

/// A text in quotes, as one argument on a command line.
fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', r"'\''"))
}
