//! The colour bar of a layer of numbers.

use serde::Serialize;

use super::css;
use super::words::{Word, words};
use crate::render::convergence::ramp;
use crate::render::frame::{fitting_ticks, widest};
use crate::render::scale::Scale;
use crate::render::text::Text;

/// The colours of a bar.
const COLOURS: u32 = 128;
/// So much of the numbers at either end does not stretch the bar.
const OUTLIERS: f64 = 0.002;

/// A colour bar.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiveBar {
    /// The numbers at its ends.
    pub ends: [f64; 2],
    /// Whether it is one of equal ratios.
    pub log: bool,
    /// Colours of equal shares of it, from the lower end on, as style sheets write them.
    pub colours: Vec<String>,
    /// Labelled ticks: the share of the way from the lower to the upper end, and the label.
    pub ticks: Vec<(f64, String)>,
    /// What the numbers are, in the unit that the labels leave out.
    pub title: Vec<Word>,
}

/// The bar of some numbers, along `length` pixels in letters of `em` pixels; those that are not finite, and on one of equal
/// ratios not positive, are left out. None where nothing is left.
pub fn live_bar(
    title: &str,
    values: impl IntoIterator<Item = f32>,
    log: bool,
    length: f64,
    em: f64,
) -> Option<LiveBar> {
    let mut values: Vec<f64> = values.into_iter().map(f64::from).collect();
    values.retain(|value| value.is_finite() && (!log || *value > 0.0));
    values.sort_by(f64::total_cmp);
    let skipped = (OUTLIERS * values.len() as f64) as usize;
    let (&low, &high) = values.get(skipped).zip(values.get(values.len().checked_sub(1 + skipped)?))?;
    let scale = match (log, low < high) {
        (true, true) => Scale::logarithmic(low, high),
        (true, false) => Scale::logarithmic(low / 2.0, 2.0 * low),
        (false, true) => Scale::new(low, high),
        (false, false) => Scale::around([low], 0.0),
    };
    let ticks = fitting_ticks(scale, length, |ticks| widest(ticks, em) + em);
    let unit = match ticks.exponent {
        0 => Text::from(title),
        power => Text::from(title).upright(" / 10").superscript(power.to_string().replace('-', "−")),
    };
    let shares = (0..COLOURS).map(|i| (f64::from(i) + 0.5) / f64::from(COLOURS));
    Some(LiveBar {
        ends: scale.ends(),
        log,
        colours: shares.map(|share| css(ramp(share))).collect(),
        ticks: ticks.labelled.into_iter().map(|(value, label)| (scale.fraction(value), label)).collect(),
        title: words(&unit),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_spans_its_numbers_without_the_odd_one() {
        let mut values: Vec<f32> = (0..=1000_u16).map(|i| f32::from(i) / 100.0).collect();
        values.extend([f32::NAN, f32::INFINITY, 1e9]);
        let bar = live_bar("a number", values.clone(), false, 200.0, 12.0).unwrap();
        assert!(bar.ends[0] <= 0.05 && (9.9..10.1).contains(&bar.ends[1]), "{:?}", bar.ends);
        assert!(bar.ticks.len() >= 2 && bar.ticks.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(bar.colours.len(), COLOURS as usize);
        assert_ne!(bar.colours[0], bar.colours[127]);
        let ratios = live_bar("a number", values, true, 200.0, 12.0).unwrap();
        assert!(ratios.ends[0] > 0.0);
        assert_eq!(live_bar("nothing", [f32::NAN], false, 200.0, 12.0), None);
        assert!(live_bar("one", [3.0], true, 200.0, 12.0).is_some_and(|bar| bar.ends[0] < bar.ends[1]));
    }
}
