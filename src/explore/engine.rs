//! The one worker that computes tiles: those that are wanted most, a batch at a time, and none that is out of sight on every page.

use std::collections::{HashMap, VecDeque};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

use super::batch::{self, Batch};
use super::lattice::TileKey;
use super::layer::needs_extents;
use super::outbox::Page;
use super::reply::Outgoing;
use super::scene::Scene;
use super::store::Tiles;
use crate::plane::fields::Layer;

/// How long a batch should take.
const BATCH: Duration = Duration::from_millis(220);
/// How long tiles wait for the answer to a click.
const WAIT: Duration = Duration::from_millis(1500);

/// A handle to the worker, by which pages ask for tiles.
#[derive(Clone, Debug)]
pub struct Engine {
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
    tiles: Arc<Tiles>,
    /// Answers to clicks that are being computed.
    urgent: AtomicUsize,
    ended: AtomicBool,
}

#[derive(Debug, Default)]
struct State {
    wanted: HashMap<u64, Wanted>,
    /// The pages in the order in which they are served.
    turns: VecDeque<u64>,
    running: Option<Running>,
}

#[derive(Debug)]
struct Wanted {
    scene: Arc<Scene>,
    layer: Option<Layer>,
    tiles: VecDeque<TileKey>,
    page: Page,
    /// How many motions of the scene the page knows.
    told: HashMap<u32, usize>,
}

#[derive(Debug)]
struct Running {
    page: u64,
    scene: u32,
    tiles: Vec<TileKey>,
    /// Whether they are measured for a layer, too.
    measures: bool,
    cancelled: Arc<AtomicBool>,
}

/// What is computed next.
#[derive(Debug)]
struct Next {
    scene: Arc<Scene>,
    layer: Option<Layer>,
    page: Page,
    id: u64,
    keys: Vec<TileKey>,
    cancelled: Arc<AtomicBool>,
}

impl Engine {
    /// Starts the worker.
    pub fn start(tiles: Arc<Tiles>) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            state: Mutex::default(),
            changed: Condvar::new(),
            tiles,
            urgent: AtomicUsize::new(0),
            ended: AtomicBool::new(false),
        });
        let worker = shared.clone();
        thread::Builder::new().name("tiles".into()).spawn(move || worker.work())?;
        Ok(Engine { shared })
    }

    /// The tiles that were computed.
    pub fn tiles(&self) -> &Arc<Tiles> {
        &self.shared.tiles
    }

    /// Replaces what a page wants, those first that it wants first; what it does not want any more is given up.
    ///
    /// Tiles carry the numbers of `layer`.
    pub fn want(&self, page: u64, to: &Page, scene: &Arc<Scene>, layer: Option<Layer>, tiles: Vec<TileKey>) {
        let mut state = self.shared.state.lock();
        if let Some(running) = &state.running
            && running.page == page
            && (running.scene != scene.id || !running.tiles.iter().any(|key| tiles.contains(key)))
        {
            running.cancelled.store(true, Ordering::Relaxed);
        }
        // What is just being computed comes anyway.
        let under_way = |key: &TileKey| {
            state.running.as_ref().is_some_and(|running| {
                running.page == page
                    && running.scene == scene.id
                    && !running.cancelled.load(Ordering::Relaxed)
                    && (running.measures || !needs_extents(layer))
                    && running.tiles.contains(key)
            })
        };
        let tiles: VecDeque<TileKey> = tiles.into_iter().filter(|key| !under_way(key)).collect();
        let told = state.wanted.remove(&page).map(|wanted| wanted.told).unwrap_or_default();
        state.wanted.insert(page, Wanted { scene: scene.clone(), layer, tiles, page: to.clone(), told });
        if !state.turns.contains(&page) {
            state.turns.push_back(page);
        }
        drop(state);
        self.shared.changed.notify_all();
    }

    /// Forgets a page that is gone.
    pub fn leave(&self, page: u64) {
        let mut state = self.shared.state.lock();
        state.wanted.remove(&page);
        state.turns.retain(|&other| other != page);
        if let Some(running) = state.running.as_ref().filter(|running| running.page == page) {
            running.cancelled.store(true, Ordering::Relaxed);
        }
    }

    /// Tiles wait while the answer to a click is computed, until the guard is dropped.
    pub fn urgent(&self) -> Urgent {
        self.shared.urgent.fetch_add(1, Ordering::Relaxed);
        Urgent(self.shared.clone())
    }

    /// Ends the worker, and what it computes.
    pub fn end(&self) {
        self.shared.ended.store(true, Ordering::Relaxed);
        if let Some(running) = &self.shared.state.lock().running {
            running.cancelled.store(true, Ordering::Relaxed);
        }
        self.shared.changed.notify_all();
    }
}

