//! Numbers of a plane's cells, by a colour bar.

mod bar;
mod palette;

pub use palette::{Palette, PaletteError};

pub(super) use picture::draw_numbers;

mod picture;
