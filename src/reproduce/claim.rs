//! What the paper prints, held against what is computed.

use serde::{Deserialize, Serialize};

use crate::system::named;

named! {
    /// Whether a claim of the paper holds.
    #[derive(Deserialize)]
    pub enum Outcome {
        /// It does.
        Agrees = "agrees",
        /// It does not.
        Differs = "differs",
        /// It cannot be checked.
        NotChecked = "not checked",
    }
}

impl Outcome {
    fn of(holds: bool) -> Self {
        if holds { Outcome::Agrees } else { Outcome::Differs }
    }
}

/// A claim of the paper and its check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// Where it is made: "Fig. 7".
    pub figure: String,
    /// What it is about.
    pub claim: String,
    /// What is printed.
    pub printed: String,
    /// What is computed.
    pub computed: String,
    /// Whether the two agree.
    pub verdict: Outcome,
    /// What there is to say about it.
    pub note: String,
}

impl Claim {
    /// A claim that holds or does not.
    pub fn new(
        figure: u32,
        claim: impl Into<String>,
        printed: impl Into<String>,
        computed: impl Into<String>,
        holds: bool,
    ) -> Self {
        Claim {
            figure: format!("Fig. {figure}"),
            claim: claim.into(),
            printed: printed.into(),
            computed: computed.into(),
            verdict: Outcome::of(holds),
            note: String::new(),
        }
    }

    /// A printed number: it agrees if it is the computed one, rounded to its digits, give or take one in the last.
    pub fn number(figure: u32, claim: impl Into<String>, printed: &str, computed: Option<f64>) -> Self {
        let decimals = printed.split_once('.').map_or(0, |(_, digits)| digits.len());
        let value: f64 = printed.parse().expect("a printed number is a number");
        let unit = 10_f64.powi(-(decimals as i32));
        let holds = computed.is_some_and(|computed| (computed - value).abs() <= 1.5 * unit);
        let digits = decimals + 2;
        let text = computed.map_or_else(|| "none".to_owned(), |computed| format!("{computed:.digits$}"));
        Claim::new(figure, claim, printed, text, holds)
    }

    /// A printed number that stands for what the authors' own computation came to: it agrees within `tolerance`, and the
    /// note says how far it is off.
    pub fn within(
        figure: u32,
        claim: impl Into<String>,
        printed: &str,
        computed: Option<f64>,
        tolerance: f64,
    ) -> Self {
        let mut claim = Claim::number(figure, claim, printed, computed);
        let value: f64 = printed.parse().expect("a printed number is a number");
        if let Some(off) = computed.map(|computed| (computed - value).abs()) {
            claim.verdict = Outcome::of(off <= tolerance);
            claim.note = format!("off by {off:.1e}, held to {tolerance:.0e}");
        }
        claim
    }

    /// A claim that cannot be checked, and why.
    pub fn unchecked(
        figure: u32,
        claim: impl Into<String>,
        printed: impl Into<String>,
        why: impl Into<String>,
    ) -> Self {
        let claim = Claim::new(figure, claim, printed, "", false).noted(why);
        Claim { verdict: Outcome::NotChecked, ..claim }
    }

    /// The same claim with a note, after any that it has.
    #[must_use]
    pub fn noted(mut self, note: impl Into<String>) -> Self {
        if !self.note.is_empty() {
            self.note += "; ";
        }
        self.note += &note.into();
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_agree_to_their_printed_digits() {
        let outcome = |printed: &str, computed| Claim::number(7, "x", printed, computed).verdict;
        assert_eq!(outcome("-0.34545790", Some(-0.345457901)), Outcome::Agrees);
        assert_eq!(outcome("3.6907", Some(3.69083)), Outcome::Agrees);
        assert_eq!(outcome("3.6907", Some(3.69089)), Outcome::Differs);
        assert_eq!(outcome("3.6907", None), Outcome::Differs);
        let within = |computed| Claim::within(7, "x", "3.6907", Some(computed), 1e-3).verdict;
        assert_eq!((within(3.6915), within(3.6918)), (Outcome::Agrees, Outcome::Differs));
        assert_eq!(Claim::within(7, "x", "3.6907", None, 1e-3).verdict, Outcome::Differs);
        assert_eq!(Claim::number(7, "x", "3.6907", Some(3.5)).computed, "3.500000");
    }
}
