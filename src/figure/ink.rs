//! The colours of what is written and ruled.

use image::Rgb;

use super::shapes::Colour;

/// The colour of text and lines.
pub(crate) const INK: Colour = hex(0x1a1a1a);

/// The colour of text of less importance.
pub(crate) const MUTED: Colour = hex(0x5a5a5a);

pub(crate) const fn hex(rgb: u32) -> Colour {
    let [_, r, g, b] = rgb.to_be_bytes();
    Rgb([r, g, b])
}
