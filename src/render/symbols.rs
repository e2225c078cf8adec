//! How quantities are printed: symbols with their subscripts, and numbers.

use super::frame::AxisTitle;
use super::text::Text;
use crate::analysis::Reading;
use crate::control::ControlQuantity;
use crate::model::{Parameter, Parameters};
use crate::plane::{Component, Quantity, Start};

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
        Quantity::Control(setting) => control_symbol(setting),
    }
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
        ControlQuantity::TargetX2 => letter("x").subscript("2"),
        ControlQuantity::TargetV2 => letter("v").subscript("2"),
        ControlQuantity::TargetTau => letter("τ").subscript("0"),
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
        Quantity::Control(setting) => setting.description(),
    };
    let short = symbol(quantity);
    AxisTitle { long: Text::from(description).upright(" ").then(short.clone()), short }
}

/// The symbol of what is read on a section.
pub(super) fn reading_symbol(reading: Reading) -> Text {
    let letter = |letter, subscript| Text::new().italic(letter).subscript(subscript);
    match reading {
        Reading::VBefore => letter("v", "1").superscript("−"),
        Reading::VAfter => letter("v", "1").superscript("+"),
        Reading::X1 => letter("x", "1"),
        Reading::X2 => letter("x", "2"),
        Reading::V1 => letter("v", "1"),
        Reading::V2 => letter("v", "2"),
        Reading::Tau => Text::new().italic("τ"),
    }
}

/// The title of an axis over what is read on a section.
pub(super) fn reading_title(reading: Reading) -> AxisTitle {
    let description = match reading {
        Reading::VBefore => "velocity before impact",
        Reading::VAfter => "velocity after impact",
        Reading::X1 => "displacement of the first mass",
        Reading::X2 => "displacement of the second mass",
        Reading::V1 => "velocity of the first mass",
        Reading::V2 => "velocity of the second mass",
        Reading::Tau => "forcing phase at impact",
    };
    let short = reading_symbol(reading);
    AxisTitle { long: Text::from(description).upright(" ").then(short.clone()), short }
}

/// Parameters as equations, in pieces that belong together, without those of which `varied` says so.
///
/// Mass, stiffness and damping ratios that are alike share one equation.
pub(super) fn equations(parameters: &Parameters, varied: impl Fn(Quantity) -> bool) -> Vec<Text> {
    let mut pieces: Vec<(Text, f64)> = Vec::new();
    for parameter in Parameter::ALL {
        let quantity = Quantity::Parameter(parameter);
        let value = parameters.get(parameter);
        let ratio = matches!(parameter, Parameter::MuK | Parameter::MuC);
        match pieces.last_mut() {
            _ if varied(quantity) => {}
            Some((names, same)) if ratio && *same == value => {
                *names = names.clone().upright(" = ").then(symbol(quantity));
            }
            _ => pieces.push((symbol(quantity), value)),
        }
    }
    pieces.into_iter().map(|(names, value)| names.upright(format!(" = {},", number(value)))).collect()
}

/// How trajectories begin, in pieces that belong together; `varied` says which components of the start are not fixed.
pub(super) fn start(start: Start, varied: impl Fn(Component) -> bool) -> Vec<Text> {
    let any_varied = Component::ALL.into_iter().any(&varied);
    let state = match start {
        Start::Symmetric => return vec!["start on the 1-1-1 motion, else at rest".into()],
        Start::Rest if !any_varied => return vec!["start at rest".into()],
        Start::Rest => [0.0; 4],
        Start::State(state) => state,
    };
    let fixed: Vec<Component> = Component::ALL.into_iter().filter(|&c| !varied(c)).collect();
    let last = fixed.len() - 1;
    let piece = |(i, component): (usize, Component)| {
        let before = if i == 0 { "start " } else { "" };
        let after = if i == last { "" } else { "," };
        let value = number(state[component.index()]);
        let symbol = symbol(Quantity::Start(component));
        Text::from(before).then(symbol).upright(format!(" = {value}{after}"))
    };
    fixed.into_iter().enumerate().map(piece).collect()
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
