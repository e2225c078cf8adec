//! Where stops stand, and what labels count there, in symbols.

use super::symbol::symbol;
use crate::dynamics::Stop;
use crate::figure::{Text, number};
use crate::model::vector::MOST;
use crate::model::{Parameter, Setting, are_parallel};
use crate::plane::Quantity;
use crate::system::{Family, Gap, StopPlace};

/// d·v along the contact normal of a stop: v1, −v1, or in parentheses v1 − v2.
pub(super) fn along(setting: &Setting, stop: Stop) -> Text {
    let stops = |i: usize| setting.family().stop_place(i);
    let first = setting.plant().ok().map_or(stop.index(), |plant| {
        let own = &plant.stops[stop.index()].direction;
        (0..stop.index())
            .find(|&i| are_parallel(own.as_slice(), plant.stops[i].direction.as_slice()))
            .unwrap_or(stop.index())
    });
    let place = stops(first);
    let alone = place.is_alone();
    let mut text = Text::new();
    if !alone {
        text = text.upright("(");
    } else if place.negative {
        text = text.upright("−");
    }
    text = text.then(terms(&place, "v"));
    if alone { text } else { text.upright(")") }
}

/// The terms of direction · x, or of direction · v.
fn terms(place: &StopPlace, letter: &str) -> Text {
    place.terms.iter().enumerate().fold(Text::new(), |text, (i, term)| {
        let sign = match (i, term.negative) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        };
        let factor = if term.factor.is_empty() { String::new() } else { format!("{} ", term.factor) };
        let coordinate = (term.coordinate + 1).to_string();
        text.upright(sign).upright(factor).italic(letter).subscript(coordinate)
    })
}

/// Where a stop of a family stands: x1 = +δ.
pub(super) fn stop_place(family: &'static Family, stop: usize) -> Text {
    let place = family.stop_place(stop);
    let text = terms(&place, "x").upright(" = ");
    let signed = |text: Text| match (place.negative, place.is_alone()) {
        (true, _) => text.upright("−"),
        (false, true) => text.upright("+"),
        (false, false) => text,
    };
    match &place.gap {
        Gap::Number(value) => text.upright(number(if place.negative { 0.0 - value } else { *value })),
        Gap::Name(name) => match Parameter::of(family, name) {
            Ok(parameter) => signed(text).then(symbol(Quantity::Parameter(parameter))),
            Err(_) => signed(text).upright(name),
        },
        Gap::Formula(sum) if place.gap.is_sum() && place.negative => {
            text.upright("−(").then(formula(family, sum)).upright(")")
        }
        Gap::Formula(sum) if place.gap.is_sum() => text.then(formula(family, sum)),
        Gap::Formula(product) => signed(text).then(formula(family, product)),
    }
}

/// A formula with the symbols of a family's parameters in place of their names, and products without a sign.
fn formula(family: &'static Family, text: &str) -> Text {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let mut rest = text;
    let mut set = Text::new();
    while let Some(first) = rest.chars().next() {
        let end = match is_name(first) {
            true => rest.find(|c: char| !is_name(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (piece, later) = rest.split_at(end);
        set = match (Parameter::of(family, piece), piece) {
            (Ok(parameter), _) => set.then(symbol(Quantity::Parameter(parameter))),
            (Err(_), "*") => set,
            (Err(_), "-") => set.upright("−"),
            (Err(_), piece) => set.upright(piece),
        };
        rest = later;
    }
    set
}

/// The stops of a family in a key: stops x1 = ±δ.
pub(super) fn stops(family: &'static Family) -> Text {
    let places: Vec<StopPlace> = (0..family.stops().len()).map(|stop| family.stop_place(stop)).collect();
    match &places[..] {
        [_] => Text::from("stop ").then(stop_place(family, 0)),
        [a, b] if a.negative != b.negative && a.terms == b.terms && a.gap == b.gap => {
            let text = Text::from("stops ").then(terms(a, "x")).upright(" = ±");
            match &a.gap {
                Gap::Name(name) => match Parameter::of(family, name) {
                    Ok(parameter) => text.then(symbol(Quantity::Parameter(parameter))),
                    Err(_) => text.upright(name),
                },
                Gap::Number(value) => text.upright(number(*value)),
                Gap::Formula(product) => text.upright("(").then(formula(family, product)).upright(")"),
            }
        }
        [_, _] => Text::from("stops ").then(stop_place(family, 0)).upright(", ").then(stop_place(family, 1)),
        _ => {
            let names: Vec<&str> = family.stops().iter().map(|stop| stop.name.as_str()).collect();
            Text::from(format!("stops {}", names.join(", ")))
        }
    }
}

/// The letters of labels behind N.
const COUNTS: [&str; MOST] = ["p", "q", "s", "u"];

/// The meaning of labels, in pieces that belong together: N-p-q: N forcing periods, p impacts at …
pub(super) fn label_definition(family: &'static Family) -> Vec<Text> {
    let order = family.label_order();
    let head = COUNTS[..order.len()]
        .iter()
        .fold(Text::new().italic("N"), |text, letter| text.upright("-").italic(*letter));
    let mut pieces = vec![head.upright(": ").italic("N").upright(" forcing periods,")];
    pieces.extend(order.iter().zip(COUNTS).enumerate().map(|(i, (&stop, letter))| {
        let comma = if i + 1 < order.len() { "," } else { "" };
        Text::new().italic(letter).upright(" impacts at ").then(stop_place(family, stop)).upright(comma)
    }));
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_the_symbols_of_their_family() {
        let two_sided = Family::builtin("two-sided");
        let places = [stop_place(two_sided, 0), stop_place(two_sided, 1)];
        let at = |sign: &str| Text::new().italic("x").subscript("1").upright(format!(" = {sign}"));
        assert_eq!(places, [at("+").italic("δ"), at("−").italic("βδ")]);
        assert_eq!(stops(Family::paper()), Text::from("stops ").then(at("±")).italic("δ"));
        let labels = |name: &str| label_definition(Family::builtin(name));
        assert_eq!(labels("shaw-holmes")[0], {
            Text::new()
                .italic("N")
                .upright("-")
                .italic("p")
                .upright(": ")
                .italic("N")
                .upright(" forcing periods,")
        });
        assert_eq!((labels("shaw-holmes").len(), labels("luo-ma-lv").len()), (2, 3));
    }
}
