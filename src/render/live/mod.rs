//! What the pictures decide, for a page that draws them itself: words, ticks, paints, legends and lines.
//!
//! A live plane looks like its picture because both ask here: there is no second palette and no second choice of ticks.

mod axis;
mod bar;
mod legend;
mod slice;
mod words;

pub use axis::{LiveAxis, live_axis, live_title};
pub use bar::{LiveBar, LivePart, live_bar};
pub use legend::{LiveLegend, LiveRow, live_legend};
pub use slice::slice_figure;
pub use words::{Word, words};

use crate::figure::Hatch;

/// The spacing and the thickness of a hatch for a text size, all in pixels: a pixel is hatched where
/// (x + y) mod spacing < thickness.
pub fn live_hatch(em: f64) -> [u32; 2] {
    Hatch::new(em).lengths()
}
