//! The symbols of quantities, with their subscripts.

use crate::control::ControlQuantity;
use crate::figure::Text;
use crate::plane::Quantity;

/// The symbol of a quantity.
pub(super) fn symbol(quantity: Quantity) -> Text {
    match quantity {
        Quantity::Parameter(parameter) => {
            if parameter.about().symbol == parameter.name() {
                return of_name(parameter.name());
            }
            let (letter, subscript) = split_symbol(&parameter.about().symbol);
            Text::new().italic(letter).subscript(subscript)
        }
        Quantity::Start(component) => {
            let (letter, subscript) = component.name().split_at(1);
            Text::new().italic(letter).subscript(subscript)
        }
        Quantity::Control(setting) => control_symbol(setting),
    }
}

/// What stands for a parameter whose file gives no symbol: its name, with what follows an underscore or the digits at its end
/// as the subscript.
fn of_name(name: &str) -> Text {
    let (word, subscript) = match name.split_once('_') {
        Some((word, subscript)) if !word.is_empty() => (word, subscript),
        _ => name.split_at(name.trim_end_matches(|c: char| c.is_ascii_digit()).len()),
    };
    Text::new().italic(word).subscript(subscript)
}

/// A symbol as its letter and its subscript: everything after the first letter, but for an underscore.
fn split_symbol(symbol: &str) -> (&str, &str) {
    let end = symbol.chars().next().map_or(0, char::len_utf8);
    let (letter, subscript) = symbol.split_at(end);
    (letter, subscript.strip_prefix('_').unwrap_or(subscript))
}

/// The symbol of a setting of a control method.
pub(super) fn control_symbol(setting: ControlQuantity) -> Text {
    let [letter, subscript, superscript] = setting.symbol;
    Text::new().italic(letter).subscript(subscript).superscript(superscript)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_without_a_symbol_is_called_by_its_name() {
        let plain = |name: &str| Text::new().italic(name);
        assert_eq!(of_name("omega"), plain("omega"));
        assert_eq!(of_name("mu_m"), plain("mu").subscript("m"));
        assert_eq!(of_name("k12"), plain("k").subscript("12"));
        assert_eq!(of_name("r"), plain("r"));
        assert_eq!(of_name("_a"), plain("_a"));
        let mu = split_symbol("µm");
        assert_eq!(mu, ("µ", "m"));
        assert_eq!(["Ω_shaker", "f_"].map(split_symbol), [("Ω", "shaker"), ("f", "")]);
    }
}
