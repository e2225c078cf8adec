//! Ticks at round values.

use super::number::number;

/// Scales of equal ratios over less than so many decades have the ticks of equal differences.
const LINEAR_BELOW: f64 = 0.7;
/// The digits that are labelled in every decade, the most first.
const DIGITS: [&[i64]; 3] = [&[1, 2, 3, 4, 5, 6, 7, 8, 9], &[1, 2, 5], &[1]];
/// Beyond so many decades minor ticks are at powers of ten alone.
const MOST_DECADES: f64 = 8.0;

/// The ticks of a scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Long ticks: their values and labels.
    pub labelled: Vec<(f64, String)>,
    /// Short ticks between them.
    pub minor: Vec<f64>,
    /// The labels give the values in units of ten to this power.
    pub exponent: i32,
}

/// A distance between ticks: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy)]
struct Step {
    digit: i64,
    power: i32,
}

impl Step {
    /// The smallest step of at least `least`.
    fn at_least(least: f64) -> Self {
        let power = least.log10().floor() as i32;
        let candidates = [(1, power), (2, power), (5, power), (1, power + 1), (2, power + 1)];
        let steps = candidates.map(|(digit, power)| Step { digit, power });
        let enough = |step: &Step| step.times(1) >= least * (1.0 - 1e-9);
        steps.into_iter().find(enough).expect("twice the next power of ten is enough")
    }

    /// A finer step that divides this one, for minor ticks.
    fn finer(self) -> Self {
        match self.digit {
            1 => Step { digit: 2, power: self.power - 1 },
            2 => Step { digit: 5, power: self.power - 1 },
            _ => Step { digit: 1, power: self.power },
        }
    }

    /// The next smaller step.
    fn smaller(self) -> Self {
        match self.digit {
            1 => Step { digit: 5, power: self.power - 1 },
            2 => Step { digit: 1, power: self.power },
            _ => Step { digit: 2, power: self.power },
        }
    }

    /// A multiple of the step, as exact as a decimal fraction can be.
    fn times(self, count: i64) -> f64 {
        let units = (self.digit * count) as f64;
        if self.power < 0 { units / 10_f64.powi(-self.power) } else { units * 10_f64.powi(self.power) }
    }

    /// The multiples of the step in a range.
    fn multiples(self, low: f64, high: f64) -> impl Iterator<Item = i64> {
        let unit = self.times(1);
        (low / unit - 1e-9).ceil() as i64..=(high / unit + 1e-9).floor() as i64
    }
}

impl Ticks {
    /// Ticks at round values from `low` to `high`, with at most about `most` labels; none at all where the
    /// distance is beyond the range of numbers.
    pub fn between(low: f64, high: f64, most: usize) -> Self {
        if !(1e-290..1e300).contains(&(high - low)) {
            return Ticks { labelled: Vec::new(), minor: Vec::new(), exponent: 0 };
        }
        let mut step = Step::at_least((high - low) / most.max(1) as f64);
        // With a single label the scale could not be read.
        while step.multiples(low, high).count() < 2 {
            step = step.smaller();
        }
        let exponent = exponent(low.abs().max(high.abs()));
        let decimals = (exponent - step.power).max(0) as usize;
        let label = |count: i64| {
            let value = Step { power: step.power - exponent, ..step }.times(count);
            format!("{value:.decimals$}").replace('-', "−")
        };
        let labelled = step.multiples(low, high).map(|count| (step.times(count), label(count))).collect();
        let finer = step.finer();
        let minor = finer.multiples(low, high).map(|count| finer.times(count)).collect();
        Ticks { labelled, minor, exponent }
    }

    /// Ticks at round values for a scale of equal ratios, with at most about `most` labels: at powers of ten, with what
    /// is between them where there is room.
    pub fn logarithmic(low: f64, high: f64, most: usize) -> Self {
        if (high / low).log10() < LINEAR_BELOW {
            return Ticks::between(low, high, most);
        }
        let sparse = (1..).map(|stride| round(low, high, &[1], stride));
        let dense = DIGITS.into_iter().map(|digits| round(low, high, digits, 1));
        let enough = |values: &Vec<f64>| (2..=most.max(3)).contains(&values.len());
        let Some(values) = dense.chain(sparse.take_while(|values| values.len() > 1)).find(enough) else {
            return Ticks::between(low, high, most);
        };
        let fine = (high / low).log10() < MOST_DECADES;
        let minor = round(low, high, if fine { DIGITS[0] } else { &[1] }, 1);
        Ticks { minor, ..Ticks::at(values) }
    }