/// Keeps tiles waiting; see [`Engine::urgent`].
#[derive(Debug)]
pub struct Urgent(Arc<Shared>);

impl Drop for Urgent {
    fn drop(&mut self) {
        self.0.urgent.fetch_sub(1, Ordering::Relaxed);
        self.0.changed.notify_all();
    }
}

impl Shared {
    fn work(&self) {
        // The tiles of a first, coarse look together.
        let mut per_tile = BATCH / 4;
        while let Some(Next { scene, layer, page, id, keys, cancelled }) = self.next(per_tile) {
            let began = Instant::now();
            let batch =
                Batch { scene: &scene, tiles: &self.tiles, keys: &keys, layer, cancelled: &cancelled };
            let computed = batch::compute(&batch);
            if let (Ok(_), Some(stored)) = (&computed, scene.stored())
                && let Err(error) = stored.keep((scene.id, scene.computing.backend), &self.tiles, &keys)
            {
                let message = format!("{error}; what is computed here is no longer kept in the store");
                let _ = page.send(Outgoing::failed(scene.id, &message));
            }
            let mut state = self.state.lock();
            state.running = None;
            match computed {
                Ok(done) => {
                    let layer = state.wanted.get(&id).and_then(|wanted| wanted.layer);
                    let told =
                        state.wanted.get_mut(&id).map(|wanted| wanted.told.entry(scene.id).or_default());
                    batch::send(&scene, &done, layer, &page, told);
                    if done.computed > 0 {
                        let spent = began.elapsed().div_f64(done.computed as f64);
                        per_tile = (per_tile + spent) / 2;
                    }
                }
                Err(batch::Stopped::Cancelled) => {}
                Err(batch::Stopped::Failed(message)) => {
                    if let Some(wanted) = state.wanted.get_mut(&id) {
                        wanted.tiles.clear();
                    }
                    let _ = page.send(Outgoing::failed(scene.id, &message));
                }
            }
        }
    }

    /// Waits for the next batch; none at the end.
    fn next(&self, per_tile: Duration) -> Option<Next> {
        let mut state = self.state.lock();
        let mut patience = WAIT;
        loop {
            if self.ended.load(Ordering::Relaxed) {
                return None;
            }
            let busy = self.urgent.load(Ordering::Relaxed) > 0 && !patience.is_zero();
            let page = (!busy).then(|| state.turn()).flatten();
            if let Some(id) = page {
                let wanted = state.wanted.get_mut(&id)?;
                let most = wanted.scene.computing.backend.tile() / super::tile_cells();
                let fitting = (BATCH.as_secs_f64() / per_tile.as_secs_f64().max(1e-6)) as usize;
                let count = fitting.clamp(1, most.max(1)).min(wanted.tiles.len());
                let keys: Vec<TileKey> = wanted.tiles.drain(..count).collect();
                let (scene, layer, page) = (wanted.scene.clone(), wanted.layer, wanted.page.clone());
                let cancelled = Arc::new(AtomicBool::new(false));
                state.running = Some(Running {
                    page: id,
                    scene: scene.id,
                    tiles: keys.clone(),
                    measures: needs_extents(layer),
                    cancelled: cancelled.clone(),
                });
                return Some(Next { scene, layer, page, id, keys, cancelled });
            }
            let pause = if busy { Duration::from_millis(50) } else { Duration::from_secs(1) };
            patience = if busy { patience.saturating_sub(pause) } else { WAIT };
            self.changed.wait_for(&mut state, pause);
        }
    }
}

impl State {
    /// The page whose turn it is, if any wants something.
    fn turn(&mut self) -> Option<u64> {
        for _ in 0..self.turns.len() {
            let id = self.turns.pop_front()?;
            self.turns.push_back(id);
            if self.wanted.get(&id).is_some_and(|wanted| !wanted.tiles.is_empty()) {
                return Some(id);
            }
        }
        None
    }
}
