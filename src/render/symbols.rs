//! How quantities are printed: symbols with their subscripts, and numbers.

use super::frame::AxisTitle;
use super::text::Text;
use crate::model::Parameter;
use crate::plane::{Component, Quantity};

/// The symbol of a quantity.
pub(super) fn symbol(quantity: Quantity) -> Text {
    let letter = |letter, subscript| Text::new().italic(letter).subscript(subscript);
    match quantity {
        Quantity::Parameter(Parameter::MuM) => letter("μ", "m"),
        Quantity::Parameter(Parameter::MuK) => letter("μ", "k"),
        Quantity::Parameter(Parameter::MuC) => letter("μ", "c"),
        Quantity::Parameter(Parameter::F20) => letter("f", "20"),
        Quantity::Parameter(parameter) => Text::new().italic(parameter.symbol()),
        Quantity::Start(Component::X1) => letter("x", "1"),
        Quantity::Start(Component::X2) => letter("x", "2"),
        Quantity::Start(Component::V1) => letter("v", "1"),
        Quantity::Start(Component::V2) => letter("v", "2"),
    }
}

/// The title of an axis over a quantity.
pub(super) fn axis_title(quantity: Quantity) -> AxisTitle {
    let description = match quantity {
        Quantity::Parameter(parameter) => parameter.description(),
        Quantity::Start(Component::X1) => "start displacement of the first mass",
        Quantity::Start(Component::X2) => "start displacement of the second mass",
        Quantity::Start(Component::V1) => "start velocity of the first mass",
        Quantity::Start(Component::V2) => "start velocity of the second mass",
    };
    let short = symbol(quantity);
    AxisTitle { long: Text::from(description).upright(" ").then(short.clone()), short }
}

/// A number as it is printed: at most six significant digits, a real minus sign.
pub(super) fn number(value: f64) -> String {
    let shortest = value.to_string();
    let text = if shortest.len() <= 8 {
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
        ] {
            assert_eq!(number(value), text);
        }
    }
}
