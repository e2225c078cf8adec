//! Pictures: drawn once as SVG with real text; the same description gives pixels, and SVG files with their text as outlines.
//!
//! [`region_map`] draws a computed plane. Everything below it serves any figure: a [`Canvas`] writes SVG, an
//! axis [`Frame`] measures and draws ticks and titles, a [`Legend`] names paints, and a [`Picture`] is saved as
//! SVG or PNG. Sizes are in pixels; text and lines scale with the picture, so that a picture of any size prints
//! alike.

mod canvas;
mod carried;
mod colour_bar;
mod colouring;
mod colours;
mod control;
mod convergence;
mod curves;
mod diagram;
#[cfg(test)]
mod example;
mod figure;
mod font;
mod frame;
mod legend;
mod live;
mod motion;
mod orbit;
mod outlines;
mod paint;
mod pdf;
mod picture;
mod places;
mod png;
mod regions;
mod scale;
mod size;
mod symbols;
mod text;
mod ticks;
mod vision;

pub use canvas::{Anchor, Canvas, Colour, Point, Rect};
pub use carried::carried_configuration;
pub use colour_bar::{Palette, PaletteError};
pub use colours::paint_of;
pub use control::{ControlPicture, Response};
pub use convergence::convergence_map;
pub use curves::Shown;
pub use diagram::diagram_figure;
pub use figure::{Figure, KeyEntry, Mark, Panel, Row, Sample, Stretch, Strip, StripLabel, TooSmall};
pub use frame::{AxisTitle, Frame};
pub use legend::{Entry, Legend};
pub use live::{
    LiveAxis, LiveBar, LiveLegend, LiveLine, LivePart, LiveRow, Word, css, live_axis, live_bar, live_hatch,
    live_legend, live_lines, live_title, slice_figure, words,
};
pub use motion::Motion;
pub use orbit::{Orbit, OrbitPanel, PanelError, Variable, Zoom, orbit_figure, orbit_key};
pub use paint::Paint;
pub use picture::{LeftOut, Picture};
pub use regions::{DrawnCurves, PlanePicture, control_map, region_map, region_map_with_curves};
pub use scale::Scale;
pub use size::{Size, SizeError};
pub use text::Text;
pub use ticks::Ticks;
