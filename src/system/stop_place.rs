//! Where a stop stands, in the words of the family's file.

use std::fmt;

/// Where a stop is touched: direction · x = gap as the file writes it, such as `x1 = +delta` or `x1 - x2 = sigma`.
#[derive(Clone, Debug, PartialEq)]
pub struct StopPlace {
    /// The parts of direction · x; those that are 0 are left out.
    pub terms: Vec<Term>,
    /// What they sum to.
    pub gap: Gap,
    /// Whether the gap counts with the other sign: a stop that one coordinate meets from above.
    pub negative: bool,
}

/// A coordinate with its factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Whether it is subtracted.
    pub negative: bool,
    /// The factor as it is written, empty for 1.
    pub factor: String,
    /// Which coordinate, counted from 0.
    pub coordinate: usize,
}

/// A gap as it is written.
#[derive(Clone, Debug, PartialEq)]
pub enum Gap {
    /// A number.
    Number(f64),
    /// A single name: a parameter.
    Name(String),
    /// Anything else.
    Formula(String),
}

impl StopPlace {
    /// From the expressions of the direction and of the gap.
    pub(super) fn of<'a>(direction: impl Iterator<Item = &'a str>, gap: &str) -> Self {
        let mut terms: Vec<Term> = direction
            .enumerate()
            .filter_map(|(coordinate, text)| Term::of(text.trim(), coordinate))
            .collect();
        let negative = matches!(terms[..], [Term { negative: true, .. }]);
        if negative {
            terms[0].negative = false;
        }
        StopPlace { terms, gap: Gap::of(gap.trim()), negative }
    }

    /// Whether one coordinate alone meets the stop.
    pub fn is_alone(&self) -> bool {
        self.terms.len() == 1
    }
}

impl Term {
    fn of(text: &str, coordinate: usize) -> Option<Self> {
        if let Ok(number) = text.parse::<f64>() {
            let factor = if number.abs() == 1.0 { String::new() } else { number.abs().to_string() };
            return (number != 0.0).then_some(Term { negative: number < 0.0, factor, coordinate });
        }
        let (negative, rest) = match text.strip_prefix('-') {
            Some(rest) if !is_sum(rest) => (true, rest.trim()),
            _ => (false, text),
        };
        let factor = if is_sum(rest) { format!("({rest})") } else { rest.to_owned() };
        Some(Term { negative, factor, coordinate })
    }
}

impl Gap {
    fn of(text: &str) -> Self {
        match text.parse() {
            Ok(number) => Gap::Number(number),
            Err(_) if is_name(text) => Gap::Name(text.to_owned()),
            Err(_) => Gap::Formula(text.to_owned()),
        }
    }

    /// Whether it must stand in parentheses behind a sign.
    pub fn is_sum(&self) -> bool {
        matches!(self, Gap::Formula(text) if is_sum(text))
    }
}

fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn is_sum(text: &str) -> bool {
    text.contains(['+', '-'])
}

impl fmt::Display for StopPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, Term { negative, factor, coordinate }) in self.terms.iter().enumerate() {
            f.write_str(match (i, negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            })?;
            let times = if factor.is_empty() { "" } else { "*" };
            write!(f, "{factor}{times}x{}", coordinate + 1)?;
        }
        f.write_str(" = ")?;
        match (&self.gap, self.negative) {
            (Gap::Number(number), negative) => {
                // No −0.
                write!(f, "{}", if negative { 0.0 - number } else { *number })
            }
            (Gap::Name(text) | Gap::Formula(text), true) if self.gap.is_sum() => write!(f, "-({text})"),
            (Gap::Name(text) | Gap::Formula(text), true) => write!(f, "-{text}"),
            (Gap::Name(text) | Gap::Formula(text), false) if self.is_alone() && !self.gap.is_sum() => {
                write!(f, "+{text}")
            }
            (Gap::Name(text) | Gap::Formula(text), false) => f.write_str(text),
        }
    }
}
