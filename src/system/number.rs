//! Numbers as people write them, and as they read them.

use std::fmt;

/// A number in its shortest form that reads back as itself: with an exponent where digits would be zeros only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:?}", self.0);
        f.write_str(text.strip_suffix(".0").unwrap_or(&text))
    }
}

/// Several numbers with a separator.
pub fn joined(numbers: &[f64], separator: &str) -> String {
    numbers.iter().map(|&number| Number(number).to_string()).collect::<Vec<_>>().join(separator)
}

/// Reads a whole number as people write it, 1000 or 1e3; `None` where the text is none.
pub fn whole(text: &str) -> Option<u64> {
    /// Up to here every whole number has a double of its own.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let text = text.trim();
    if let Ok(number) = text.parse() {
        return Some(number);
    }
    let mantissa = text.split(['e', 'E']).next().filter(|mantissa| mantissa.len() < text.len())?;
    let number: f64 = text.parse().ok()?;
    let written = mantissa.starts_with(|first: char| first.is_ascii_digit());
    (written && number.fract() == 0.0 && (0.0..=EXACT).contains(&number)).then_some(number as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        for (number, text) in [
            (1e-100, "1e-100"),
            (-2.5e-7, "-2.5e-7"),
            (5e-324, "5e-324"),
            (0.1, "0.1"),
            (-0.05, "-0.05"),
            (3.0, "3"),
            (0.0, "0"),
            (60_000.0, "60000"),
            (1e300, "1e300"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Number(number).to_string(), text);
            assert!(text.parse::<f64>().unwrap() == number || number.is_nan());
        }
        assert_eq!(joined(&[0.5, 1e-9, 2.0], ","), "0.5,1e-9,2");
    }

    #[test]
    fn whole_numbers_may_have_an_exponent() {
        for (text, number) in
            [("0", 0), ("17", 17), (" 1e3 ", 1000), ("2.5e4", 25_000), ("1E0", 1), ("10e-1", 1)]
        {
            assert_eq!(whole(text), Some(number), "{text}");
        }
        assert_eq!(whole("18446744073709551615"), Some(u64::MAX));
        for text in ["", "1.5", "1.0", "1e-3", "-1", "-1e3", "1e300", "e3", "inf", "nan", "many", "1e", "+e1"]
        {
            assert_eq!(whole(text), None, "{text}");
        }
    }
}
