//! The bifurcation diagram along a line through a plane.

use serde_json::json;

use super::asked::{because, refused};
use super::limits;
use super::scene::Scene;
use super::task::{Ended, Task};
use crate::analysis::{Probe, Reading, Section};
use crate::backend::{BackendError, Job, Watch};
use crate::diagram::{Branch, Diagram, DiagramSpec, Direction, Sweep, SweepAxis};
use crate::plane::Axis;
use crate::render::slice_figure;
use crate::sweep::provenance;
use crate::theory::confirmed;

/// Forcing periods for which a column is observed.
const OBSERVE: u32 = 150;
/// Forcing periods before that.
const TRANSIENT: u32 = 300;
/// The size of letters in pixels.
const EM: f64 = 12.5;
/// Points kept of a column.
const POINTS: u32 = 4 * OBSERVE;

/// Sends the diagram along a line between two places, in cells of level 0; columns begin as the plane's cells do.
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
    let plane = &scene.plane;
    if !(2..=limits::SLICE_COLUMNS).contains(&columns) {
        return Err(refused(format!("{columns} columns: give 2 to {}", limits::SLICE_COLUMNS)).into());
    }
    let axes = [plane.x, plane.y];
    let reach = |k: usize| (to[k] - from[k]).abs() / f64::from(axes[k].count);
    if !from.iter().chain(&to).all(|at| at.is_finite()) || reach(0).max(reach(1)) < 1e-9 {
        return Err(refused("the line has no length: drag it from one place to another").into());
    }
    let (over, other) = if reach(0) >= reach(1) { (0, 1) } else { (1, 0) };
    let share = |i: u32| f64::from(i) / f64::from(columns - 1);
    let at = |k: usize, i: u32| axes[k].at(from[k] + share(i) * (to[k] - from[k]));
    let Axis { quantity, spacing, .. } = axes[over];
    let axis =
        Axis::spaced(quantity, at(over, 0), at(over, columns - 1), columns, spacing).map_err(because)?;
    let jobs: Vec<Job> = (0..columns)
        .map(|i| match over {
            0 => scene.job_at(axis.value(i), at(1, i)),
            _ => scene.job_at(at(0, i), axis.value(i)),
        })
        .collect::<Option<_>>()
        .ok_or_else(|| refused("a part of the line has no such system: keep it off the edge"))?;
    let spec = DiagramSpec {
        x: SweepAxis::from(axis),
        parameters: plane.parameters,
        sweep: Sweep::Each(plane.start),
        start: plane.start,
        probe: Probe::new(Section::A, Reading::VBefore).map_err(because)?,
        schedule: DiagramSpec::schedule(TRANSIENT, OBSERVE, plane.schedule.max_period),
        capacity: POINTS,
        spectrum: None,
    };
    let watch = task.at("computing the diagram", u64::from(columns));
    let backend = scene.computing.backend;
    let mut traces = Vec::with_capacity(jobs.len());
    for some in jobs.chunks(backend.tile().max(1)) {
        let traced = backend.trace(some, &spec.schedule, spec.probe, spec.capacity, &watch);
        traces.extend(traced.map_err(|error| match error {
            BackendError::Cancelled => Ended::Cancelled,
            error => because(error).into(),
        })?);
    }
    for (trace, job) in traces.iter_mut().zip(&jobs) {
        trace.verdict = confirmed(&job.system, &trace.verdict).unwrap_or(trace.verdict);
    }
    if watch.cancelled() {
        return Err(Ended::Cancelled);
    }
    let branches = vec![Branch { direction: Direction::Each, traces, spectrum: None }];
    let diagram = Diagram { spec, provenance: provenance(backend), branches };
    let ends = [at(other, 0), at(other, columns - 1)];
    let mut figure = slice_figure(&diagram, axes[other].quantity, ends);
    let width = width.clamp(360, 2400);
    // Letters of the page's own size.
    figure.width = (f64::from(width) / EM).max(30.0);
    let size = super::figures::figure_size([width, (width * 3 / 8).clamp(340, 460)])?;
    match figure.draw(size, &diagram.config()) {
        Ok(picture) => task.answer("slice", json!({ "svg": picture.svg() })),
        Err(error) => return Err(because(error).into()),
    }
    Ok(())
}
