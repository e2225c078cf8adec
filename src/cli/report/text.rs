//! The report as text.

use std::fmt::Write;

use impact_atlas::model::Number;
use impact_atlas::validate::{Share, Spread};

use super::Report;
use super::figures::{bound, figure};
use crate::cli::compared::Compared;

impl Report<'_> {
    /// The report as text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("a string takes everything");
        text.truncate(text.trim_end().len());
        text
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

    fn write_confusion(&self, to: &mut String) -> std::fmt::Result {
        let confusion = &self.agreement.confusion;
        let all = 0..confusion.len();
        let occurs = |code: &usize| all.clone().any(|o| confusion[*code][o] + confusion[o][*code] > 0);
        let codes: Vec<usize> = all.clone().filter(occurs).collect();
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

    fn write_checks(&self, to: &mut String) -> std::fmt::Result {
        for check in &self.checks {
            let value = check.value.map_or_else(|| "no such cell".to_owned(), figure);
            let holds = if check.holds { "holds" } else { "DOES NOT HOLD" };
            writeln!(to, "{:<32} {value:>12}  {:<18} {holds}", check.name, bound(check))?;
        }
        Ok(())
    }
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
