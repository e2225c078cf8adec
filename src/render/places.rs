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
        // Between digits the font has a cross for an x, but behind a point.
        let times = if term.factor.ends_with(|c: char| c.is_ascii_digit()) { "·" } else { " " };
        let factor = if term.factor.is_empty() { String::new() } else { format!("{}{times}", term.factor) };
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

/// A formula with the symbols of a family's parameters in place of their names, and products without a sign where they cannot be
/// misread.
fn formula(family: &'static Family, text: &str) -> Text {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    // What runs into its neighbours: a number, or a name of several letters.
    let runs_on = |piece: &str| match Parameter::of(family, piece) {
        Ok(parameter) => is_word(&symbol(Quantity::Parameter(parameter))),
        Err(_) => piece.starts_with(is_name),
    };
    let (mut rest, mut before) = (text, "");
    let mut set = Text::new();
    while let Some(first) = rest.chars().next() {
        let end = match is_name(first) {
            true => rest.find(|c: char| !is_name(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (piece, later) = rest.split_at(end);
        set = match (Parameter::of(family, piece), piece) {
            (Ok(parameter), _) => set.then(symbol(Quantity::Parameter(parameter))),
            (Err(_), "*") => {
                let next = later.trim_start();
                let next = &next[..next.find(|c: char| !is_name(c)).unwrap_or(next.len())];
                let number = before.starts_with(|c: char| c.is_ascii_digit() || c == '.');
                let misread = runs_on(next) || !number && runs_on(before);
                set.upright(if misread { "·" } else { "" })
            }
            (Err(_), "-") => set.upright("−"),
            (Err(_), piece) => set.upright(piece),
        };
        (rest, before) = (later, if piece.trim().is_empty() { before } else { piece });
    }
    set
}

/// Whether a symbol begins with several letters.
fn is_word(symbol: &Text) -> bool {
    symbol.spans().first().is_some_and(|span| span.content.chars().count() > 1)
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

/// The meaning of labels, in pieces that belong together: N-p-q: N forcing periods, p impacts at … Stops are called by where they
/// stand, or by their `names`, which may be shorter.
pub(super) fn label_definition(family: &'static Family, names: bool) -> Vec<Text> {
    let order = family.label_order();
    let head = COUNTS[..order.len()]
        .iter()
        .fold(Text::new().italic("N"), |text, letter| text.upright("-").italic(*letter));
    let mut pieces = vec![head.upright(": ").italic("N").upright(" forcing periods,")];
    pieces.extend(order.iter().zip(COUNTS).enumerate().map(|(i, (&stop, letter))| {
        let comma = if i + 1 < order.len() { "," } else { "" };
        let stop = match names {
            true => Text::from(family.stops()[stop].name.as_str()),
            false => stop_place(family, stop),
        };
        Text::new().italic(letter).upright(" impacts at ").then(stop).upright(comma)
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
        let labels = |name: &str| label_definition(Family::builtin(name), false);
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

    /// Where the two stops of a family stand whose gaps are written so.
    fn places_of(gap: &str, direction: &str) -> [String; 2] {
        let text = format!(
            r#"
            name = "gaps"
            [parameters]
            omega = 1
            g = 0.1
            h = {{ default = 0.2, symbol = "η" }}
            clearance = 0.3
            [system]
            frequency = "omega"
            mass = [["1", "0"], ["0", "1"]]
            damping = [["g + h + clearance", "0"], ["0", "1"]]
            stiffness = [["1", "0"], ["0", "1"]]
            force_sin = ["1", "0"]
            [[stop]]
            name = "top"
            direction = {direction}
            gap = "{gap}"
            restitution = "0.5"
            [[stop]]
            name = "bottom"
            direction = ["0", "-1"]
            gap = "{gap}"
            restitution = "0.5"
            "#
        );
        let family = Family::kept(&text, "gaps.toml").unwrap();
        let stops = [0, 1].map(|stop| stop_place(family, stop).plain());
        let named = label_definition(family, true);
        assert_eq!(named[1].plain(), "p impacts at top,");
        assert_eq!(named[2].plain(), "q impacts at bottom");
        stops
    }

    #[test]
    fn products_have_a_sign_where_they_would_be_misread() {
        for (gap, set) in [
            ("g*h", "gη"),
            ("2*g", "2g"),
            ("g*0.5", "g·0.5"),
            ("2*3*g", "2·3g"),
            ("2*1.5*g*h", "2·1.5gη"),
            ("g*2^h", "g·2^η"),
            ("2*clearance", "2·clearance"),
            ("clearance * h", "clearance · η"),
            ("2*(1/g)", "2(1/g)"),
        ] {
            assert_eq!(
                places_of(gap, r#"["1", "0"]"#),
                [format!("x1 = +{set}"), format!("x2 = −{set}")],
                "{gap}"
            );
        }
    }

    #[test]
    fn a_coordinate_behind_a_number_is_no_cross() {
        let tilted = |direction: &str| places_of("g", direction)[0].clone();
        assert_eq!(tilted(r#"["0.8", "0.6"]"#), "0.8·x1 + 0.6·x2 = g");
        assert_eq!(tilted(r#"["1", "-h"]"#), "x1 − h x2 = g");
    }
}
