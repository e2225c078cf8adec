//! Numbers of a plane's cells, by a colour bar.

mod bar;
mod palette;

pub(super) use bar::Bar;
pub use palette::{Palette, PaletteError};

pub(super) use picture::{LOST, UNDEFINED, draw_numbers};

mod picture;
