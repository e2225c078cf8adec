//! Titles of axes, and settings as equations.

use super::places;
use super::symbol::symbol;
use crate::analysis::{Reading, Section};
use crate::dynamics::Stop;
use crate::figure::{AxisTitle, Text, number};
use crate::model::{Setting, StateVector};
use crate::plane::{Component, Quantity, Start};
use crate::system::Family;

/// The masses, by their places.
pub(super) const ORDINALS: [&str; 4] = ["first", "second", "third", "fourth"];

/// The title of an axis over a quantity.
pub(super) fn axis_title(quantity: Quantity) -> AxisTitle {
    let description = match quantity {
        Quantity::Parameter(parameter) => parameter.about().about.to_owned(),
        Quantity::Start(component) => {
            let what = if component.is_velocity() { "velocity" } else { "displacement" };
            format!("start {what} of the {} mass", ORDINALS[component.coordinate()])
        }
        Quantity::Control(setting) => setting.description.to_owned(),
    };
    AxisTitle::new(&description, symbol(quantity))
}

/// The symbol of what is read on a section of the first coordinate.
pub(super) fn reading_symbol(reading: Reading) -> Text {
    let letter = |letter, subscript: u8| Text::new().italic(letter).subscript((subscript + 1).to_string());
    match reading {
        Reading::VBefore => letter("v", 0).superscript("−"),
        Reading::VAfter => letter("v", 0).superscript("+"),
        Reading::X(i) => letter("x", i),
        Reading::V(i) => letter("v", i),
        Reading::Tau => Text::new().italic("τ"),
        Reading::Gap(stop) => Text::new().italic("g").subscript(stop.to_string()),
        Reading::Speed(stop) => Text::new().italic("u").subscript(stop.to_string()),
    }
}

/// The title of an axis over what is read on a section of the first coordinate.
pub(super) fn reading_title(reading: Reading) -> AxisTitle {
    let of_mass = |what: &str, i: u8| format!("{what} of the {} mass", ORDINALS[usize::from(i)]);
    let description = match reading {
        Reading::VBefore => "velocity before impact".to_owned(),
        Reading::VAfter => "velocity after impact".to_owned(),
        Reading::X(i) => of_mass("displacement", i),
        Reading::V(i) => of_mass("velocity", i),
        Reading::Tau => "forcing phase at impact".to_owned(),
        Reading::Gap(stop) => format!("distance left to stop {stop}"),
        Reading::Speed(stop) => format!("velocity towards stop {stop}"),
    };
    AxisTitle::new(&description, reading_symbol(reading))
}

/// The title of an axis over what is read on a section of a system: named after its own stops and coordinates.
pub(super) fn title_on(setting: &Setting, section: Section, reading: Reading) -> AxisTitle {
    let family = setting.family();
    let name = |stop: Stop| family.stops()[stop.index()].name.as_str();
    let sign = |before: bool| if before { "−" } else { "+" };
    match (reading, section) {
        (Reading::VBefore | Reading::VAfter, Section::Impact(stop)) => {
            let before = reading == Reading::VBefore;
            let what = if before { "velocity before impact" } else { "velocity after impact" };
            AxisTitle::new(what, places::along(setting, stop).superscript(sign(before)))
        }
        (Reading::X(_), _) if family.n() == 1 => AxisTitle::new("displacement", reading_symbol(reading)),
        (Reading::V(_), _) if family.n() == 1 => AxisTitle::new("velocity", reading_symbol(reading)),
        (Reading::Gap(stop), _) => AxisTitle::new(
            &format!("distance left to stop {}", name(stop)),
            Text::new().italic("g").subscript(name(stop)),
        ),
        (Reading::Speed(stop), _) => AxisTitle::new(
            &format!("velocity towards stop {}", name(stop)),
            Text::new().italic("u").subscript(name(stop)),
        ),
        _ => reading_title(reading),
    }
}

/// Parameters as equations, in pieces that belong together, without those of which `varied` says so.
///
/// Mass, stiffness and damping ratios that are alike share one equation.
pub(super) fn equations(parameters: &Setting, varied: impl Fn(Quantity) -> bool) -> Vec<Text> {
    let mut pieces: Vec<(Text, f64)> = Vec::new();
    for (parameter, value) in parameters.entries() {
        let quantity = Quantity::Parameter(parameter);
        let ratio = matches!(parameter.name(), "mu_k" | "mu_c");
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
///
/// Systems none of which is `mirrored` have no symmetric motion, and begin at rest in its place.
pub(super) fn start(
    start: Start,
    mirrored: bool,
    family: &Family,
    varied: impl Fn(Component) -> bool,
) -> Vec<Text> {
    let coordinates = family.n();
    let any_varied = Component::all(coordinates).any(&varied);
    let state = match start {
        Start::Symmetric if mirrored && family.stops().len() == 2 => {
            return vec!["start on the 1-1-1 motion, else at rest".into()];
        }
        Start::Symmetric if mirrored => return vec!["start on the symmetric motion, else at rest".into()],
        Start::Rest | Start::Symmetric if !any_varied => return vec!["start at rest".into()],
        Start::Rest | Start::Symmetric => StateVector::zeros(coordinates),
        Start::State(state) => state,
    };
    let fixed: Vec<Component> = Component::all(coordinates).filter(|&c| !varied(c)).collect();
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
