//! The colour bar of a layer of numbers.

use serde::Serialize;

use crate::figure::{Bar, Palette, css, fitting_ticks, widest};
use crate::plane::fields::Layer;
use crate::render::numbers::{LOST, UNDEFINED};

/// The colours of a bar.
const COLOURS: u32 = 128;

/// A part of a colour bar; there are two where they meet at zero.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LivePart {
    /// The numbers at its ends.
    pub ends: [f64; 2],
    /// Whether it is one of equal ratios.
    pub log: bool,
    /// The shares of the whole bar at its ends.
    pub shares: [f64; 2],
}

/// A colour bar.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiveBar {
    /// What the numbers are.
    pub title: String,
    /// Its parts, upwards.
    pub parts: Vec<LivePart>,
    /// Colours of equal shares of it, from the lower end on, as style sheets write them.
    pub colours: Vec<String>,
    /// The colours below and above it.
    pub beyond: [String; 2],
    /// The colour of cells without a number, and what they are called.
    pub undefined: (String, &'static str),
    /// The colour of cells whose number is minus infinity, and what they are called.
    pub lost: (String, &'static str),
    /// Labelled ticks: the share of the way from the lower to the upper end, and the label.
    pub ticks: Vec<(f64, String)>,
}

/// The bar of a layer's numbers, along `length` pixels in letters of `em` pixels. None for the layer of motions, and where
/// there is no number.
pub fn live_bar(layer: &Layer, values: &[f32], length: f64, em: f64) -> Option<LiveBar> {
    let Layer::Number { drawn, .. } = layer else { return None };
    let bar = Bar::of(values, drawn.spread, None, Palette::suiting(drawn.spread))?;
    let (low, high) = bar.shares()?;
    let mut ticks: Vec<(f64, String)> = Vec::new();
    for (scale, [from, to]) in bar.parts() {
        let share = (to - from) / (high - low);
        let chosen = fitting_ticks(*scale, length * share, |ticks| widest(ticks, em) + em);
        let unit = if chosen.exponent == 0 { String::new() } else { format!("·1e{}", chosen.exponent) };
        let at = |value: f64| (from - low) / (high - low) + scale.fraction(value) * share;
        let labelled = chosen.labelled.iter().map(|(value, label)| (at(*value), format!("{label}{unit}")));
        ticks.extend(labelled.filter(|(share, _)| ticks_apart(*share, length, em, &[])));
    }
    let mut apart: Vec<(f64, String)> = Vec::new();
    for (share, label) in ticks {
        if ticks_apart(share, length, em, &apart) {
            apart.push((share, label));
        }
    }
    let parts = bar.parts().iter().map(|(scale, [from, to])| LivePart {
        ends: scale.ends(),
        log: scale.is_logarithmic(),
        shares: [from, to].map(|share| (share - low) / (high - low)),
    });
    let shares = (0..COLOURS).map(|i| low + (f64::from(i) + 0.5) / f64::from(COLOURS) * (high - low));
    Some(LiveBar {
        title: layer.title(),
        parts: parts.collect(),
        colours: shares.map(|share| css(bar.palette().colour(share))).collect(),
        beyond: [false, true].map(|above| css(Palette::beyond(above))),
        undefined: (css(UNDEFINED), drawn.undefined),
        lost: (css(LOST), drawn.lost),
        ticks: apart,
    })
}

/// Whether a tick stands on the bar and apart from others: those of two parts may meet at zero.
fn ticks_apart(share: f64, length: f64, em: f64, others: &[(f64, String)]) -> bool {
    let near = |(other, _): &(f64, String)| (share - other).abs() * length < 1.6 * em;
    (0.0..=1.0).contains(&share) && !others.iter().any(near)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Family;

    #[test]
    fn a_bar_has_the_colours_of_the_picture() {
        let values: Vec<f32> = (0..=1000_u16).map(|i| f32::from(i) / 500.0 - 0.7).collect();
        for layer in Layer::all(Family::paper()) {
            let Layer::Number { drawn, .. } = &layer else {
                assert_eq!(live_bar(&layer, &values, 240.0, 12.0), None);
                continue;
            };
            let live = live_bar(&layer, &values, 240.0, 12.0).unwrap();
            let bar = Bar::of(&values, drawn.spread, None, Palette::suiting(drawn.spread)).unwrap();
            let part = live.parts.last().unwrap();
            let value = part.ends[1];
            assert_eq!(part.shares[1], 1.0);
            assert_eq!(live.parts[0].shares[0], 0.0);
            let channel =
                |text: &str, c: usize| i32::from_str_radix(&text[1 + 2 * c..3 + 2 * c], 16).unwrap();
            let exact = css(bar.colour(value));
            for c in 0..3 {
                assert!((channel(&live.colours[127], c) - channel(&exact, c)).abs() < 12, "{}", layer.name());
            }
            assert!(live.ticks.len() >= 2 && live.ticks.windows(2).all(|pair| pair[0].0 < pair[1].0));
            assert_ne!(live.colours[0], live.colours[127]);
            assert_eq!(live_bar(&layer, &[f32::NAN], 240.0, 12.0), None);
        }
    }
}
