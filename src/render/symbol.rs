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
    let [letter, subscript, superscript] = setting.symbol();
    let text = Text::new().italic(letter);
    let text = if subscript.is_empty() { text } else { text.subscript(subscript) };
    if superscript.is_empty() { text } else { text.superscript(superscript) }
}
