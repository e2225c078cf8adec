//! Palettes of numbers: maps in which equal steps look equal, from the crate `colorous`.

use std::str::FromStr;

use colorous::Gradient;
use derive_more::Display;
use image::Rgb;
use thiserror::Error;

use super::shapes::Colour;
use super::spread::Spread;

/// The palettes by name; those of two arms go from blue to red, or purple to green, by way of white.
const PALETTES: [(&str, Gradient, bool); 9] = [
    ("viridis", colorous::VIRIDIS, false),
    ("cividis", colorous::CIVIDIS, false),
    ("magma", colorous::MAGMA, false),
    ("inferno", colorous::INFERNO, false),
    ("plasma", colorous::PLASMA, false),
    ("turbo", colorous::TURBO, false),
    ("blue-red", colorous::RED_BLUE, true),
    ("purple-green", colorous::PURPLE_GREEN, false),
    ("brown-green", colorous::BROWN_GREEN, false),
];

/// Cells whose number is beyond the ends of the bar.
const BELOW: Colour = Rgb([0x00, 0xc8, 0xff]);
const ABOVE: Colour = Rgb([0xff, 0x00, 0xc8]);

/// The colours of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
#[display("{}", self.name())]
pub struct Palette(usize);

impl Palette {
    /// The names of all palettes.
    pub fn names() -> [&'static str; 9] {
        PALETTES.map(|(name, ..)| name)
    }

    /// The palette that suits numbers that are spread so.
    pub fn suiting(spread: Spread) -> Self {
        let name = if spread == Spread::AboutZero { "blue-red" } else { "viridis" };
        name.parse().expect("the palette is there")
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        PALETTES[self.0].0
    }

    /// The colour at a share of the way from the least to the greatest number, 0 to 1.
    pub fn colour(self, share: f64) -> Colour {
        let (_, gradient, backwards) = PALETTES[self.0];
        let share = share.clamp(0.0, 1.0);
        let colour = gradient.eval_continuous(if backwards { 1.0 - share } else { share });
        Rgb(colour.into_array())
    }

    /// The colour of what lies below the least number, or above the greatest: no palette ends in either.
    pub fn beyond(above: bool) -> Colour {
        if above { ABOVE } else { BELOW }
    }
}

impl FromStr for Palette {
    type Err = PaletteError;

    fn from_str(text: &str) -> Result<Self, PaletteError> {
        let place = PALETTES.iter().position(|(name, ..)| *name == text);
        place.map(Palette).ok_or_else(|| PaletteError(text.to_owned()))
    }
}

/// A palette that there is not.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no palette `{0}`: choose {known}", known = Palette::names().join(", "))]
pub struct PaletteError(pub String);

#[cfg(test)]
mod tests {
    use super::super::vision::Seen;
    use super::*;

    fn seen(palette: Palette, share: f64) -> Seen {
        Seen::of(palette.colour(share))
    }

    #[test]
    fn numbers_that_differ_by_a_tenth_look_different_to_every_eye() {
        for name in ["viridis", "cividis", "magma", "inferno", "blue-red"] {
            let palette: Palette = name.parse().unwrap();
            for step in 0..10 {
                let (a, b) = (f64::from(step) / 10.0, f64::from(step + 1) / 10.0);
                let apart = seen(palette, a).difference(&seen(palette, b));
                assert!(apart > 3.0, "{name} from {a} to {b}: {apart}");
            }
            let same = seen(palette, 0.5).difference(&seen(palette, 0.501));
            assert!(same < 3.0, "{name}: {same}");
        }
    }

    #[test]
    fn what_is_beyond_the_ends_has_colours_of_its_own() {
        for name in Palette::names() {
            let palette: Palette = name.parse().unwrap();
            for above in [false, true] {
                let beyond = Seen::of(Palette::beyond(above));
                let end = seen(palette, if above { 1.0 } else { 0.0 });
                assert!(beyond.difference(&end) > 10.0, "{name}");
            }
        }
        assert!("rainbow".parse::<Palette>().unwrap_err().to_string().contains("viridis, cividis"));
    }
}
