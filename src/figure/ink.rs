//! The colours of what is written and ruled.

use image::Rgb;

use super::shapes::Colour;

/// The colour of text and lines.
pub(crate) const INK: Colour = hex(0x1a1a1a);

/// The colour of text of less importance.
pub(crate) const MUTED: Colour = hex(0x5a5a5a);

/// A colour as style sheets write it.
pub fn css(Rgb([r, g, b]): Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

pub(crate) const fn hex(rgb: u32) -> Colour {
    let [_, r, g, b] = rgb.to_be_bytes();
    Rgb([r, g, b])
}
