//! The report: every claim in one table, the pictures with their captions.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::claim::{Claim, Outcome};

/// A figure that was made, as its file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finished {
    /// Its number.
    pub figure: u32,
    /// What it shows.
    pub caption: String,
    /// What it was made with.
    pub config: Value,
    /// The names of its pictures.
    pub pictures: Vec<String>,
    /// What was checked.
    pub claims: Vec<Claim>,
}

/// The report in Markdown.
pub fn markdown(figures: &[Finished]) -> String {
    let claims = || figures.iter().flat_map(|figure| &figure.claims);
    let count = |outcome: Outcome| claims().filter(|claim| claim.verdict == outcome).count();
    let mut lines = vec![
        "# The paper, computed again".to_owned(),
        String::new(),
        "G. W. Luo, L. Ma, X. H. Lv, *Dynamic analysis and suppressing chaotic impacts of a two-degree-of-freedom \
         oscillator with a clearance*, Nonlinear Analysis: Real World Applications (2009). Everything is \
         non-dimensional; N-p-q: N forcing periods, p impacts at x1 = −δ, q at x1 = +δ."
            .to_owned(),
        String::new(),
        format!(
            "{} claims: {} agree, {} differ, {} cannot be checked.",
            claims().count(),
            count(Outcome::Agrees),
            count(Outcome::Differs),
            count(Outcome::NotChecked)
        ),
        String::new(),
        "| figure | claim | printed | computed | verdict | note |".to_owned(),
        "|---|---|---|---|---|---|".to_owned(),
    ];
    lines.extend(claims().map(|claim| {
        let cells =
            [&claim.figure, &claim.claim, &claim.printed, &claim.computed, claim.verdict.name(), &claim.note]
                .map(escaped);
        format!("| {} |", cells.join(" | "))
    }));
    for figure in figures {
        lines.push(String::new());
        lines.push(format!("## Fig. {}", figure.figure));
        for picture in &figure.pictures {
            lines.push(String::new());
            lines.push(format!("![Fig. {}]({picture})", figure.figure));
        }
        lines.push(String::new());
        lines.push(figure.caption.clone());
    }
    lines.push(String::new());
    lines.join("\n")
}

/// A bar would end the cell.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_claim_has_its_row() {
        let claims = vec![
            Claim::new(7, "motion", "1-1-1", "1-1-1", true),
            Claim::number(7, "|v|", "0.5", Some(0.9)).noted("why"),
            Claim::unchecked(7, "x", "1", "not legible"),
        ];
        let finished = Finished {
            figure: 7,
            caption: "A caption.".into(),
            config: Value::Null,
            pictures: vec!["fig07.png".into()],
            claims,
        };
        let text = markdown(&[finished]);
        assert!(text.contains("3 claims: 1 agree, 1 differ, 1 cannot be checked."), "{text}");
        assert!(text.contains(r"| Fig. 7 | \|v\| | 0.5 | 0.900 | differs | why |"), "{text}");
        assert!(text.contains("![Fig. 7](fig07.png)") && text.contains("A caption."), "{text}");
    }
}
