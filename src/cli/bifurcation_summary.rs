//! What `impact-atlas bifurcation` prints.

use impact_atlas::analysis::Regime;
use impact_atlas::diagram::{Coexistence, Diagram};
use serde::Serialize;

/// What is printed.
#[derive(Debug, Serialize)]
pub struct Summary<'a> {
    columns: u32,
    branches: Vec<&'static str>,
    points: usize,
    left_out: u64,
    /// Columns whose trajectory was given up.
    failed: usize,
    /// Columns that would begin beyond a stop; only where there are some.
    #[serde(skip_serializing_if = "Option::is_none")]
    inadmissible: Option<usize>,
    seconds: f64,
    /// The ranges in which the branches differ; only where there are two.
    #[serde(skip_serializing_if = "Option::is_none")]
    coexistence: Option<Vec<Coexistence>>,
    backend: &'a str,
    adapter: &'a str,
}

impl<'a> Summary<'a> {
    pub fn new(diagram: &'a Diagram, seconds: f64) -> Self {
        let traces = || diagram.branches.iter().flat_map(|branch| &branch.traces);
        let of = |regime| traces().filter(|trace| trace.verdict.regime == regime).count();
        Summary {
            columns: diagram.spec.x.count,
            branches: diagram.branches.iter().map(|branch| branch.direction.name()).collect(),
            points: traces().map(|trace| trace.readings.len()).sum(),
            left_out: diagram.left_out(),
            failed: of(Regime::Failed),
            inadmissible: Some(of(Regime::Inadmissible)).filter(|&columns| columns > 0),
            seconds,
            coexistence: (diagram.branches.len() == 2).then(|| diagram.coexistence()),
            backend: &diagram.provenance.backend,
            adapter: &diagram.provenance.adapter,
        }
    }

    pub fn text(&self, diagram: &Diagram) -> String {
        let mut lines = vec![format!(
            "{} and {} points in {:.2} s",
            columns(self.columns as usize),
            self.points,
            self.seconds
        )];
        if self.left_out > 0 {
            lines.push(format!("{} points beyond --points were left out", self.left_out));
        }
        if self.failed > 0 {
            lines.push(format!("{} given up: too many impacts in one forcing period", columns(self.failed)));
        }
        if let Some(inadmissible) = self.inadmissible {
            lines.push(format!("{} would begin beyond a stop", columns(inadmissible)));
        }
        let name = diagram.spec.x.quantity.name();
        for range in self.coexistence.iter().flatten() {
            let pairs: Vec<String> = (range.pairs.iter().take(3))
                .map(|pair| match pair.first == pair.second {
                    true => format!("two different {} motions", pair.first),
                    false => format!("{} (down) and {} (up)", pair.first, pair.second),
                })
                .collect();
            lines.push(format!(
                "coexistence for {name} from {:.6} to {:.6} ({}): {}",
                range.from,
                range.until,
                columns(range.columns),
                pairs.join("; ")
            ));
        }
        if self.coexistence.as_ref().is_some_and(Vec::is_empty) {
            lines.push("the two branches agree everywhere".to_owned());
        }
        lines.join("\n")
    }
}

fn columns(count: usize) -> String {
    if count == 1 { "1 column".to_owned() } else { format!("{count} columns") }
}
