//! One page: what it asks for, one message after the other.

use std::collections::HashMap;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use parking_lot::Mutex;
use serde_json::json;

use super::asked::{Refused, refused};
use super::lattice::Cell;
use super::layer::{bar, named};
use super::outbox::Page;
use super::probe::probe;
use super::reply::Outgoing;
use super::request::Request;
use super::scene::Scene;
use super::served::{Place, Served};
use super::task::{Ended, Task};
use super::{command, describe, figures, limits, slice};
use crate::plane::Axis;
use crate::render::{Motion, live_axis, live_hatch, live_legend};

/// One page that is connected.
#[derive(Debug)]
pub struct Session {
    served: Arc<Served>,
    place: Place,
    page: Page,
    tasks: Tasks,
    /// The plane that the page opened last.
    shown: Mutex<Option<Arc<Scene>>>,
}

/// What is done for a page, by the number of its question.
type Tasks = Arc<Mutex<HashMap<u32, Arc<AtomicBool>>>>;

impl Session {
    /// A page that has just come, which is told what there is.
    pub fn begin(served: &Arc<Served>, place: Place, page: Page) -> Self {
        let hello = describe::hello(&served.first, &served.computing.asked.name(), served.own());
        let _ = page.send(Outgoing::of(hello));
        Session { served: served.clone(), place, page, tasks: Tasks::default(), shown: Mutex::default() }
    }

    /// Does what a message asks for, or begins to.
    pub fn hear(&self, text: &str) {
        let request: Request = match serde_json::from_str(text) {
            Ok(request) => request,
            Err(error) => {
                return self.refuse(None, &refused(format!("the message is not understood: {error}")));
            }
        };
        let (ask, scene) = request.ask();
        let done = match scene.map(|id| self.served.scene(id)).transpose() {
            Ok(scene) => self.answer(request, scene),
            Err(refused) => Err(refused),
        };
        if let Err(refused) = done {
            self.refuse(ask, &refused);
        }
    }

    fn refuse(&self, ask: Option<u32>, refused: &Refused) {
        let _ = self.page.send(Outgoing::refused(ask, &refused.message, refused.line));
    }

    fn reply(&self, kind: &str, ask: u32, content: impl serde::Serialize) {
        let _ = self.page.send(Outgoing::answer(kind, ask, content));
    }

    fn answer(&self, request: Request, scene: Option<Arc<Scene>>) -> Result<(), Refused> {
        let served = self.served.clone();
        match (request, scene) {
            (Request::Open { ask, plane }, _) => {
                let scene = served.open(&plane)?;
                self.reply("scene", ask, describe::scene(&scene, served.own()));
                *self.shown.lock() = Some(scene);
            }
            (Request::Cancel { ask }, _) => {
                if let Some(flag) = self.tasks.lock().get(&ask) {
                    flag.store(true, Ordering::Relaxed);
                }
            }
            (Request::Want { tiles, layer, .. }, Some(scene)) => {
                if tiles.len() > limits::WANTED || !tiles.iter().all(|key| key.is_near()) {
                    return Err(refused(format!(
                        "{} tiles, or some that are too far away: want at most {} at a time",
                        tiles.len(),
                        limits::WANTED
                    )));
                }
                let layer = named(layer.as_deref(), scene.plane.parameters.family())?;
                served.engine.want(self.place.id, &self.page, &scene, layer, tiles);
            }
            (Request::Legend { ask, cells, rows, .. }, Some(scene)) => {
                self.reply("legend", ask, legend(&scene, &cells, rows)?);
            }
            (Request::Axes { ask, x, y, size, em, .. }, Some(scene)) => {
                self.reply("axes", ask, axes(&scene, [x, y], size, em)?);
            }
            (Request::Command { ask, window, size, curves, layer, .. }, Some(scene)) => {
                let layer = named(layer.as_deref(), scene.plane.parameters.family())?;
                if !window.is_near() {
                    return Err(refused("this window is empty or too far away"));
                }
                let plane = window.plane(&scene.plane).map_err(super::asked::because)?;
                let mut text = command::map(&plane, scene.computing.asked, size, curves, layer);
                if scene.is_certified(window.z) {
                    text += " --certify";
                }
                self.reply("command", ask, json!({ "text": text }));
            }
            (Request::Bar { ask, layer, window, length, em, .. }, Some(scene)) => {
                self.reply("bar", ask, bar(&scene, served.engine.tiles(), &layer, &window, length, em)?);
            }
            (Request::Probe { ask, cell, width, .. }, Some(scene)) => {
                if !Cell::is_near(cell) {
                    return Err(refused("this cell is too far away"));
                }
                self.begin_task(ask, true, move |task| {
                    probe(&scene, served.engine.tiles(), cell, width, task)
                })?;
            }
            (Request::Curves { ask, window, max_period, all, .. }, Some(scene)) => {
                self.begin_task(ask, false, move |task| {
                    figures::curves(&scene, served.engine.tiles(), &window, max_period, all, task)
                })?;
            }
            (Request::Slice { ask, from, to, columns, width, .. }, Some(scene)) => {
                self.begin_task(ask, true, move |task| slice::slice(&scene, from, to, columns, width, task))?;
            }
            (Request::Save { ask, window, format, size, curves, layer, .. }, Some(scene)) => {
                let layer = named(layer.as_deref(), scene.plane.parameters.family())?;
                let drawn = figures::Wanted { format, size, curves, layer };
                self.begin_task(ask, false, move |task| {
                    figures::save(&scene, served.engine.tiles(), &window, drawn, task)
                })?;
            }
            (_, None) => return Err(refused("open a plane first")),
        }
        Ok(())
    }

