//! The symbols of quantities, with their subscripts.

use crate::control::ControlQuantity;
use crate::figure::Text;
use crate::plane::Quantity;

/// The symbol of a quantity.
pub(super) fn symbol(quantity: Quantity) -> Text {
    match quantity {
        Quantity::Parameter(parameter) => {
            let (letter, subscript) = split_symbol(parameter.symbol());
            Text::new().italic(letter).subscript(subscript)
        }
        Quantity::Start(component) => {
            let (letter, subscript) = component.name().split_at(1);
            Text::new().italic(letter).subscript(subscript)
        }
        Quantity::Control(setting) => control_symbol(setting),
    }
}

/// A symbol as its letter and its subscript: everything after the first letter.
fn split_symbol(symbol: &str) -> (&str, &str) {
    let end = symbol.chars().next().map_or(0, char::len_utf8);
    symbol.split_at(end)
}

/// The symbol of a setting of a control method.
pub(super) fn control_symbol(setting: ControlQuantity) -> Text {
    let letter = |letter: &str| Text::new().italic(letter);
    match setting {
        ControlQuantity::Gain => letter("g"),
        ControlQuantity::Delay => letter("p"),
        ControlQuantity::Amplitude => letter("B"),
        ControlQuantity::Alpha => letter("α"),
        ControlQuantity::DeadBand => letter("Δ"),
        ControlQuantity::Gamma => letter("γ"),
        ControlQuantity::Phase => letter("φ"),
        ControlQuantity::Period => letter("P"),
        ControlQuantity::Noise => letter("E"),
        ControlQuantity::TargetV1 => letter("v").subscript("1").superscript("+"),
        ControlQuantity::TargetV2 => letter("v").subscript("2"),
        ControlQuantity::TargetV3 => letter("v").subscript("3"),
        ControlQuantity::TargetV4 => letter("v").subscript("4"),
        ControlQuantity::TargetX1 => letter("x").subscript("1"),
        ControlQuantity::TargetX2 => letter("x").subscript("2"),
        ControlQuantity::TargetX3 => letter("x").subscript("3"),
        ControlQuantity::TargetX4 => letter("x").subscript("4"),
        ControlQuantity::TargetTau => letter("τ").subscript("0"),
    }
}
