//! The label N-p-q of a periodic motion that is asked for.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use crate::analysis::{INFINITELY_MANY, Schedule};

/// The label of a periodic motion that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label {
    /// N, forcing periods.
    pub n: u32,
    /// p, impacts at Ā.
    pub p: u32,
    /// q, impacts at A.
    pub q: u32,
}

impl Label {
    /// The most impacts in one period of a motion whose label can be asked for.
    pub const MOST_IMPACTS: u32 = 10_000;
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}-{}", self.n, self.p, self.q)
    }
}

impl FromStr for Label {
    type Err = LabelError;

    fn from_str(text: &str) -> Result<Self, LabelError> {
        let malformed = || LabelError::Malformed(text.to_owned());
        let parts: Vec<&str> = text.split('-').map(str::trim).collect();
        let [n, p, q] = parts[..] else { return Err(malformed()) };
        if [p, q].iter().any(|&part| part == "∞" || part == INFINITELY_MANY.to_string()) {
            return Err(LabelError::Endless(text.to_owned()));
        }
        let number = |part: &str| {
            let digits = !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
            // More digits than fit are a number that is too large all the same.
            if digits { Ok(part.parse().unwrap_or(u32::MAX)) } else { Err(malformed()) }
        };
        let label = Label { n: number(n)?, p: number(p)?, q: number(q)? };
        if !(1..=Schedule::LARGEST_PERIOD).contains(&label.n) {
            return Err(LabelError::Period(text.to_owned()));
        }
        match label.p.saturating_add(label.q) {
            0 => Err(LabelError::NoImpact(text.to_owned())),
            1..=Self::MOST_IMPACTS => Ok(label),
            _ => Err(LabelError::TooMany(text.to_owned())),
        }
    }
}

/// Why a text is not the label of a motion that can be searched for.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LabelError {
    /// Not three numbers.
    #[error(
        "`{0}` is not a label: write N-p-q, for example 1-2-1 for one forcing period with two impacts at x1 = -delta \
         and one at x1 = +delta"
    )]
    Malformed(String),
    /// N is 0 or too large.
    #[error("label `{0}`: N, the forcing periods in one period of the motion, must be 1 to {largest}",
        largest = Schedule::LARGEST_PERIOD)]
    Period(String),
    /// p and q are 0.
    #[error(
        "label `{0}` names a motion without impact, of which there is nothing to solve: give p or q above 0"
    )]
    NoImpact(String),
    /// Complete chatter.
    #[error(
        "label `{0}` has infinitely many impacts (complete chatter): such a motion has no finite impact sequence to \
         search for; leave the label out and give a start that leads to the motion"
    )]
    Endless(String),
    /// More impacts than can be solved for.
    #[error("label `{0}` has too many impacts: at most {most} in one period of the motion are accepted",
        most = Label::MOST_IMPACTS)]
    TooMany(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_round_trip_and_bad_ones_are_named() {
        for label in [Label { n: 1, p: 2, q: 1 }, Label { n: 1024, p: 0, q: 10_000 }] {
            assert_eq!(label.to_string().parse(), Ok(label));
        }
        assert_eq!(" 2 - 4 - 4 ".parse(), Ok(Label { n: 2, p: 4, q: 4 }));
        for text in ["", "1", "1-1", "1-1-1-1", "a-b-c", "1-+1-1", "1--1-1", "1.5-1-1", "-1-1-1"] {
            assert_eq!(text.parse::<Label>(), Err(LabelError::Malformed(text.to_owned())));
        }
        let refused = [
            ("0-1-1", LabelError::Period as fn(String) -> LabelError),
            ("1025-1-1", LabelError::Period),
            ("1-0-0", LabelError::NoImpact),
            ("1-∞-∞", LabelError::Endless),
            ("1-65535-65535", LabelError::Endless),
            ("1-10000-1", LabelError::TooMany),
            ("1-99999999999-99999999999", LabelError::TooMany),
        ];
        for (text, error) in refused {
            assert_eq!(text.parse::<Label>(), Err(error(text.to_owned())));
        }
    }
}
