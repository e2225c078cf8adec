//! The label of a periodic motion that is asked for: N-p-q of the paper's oscillator.

use std::fmt;
use std::str::FromStr;

use derive_more::Display;
use thiserror::Error;

use crate::analysis::{INFINITELY_MANY, Schedule};
use crate::model::vector::MOST;
use crate::system::Family;

/// The label of a periodic motion that is asked for.
#[derive(Clone, Debug, PartialEq, Eq, Display)]
#[display("{}", spelled(n, impacts))]
pub struct Label {
    /// N, forcing periods.
    pub n: u32,
    /// Impacts at each stop, in the order of labels: p at Ā and q at A of the paper's oscillator.
    pub impacts: Vec<u32>,
}

impl Label {
    /// The most impacts in one period of a motion whose label can be asked for.
    pub const MOST_IMPACTS: u32 = 10_000;

    /// The label of N and the impacts at each stop.
    pub fn new(n: u32, impacts: &[u32]) -> Self {
        Label { n, impacts: impacts.to_vec() }
    }

    /// Impacts in one period of the motion.
    pub fn count(&self) -> u32 {
        self.impacts.iter().fold(0, |sum, &count| sum.saturating_add(count))
    }

    /// Reads the label of a motion of a system with so many stops: N and a number for each of them.
    ///
    /// # Errors
    /// [`LabelError`] with the text and what is wrong with it.
    pub fn read(text: &str, stops: usize) -> Result<Self, LabelError> {
        let malformed = || match stops {
            2 => LabelError::Malformed(text.to_owned()),
            _ => LabelError::Numbers { text: text.to_owned(), stops },
        };
        let parts: Vec<&str> = text.split('-').map(str::trim).collect();
        if parts.len() != stops + 1 {
            return Err(malformed());
        }
        if parts[1..].iter().any(|&part| part == "∞" || part == INFINITELY_MANY.to_string()) {
            return Err(LabelError::Endless(text.to_owned()));
        }
        let number = |part: &&str| {
            let digits = !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
            // More digits than fit are a number that is too large all the same.
            if digits { Ok(part.parse().unwrap_or(u32::MAX)) } else { Err(malformed()) }
        };
        let numbers = parts.iter().map(number).collect::<Result<Vec<u32>, LabelError>>()?;
        let label = Label::new(numbers[0], &numbers[1..]);
        if !(1..=Schedule::LARGEST_PERIOD).contains(&label.n) {
            return Err(LabelError::Period(text.to_owned()));
        }
        match label.count() {
            0 => Err(LabelError::NoImpact(text.to_owned())),
            1..=Self::MOST_IMPACTS => Ok(label),
            _ => Err(LabelError::TooMany(text.to_owned())),
        }
    }
}

/// The letters of the counts, in the order of labels.
const COUNTS: [char; MOST] = ['p', 'q', 's', 'u'];

impl Label {
    /// Reads the label of a motion of a family: N and the impacts at each of its stops.
    ///
    /// # Errors
    /// [`LabelError`] with the text and what is wrong with it.
    pub fn of_family(text: &str, family: &Family) -> Result<Self, LabelError> {
        let order = family.label_order();
        Label::read(text, order.len()).map_err(|error| match error {
            LabelError::Malformed(text) | LabelError::Numbers { text, .. } => {
                let counted = order.iter().zip(COUNTS).map(|(&stop, letter)| {
                    let name = family.stops()[stop].plain_name();
                    format!("{letter} impacts at stop {name}, {}", family.stop_place(stop))
                });
                let counted = counted.collect::<Vec<_>>().join("; ");
                LabelError::OfFamily { text, form: Label::form(order.len()), counted }
            }
            error => error,
        })
    }

    /// How labels of motions between so many stops are written: N-p-q.
    pub fn form(stops: usize) -> String {
        spelled("N", &COUNTS[..stops])
    }
}

/// N and the impacts at each stop, in the order of labels, as text.
pub(super) fn spelled<T: fmt::Display>(n: impl fmt::Display, impacts: impl IntoIterator<Item = T>) -> String {
    impacts.into_iter().fold(n.to_string(), |text, count| format!("{text}-{count}"))
}

/// As [`Label::read`] for two stops.
impl FromStr for Label {
    type Err = LabelError;

    fn from_str(text: &str) -> Result<Self, LabelError> {
        Label::read(text, 2)
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
    /// Not N and one number for each stop.
    #[error(
        "`{text}` is not a label here: write N and the impacts at each stop, {} numbers with - between them, for \
         example 1{} for one forcing period with one impact at each",
        stops + 1, "-1".repeat(*stops)
    )]
    Numbers {
        /// The text.
        text: String,
        /// How many stops the system has.
        stops: usize,
    },
    /// The same of a family.
    #[error("`{text}` is not a label here: write {form} for N forcing periods with {counted}")]
    OfFamily {
        /// The text.
        text: String,
        /// How labels are written.
        form: String,
        /// What is counted where.
        counted: String,
    },
    /// N is 0 or too large.
    #[error("label `{0}`: N, the forcing periods in one period of the motion, must be 1 to {largest}",
        largest = Schedule::LARGEST_PERIOD)]
    Period(String),
    /// There is no impact.
    #[error(
        "label `{0}` names a motion without impact, of which there is nothing to solve: give one of the counts above 0"
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
        for label in [Label::new(1, &[2, 1]), Label::new(1024, &[0, 10_000])] {
            assert_eq!(label.to_string().parse(), Ok(label));
        }
        assert_eq!(" 2 - 4 - 4 ".parse(), Ok(Label::new(2, &[4, 4])));
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

    #[test]
    fn labels_have_a_number_for_each_stop() {
        assert_eq!(Label::read("3-2", 1), Ok(Label::new(3, &[2])));
        let four = Label::read("1-2-0-1-5", 4).unwrap();
        assert_eq!((four.count(), four.to_string().as_str()), (8, "1-2-0-1-5"));
        let error = Label::read("1-1-1", 3).unwrap_err().to_string();
        assert!(
            error.contains("`1-1-1`") && error.contains("4 numbers") && error.contains("1-1-1-1"),
            "{error}"
        );
        assert_eq!(Label::read("1-0", 1), Err(LabelError::NoImpact("1-0".to_owned())));
        let error = Label::of_family("1-1", Family::paper()).unwrap_err().to_string();
        assert!(
            error.contains("write N-p-q") && error.contains("p impacts at stop B, x1 = -delta"),
            "{error}"
        );
        let error = Label::of_family("1-1-1", Family::builtin("shaw-holmes")).unwrap_err().to_string();
        assert!(error.contains("write N-p ") && error.contains("at stop A, x1 = +sigma"), "{error}");
    }
}