    /// Ticks at some values that need not be round.
    pub fn at(values: impl IntoIterator<Item = f64>) -> Self {
        let labelled = values.into_iter().map(|value| (value, number(value))).collect();
        Ticks { labelled, minor: Vec::new(), exponent: 0 }
    }
}

/// The values from `low` to `high` that are one of some digits times a power of ten, of every `stride`-th power.
fn round(low: f64, high: f64, digits: &[i64], stride: usize) -> Vec<f64> {
    let powers = low.log10().floor() as i32..=high.log10().ceil() as i32;
    powers
        .filter(|power| power.rem_euclid(stride as i32) == 0)
        .flat_map(|power| digits.iter().map(move |&digit| Step { digit, power }.times(1)))
        .filter(|value| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(value))
        .collect()
}

/// The power of ten that the labels leave out: none while the numbers are handy.
fn exponent(largest: f64) -> i32 {
    if (1e-3..1e5).contains(&largest) { 0 } else { largest.log10().floor() as i32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, most: usize) -> Vec<String> {
        Ticks::between(low, high, most).labelled.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_and_fill_the_scale() {
        assert_eq!(labels(0.2, 5.0, 5), ["1", "2", "3", "4", "5"]);
        assert_eq!(labels(0.02, 0.8, 8), ["0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8"]);
        assert_eq!(labels(-1.0, 1.0, 4), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels(0.0, 1000.0, 5), ["0", "200", "400", "600", "800", "1000"]);
    }

    #[test]
    fn there_are_two_labels_at_least() {
        assert_eq!(labels(-0.045, 0.032, 2), ["−0.04", "−0.02", "0.00", "0.02"]);
        assert_eq!(labels(1.1, 1.9, 1).len(), 4);
    }

    #[test]
    fn minor_ticks_divide_the_steps() {
        let ticks = Ticks::between(0.0, 4.0, 4);
        assert_eq!(ticks.minor.len(), 21);
        assert!((ticks.minor[1] - 0.2).abs() < 1e-12);
    }

    #[test]
    fn very_large_and_very_small_values_share_a_power_of_ten() {
        let ticks = Ticks::between(0.0, 3e-7, 3);
        assert_eq!(ticks.exponent, -7);
        assert_eq!(labels(0.0, 3e-7, 3), ["0", "1", "2", "3"]);
        assert_eq!(Ticks::between(0.0, 4e6, 4).exponent, 6);
        assert_eq!(labels(0.0, 4e6, 4), ["0", "1", "2", "3", "4"]);
    }

    #[test]
    fn equal_ratios_have_powers_of_ten() {
        let labels = |low, high, most| -> Vec<String> {
            Ticks::logarithmic(low, high, most).labelled.into_iter().map(|(_, label)| label).collect()
        };
        assert_eq!(labels(0.1, 10.0, 7), ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        assert_eq!(labels(0.1, 10.0, 4), ["0.1", "1", "10"]);
        assert_eq!(labels(1e-8, 1e8, 5).len(), 5);
        assert_eq!(labels(2.0, 3.0, 3), ["2.0", "2.5", "3.0"], "less than a decade");
        assert_eq!(labels(1.5, 9.5, 2).len(), 2);
        let minor = Ticks::logarithmic(0.1, 10.0, 4).minor;
        assert_eq!(minor.len(), 19);
        for (low, high) in [(1e-300, 1e300), (0.2, 5.0), (1.0, 1.0 + 1e-9), (3.0, 1e5)] {
            for most in 1..14 {
                let count = Ticks::logarithmic(low, high, most).labelled.len();
                assert!((1..=most.max(2) + 1).contains(&count), "{low} {high} {most}: {count}");
            }
        }
    }

    #[test]
    fn close_values_get_different_labels() {
        let labels = labels(0.1, 0.1 + 1e-9, 4);
        assert!(labels.len() >= 3);
        assert!(labels.windows(2).all(|pair| pair[0] != pair[1]), "{labels:?}");
    }

    #[test]
    fn the_number_of_labels_is_bounded() {
        for most in 1..30 {
            for (low, high) in
                [(0.2, 5.0), (-3e-4, 7.7), (1e9, 1e9 + 1.0), (-1e-300, 1e-300), (f64::MIN, f64::MAX)]
            {
                let count = Ticks::between(low, high, most).labelled.len();
                assert!(count <= most + 1, "{low} {high} {most}: {count}");
            }
        }
    }
}
