//! Pictures of what the program computes: planes, diagrams, orbits, curves and control, each a figure.
//!
//! [`region_map`] draws a computed plane, [`diagram_figure`] a bifurcation diagram, [`orbit_figure`] an orbit.

mod axes;
mod colouring;
mod colours;
mod control;
mod convergence;
mod curves;
mod diagram;
#[cfg(test)]
mod example;
mod live;
mod motion;
mod numbers;
mod orbit;
mod places;
mod regions;
mod symbol;
mod symbols;

pub use colours::paint_of;
pub use control::{ControlPicture, Response};
pub use convergence::convergence_map;
pub use curves::{LiveLine, Shown, live_lines};
pub use diagram::diagram_figure;
pub use live::{
    LiveAxis, LiveBar, LiveLegend, LivePart, LiveRow, Word, live_axis, live_bar, live_hatch, live_legend,
    live_title, slice_figure, words,
};
pub use motion::Motion;
pub use orbit::{Orbit, OrbitPanel, PanelError, Variable, Zoom, orbit_figure, orbit_key};
pub use regions::{DrawnCurves, PlanePicture, control_map, region_map, region_map_with_curves};
