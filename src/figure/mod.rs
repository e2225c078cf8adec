//! Figures, whatever they are of: drawn once as SVG with real text; the same description gives pixels, PDF, and SVG files with
//! their text as outlines.
//!
//! A [`Canvas`] writes SVG, an axis [`Frame`] measures and draws ticks and titles, a [`Legend`] names paints, a [`Figure`] sets
//! plots in rows under a title, and a [`Picture`] is saved as SVG, PNG or PDF. Sizes are in pixels; text and lines scale with
//! the picture, so that a picture of any size prints alike.

mod bar;
mod canvas;
mod carried;
mod font;
mod frame;
pub(crate) mod geometry;
mod ink;
pub(crate) mod labels;
mod legend;
mod number;
mod outlines;
mod paint;
mod palette;
mod pdf;
mod picture;
mod plots;
mod png;
mod scale;
mod shapes;
mod size;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
mod spacing;
mod spread;
mod steps;
mod text;
mod ticks;
mod vision;
mod writing;

pub(crate) use bar::{Bar, WIDTH, draw_samples};
pub use canvas::Canvas;
pub use carried::carried_configuration;
#[cfg(test)]
pub(crate) use font::database;
pub use frame::{AxisTitle, Frame};
pub(crate) use frame::{Placed, TITLE, fitting_ticks, line_width, widest};
pub use ink::css;
pub(crate) use ink::{INK, MUTED, hex};
pub use legend::{Entry, Legend};
pub(crate) use number::number;
pub(crate) use paint::Hatch;
pub use paint::Paint;
pub use palette::{Palette, PaletteError};
pub use picture::{LeftOut, Picture};
pub(crate) use plots::clip;
#[cfg(test)]
pub(crate) use plots::tests::faults;
pub use plots::{Figure, KeyEntry, Mark, Panel, Row, Sample, Stretch, Strip, StripLabel, TooSmall};
pub use scale::Scale;
pub use shapes::{Anchor, Colour, Point, Rect};
pub use size::{Size, SizeError};
pub use spacing::Spacing;
pub use spread::Spread;
pub use steps::Steps;
pub(crate) use text::Style;
pub use text::Text;
pub use ticks::Ticks;
pub(crate) use vision::{DISTINCT, Seen};
