//! What all pages share: the planes that are open, and the worker that computes their tiles.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, AtomicUsize, Ordering};

use parking_lot::Mutex;

use super::asked::{Refused, because, check, family, plane, refused};
use super::backends::{self, Asked, Computing};
use super::engine::Engine;
use super::known::Known;
use super::limits;
use super::request::AskedPlane;
use super::scene::Scene;
use super::store::Tiles;
use crate::plane::Plane;
use crate::system::Family;

/// What all pages share.
#[derive(Debug)]
pub struct Served {
    /// The worker.
    pub engine: Engine,
    /// The plane that pages begin with.
    pub first: Plane,
    /// What computes it unless a page asks for something else.
    pub computing: Computing,
    known: Option<Arc<Known>>,
    scenes: Mutex<VecDeque<Arc<Scene>>>,
    next_scene: AtomicU32,
    next_page: AtomicU64,
    pages: AtomicUsize,
}

/// A page among those that are connected.
#[derive(Debug)]
pub struct Place {
    /// Its number.
    pub id: u64,
    served: Arc<Served>,
}

impl Drop for Place {
    fn drop(&mut self) {
        self.served.engine.leave(self.id);
        self.served.pages.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Served {
    /// What pages begin with: a plane and what computes it, and where it was computed before, its cells.
    ///
    /// # Errors
    /// A thread that the machine does not give.
    pub fn new(first: Plane, computing: Computing, known: Option<Known>) -> std::io::Result<Arc<Self>> {
        Ok(Arc::new(Served {
            engine: Engine::start(Arc::new(Tiles::default()))?,
            first,
            computing,
            known: known.map(Arc::new),
            scenes: Mutex::default(),
            next_scene: AtomicU32::new(1),
            next_page: AtomicU64::new(1),
            pages: AtomicUsize::new(0),
        }))
    }

    /// The system that the program was started with.
    pub fn own(&self) -> &'static Family {
        self.first.parameters.family()
    }

    /// A place for a page, if there is one.
    pub fn place(self: &Arc<Self>) -> Option<Place> {
        if self.pages.fetch_add(1, Ordering::Relaxed) >= limits::CONNECTIONS {
            self.pages.fetch_sub(1, Ordering::Relaxed);
            return None;
        }
        Some(Place { id: self.next_page.fetch_add(1, Ordering::Relaxed), served: self.clone() })
    }

    /// Opens a plane, or finds it open.
    ///
    /// # Errors
    /// [`Refused`] with what cannot be used.
    pub fn open(&self, asked: &AskedPlane) -> Result<Arc<Scene>, Refused> {
        let family = family(&asked.system, self.own())?;
        let plane = plane(asked, family)?;
        check(&plane)?;
        let backend = Asked::read(&asked.backend)
            .ok_or_else(|| refused("this machine has no such back end: choose one of the list"))?;
        let same = |scene: &Arc<Scene>| scene.plane == plane && scene.computing.asked == backend;
        if let Some(scene) = self.found(same) {
            return Ok(scene);
        }
        let computing = backends::open(backend).map_err(because)?;
        // The cells of a file are shown whatever computes the others.
        let known = self.known.clone().filter(|known| *known.plane() == plane);
        let id = self.next_scene.fetch_add(1, Ordering::Relaxed);
        let scene = Arc::new(Scene::new(id, plane, computing, known));
        let mut scenes = self.scenes.lock();
        scenes.push_back(scene.clone());
        // What a page shows is kept: it would have to be opened again.
        let is_shown = |scene: &Arc<Scene>| Arc::strong_count(scene) > 1;
        while scenes.len() > limits::SCENES
            && let Some(at) = scenes.iter().position(|scene| !is_shown(scene))
            && let Some(oldest) = scenes.remove(at)
        {
            self.engine.tiles().forget(oldest.id);
        }
        Ok(scene)
    }

    /// A plane that is open.
    ///
    /// # Errors
    /// [`Refused`] where it is not, or not any more.
    pub fn scene(&self, id: u32) -> Result<Arc<Scene>, Refused> {
        self.found(|scene| scene.id == id)
            .ok_or_else(|| refused("this plane is not open any more: open it again"))
    }

    /// An open plane, which becomes the one that is kept longest.
    fn found(&self, wanted: impl Fn(&Arc<Scene>) -> bool) -> Option<Arc<Scene>> {
        let mut scenes = self.scenes.lock();
        let at = scenes.iter().position(wanted)?;
        let scene = scenes.remove(at)?;
        scenes.push_back(scene.clone());
        Some(scene)
    }
}