    /// Begins something on a thread of its own; `urgent` keeps tiles waiting meanwhile.
    fn begin_task(
        &self,
        ask: u32,
        urgent: bool,
        work: impl FnOnce(&Task) -> Result<(), Ended> + Send + 'static,
    ) -> Result<(), Refused> {
        let cancelled = Arc::new(AtomicBool::new(false));
        {
            let mut tasks = self.tasks.lock();
            if tasks.len() >= limits::TASKS {
                return Err(refused("too much is under way: wait for something, or give it up"));
            }
            if tasks.insert(ask, cancelled.clone()).is_some() {
                return Err(refused("this number is in use"));
            }
        }
        let task = Task::new(ask, self.page.clone(), cancelled);
        let (tasks, engine) = (self.tasks.clone(), self.served.engine.clone());
        let run = move || {
            let urgent = urgent.then(|| engine.urgent());
            let done = panic::catch_unwind(AssertUnwindSafe(|| work(&task)));
            drop(urgent);
            tasks.lock().remove(&ask);
            task.end(done.unwrap_or_else(|_| {
                Err(refused("internal error: a mistake in the program; please report it").into())
            }));
        };
        let begun = thread::Builder::new().name("task".into()).spawn(run);
        begun.map(drop).map_err(|error| refused(format!("the machine gives no thread: {error}")))
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        for flag in self.tasks.lock().values() {
            flag.store(true, Ordering::Relaxed);
        }
    }
}

/// The legend of so many cells of each motion.
fn legend(scene: &Scene, cells: &[(u16, u64)], rows: usize) -> Result<serde_json::Value, Refused> {
    if cells.len() > limits::MOTIONS {
        return Err(refused("too many motions"));
    }
    let known =
        |&(number, count): &(u16, u64)| Some((Motion::of(&scene.motion(number)?), count.min(1 << 40)));
    let found: Option<Vec<_>> = cells.iter().map(known).collect();
    let found = found.ok_or_else(|| refused("there is no such motion on this plane"))?;
    Ok(json!(live_legend(
        scene.plane.parameters.family(),
        scene.plane.has_mirror(),
        &found,
        rows.min(limits::LEGEND_ROWS)
    )))
}

/// Ticks and titles of what is seen, with places in cells of level 0.
fn axes(scene: &Scene, [x, y]: [[f64; 2]; 2], size: [f64; 2], em: f64) -> Result<serde_json::Value, Refused> {
    let sane = size.iter().all(|length| (20.0..=20_000.0).contains(length)) && (4.0..=100.0).contains(&em);
    let side = |axis: &Axis, [from, to]: [f64; 2], length: f64, across: bool| {
        let ends = [axis.at(from), axis.at(to)];
        let apart = ends.iter().all(|end| end.is_finite() && end.abs() < 1e280)
            && (ends[1] - ends[0]).abs() > 1e-13 * ends[0].abs().max(ends[1].abs());
        let positive = axis.spacing.is_linear() || ends[0].min(ends[1]) > 0.0;
        if !sane || !apart || !positive {
            return Err(refused("these sides cannot be drawn"));
        }
        let drawn = live_axis(axis.quantity, ends, axis.spacing, length, em, across);
        let labelled: Vec<_> =
            drawn.labelled.into_iter().map(|(value, label)| (axis.place(value), label)).collect();
        let minor: Vec<f64> = drawn.minor.into_iter().map(|value| axis.place(value)).collect();
        Ok(json!({ "labelled": labelled, "minor": minor, "title": drawn.title }))
    };
    Ok(json!({
        "x": side(&scene.plane.x, x, size[0], true)?,
        "y": side(&scene.plane.y, y, size[1], false)?,
        "hatch": live_hatch(em),
    }))
}
