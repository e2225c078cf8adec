//! Numbers as they are printed.

/// A number as it is printed: at most six significant digits, a real minus sign.
pub(crate) fn number(value: f64) -> String {
    let shortest = value.to_string();
    let text = if shortest.len() <= 8 && (value == 0.0 || value.abs() >= 1e-4) {
        shortest
    } else {
        let rounded: f64 = format!("{value:.5e}").parse().expect("a printed number is a number");
        if rounded == 0.0 || (1e-4..1e6).contains(&rounded.abs()) {
            rounded.to_string()
        } else {
            format!("{rounded:e}")
        }
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.5, "0.5"),
            (-0.05, "−0.05"),
            (1.0 / 3.0, "0.333333"),
            (-2.0 / 3.0, "−0.666667"),
            (0.1 + 0.2, "0.3"),
            (1e-12 / 3.0, "3.33333e−13"),
            (12_345_678.9, "1.23457e7"),
            (0.0001, "0.0001"),
            (0.00001, "1e−5"),
            (0.0, "0"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
