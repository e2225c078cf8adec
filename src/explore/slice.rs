//! The bifurcation diagram along a line through a plane.

use serde_json::json;

use super::asked::{Refused, because, refused};
use super::figures::figure_size;
use super::limits;
use super::scene::Scene;
use super::task::{Ended, Task};
use crate::analysis::{Probe, Reading, Section};
use crate::backend::{BackendError, Watch};
use crate::diagram::{Branch, Diagram, DiagramSpec, Direction, Sweep};
use crate::plane::{Axis, Quantity};
use crate::render::slice_figure;
use crate::sweep::{Begun, SweepError, provenance, traces};

/// Forcing periods for which a column is observed.
const OBSERVE: u32 = 150;
/// Forcing periods before that.
const TRANSIENT: u32 = 300;
/// The size of letters in pixels.
const EM: f64 = 12.5;
/// Points kept of a column.
const POINTS: u32 = 4 * OBSERVE;

/// A line through a plane: the axis along which it reaches farther, and what is followed in every column.
struct Line {
    axis: Axis,
    /// What the other axis has at both ends.
    other: (Quantity, [f64; 2]),
    begun: Vec<Begun>,
}

impl Line {
    /// The line between two places, in cells of level 0.
    fn between(scene: &Scene, from: [f64; 2], to: [f64; 2], columns: u32) -> Result<Line, Refused> {
        if !(2..=limits::SLICE_COLUMNS).contains(&columns) {
            return Err(refused(format!("{columns} columns: give 2 to {}", limits::SLICE_COLUMNS)));
        }
        let axes = [scene.plane.x, scene.plane.y];
        let reach = |k: usize| (to[k] - from[k]).abs() / f64::from(axes[k].count);
        if !from.iter().chain(&to).all(|at| at.is_finite()) || reach(0).max(reach(1)) < 1e-9 {
            return Err(refused("the line has no length: draw it from one place to another"));
        }
        let (over, other) = if reach(0) >= reach(1) { (0, 1) } else { (1, 0) };
        let share = |i: u32| f64::from(i) / f64::from(columns - 1);
        let at = |k: usize, i: u32| axes[k].at(from[k] + share(i) * (to[k] - from[k]));
        let (quantity, ends) = (axes[over].quantity, [0, columns - 1].map(|i| at(over, i)));
        let axis = Axis::spaced(quantity, ends[0], ends[1], columns, axes[over].spacing);
        let axis = axis.map_err(because)?;
        let job = |i: u32| match over {
            0 => scene.job_at(axis.value(i), at(1, i)),
            _ => scene.job_at(at(0, i), axis.value(i)),
        };
        let begun: Option<Vec<Begun>> = (0..columns).map(job).collect();
        let nowhere = || refused("a part of the line has no such system: keep it off the edge");
        let begun = begun.ok_or_else(nowhere)?;
        if begun.iter().all(Result::is_err) {
            return Err(refused("the whole line begins beyond a stop: draw it where motions begin"));
        }
        let ends = [at(other, 0), at(other, columns - 1)];
        Ok(Line { axis, other: (axes[other].quantity, ends), begun })
    }

    /// The diagram of its columns, which begin as the plane's cells do.
    fn diagram(self, scene: &Scene, task: &Task) -> Result<Diagram, Ended> {
        let plane = &scene.plane;
        let spec = DiagramSpec {
            x: self.axis,
            parameters: plane.parameters,
            sweep: Sweep::Each(plane.start),
            start: plane.start,
            probe: Probe::new(Section::A, Reading::VBefore).map_err(because)?,
            schedule: DiagramSpec::schedule(TRANSIENT, OBSERVE, plane.task.max_period),
            capacity: POINTS,
            spectrum: None,
        };
        let watch = task.at("computing the diagram", self.begun.len() as u64);
        let backend = scene.computing.backend;
        let traces = traces(self.begun, &spec, backend, &watch).map_err(|error| match error {
            SweepError::Backend(BackendError::Cancelled) => Ended::Cancelled,
            error => because(error).into(),
        })?;
        if watch.cancelled() {
            return Err(Ended::Cancelled);
        }
        let branches = vec![Branch { direction: Direction::Each, traces, spectrum: None }];
        Ok(Diagram { spec, provenance: provenance(backend), branches })
    }
}

/// Sends the diagram along a line between two places, in cells of level 0.
///
/// It is drawn over the axis along which the line reaches farther.
///
/// # Errors
/// [`Ended`].
pub fn slice(
    scene: &Scene,
    from: [f64; 2],
    to: [f64; 2],
    columns: u32,
    width: u32,
    task: &Task,
) -> Result<(), Ended> {
    let line = Line::between(scene, from, to, columns)?;
    let other = line.other;
    let diagram = line.diagram(scene, task)?;
    let mut figure = slice_figure(&diagram, other.0, other.1);
    let width = width.clamp(360, 2400);
    // The text size of the page.
    figure.width = (f64::from(width) / EM).max(30.0);
    let config = diagram.config();
    let drawn = figure.draw(figure_size([width, (width * 3 / 8).clamp(340, 460)])?, &config);
    let drawn = match drawn {
        Err(small) => figure.draw(figure_size([small.least_width, small.least_height])?, &config),
        drawn => drawn,
    };
    task.answer("slice", json!({ "svg": drawn.map_err(because)?.svg() }));
    Ok(())
}
