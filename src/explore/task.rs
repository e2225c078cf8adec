//! Something that a page asked for and that takes a while: it says how far it is, and can be given up.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use derive_more::From;
use serde::Serialize;

use super::asked::Refused;
use super::batch::Stopped;
use super::outbox::Page;
use super::reply::Outgoing;
use crate::backend::Watch;

/// How often progress is told.
const EVERY: Duration = Duration::from_millis(200);

/// Why a task came to nothing.
#[derive(Clone, Debug, PartialEq, Eq, From)]
pub enum Ended {
    /// The request was cancelled.
    Cancelled,
    /// It cannot be done, and why.
    Refused(Refused),
}

impl From<Stopped> for Ended {
    fn from(stopped: Stopped) -> Self {
        match stopped {
            Stopped::Cancelled => Ended::Cancelled,
            Stopped::Failed(message) => Ended::Refused(super::asked::refused(message)),
        }
    }
}

/// A task under way.
#[derive(Debug)]
pub struct Task {
    ask: u32,
    page: Page,
    cancelled: Arc<AtomicBool>,
    what: &'static str,
    all: u64,
    done: AtomicU64,
    began: Instant,
    /// When progress was told last, in milliseconds from the beginning.
    told: AtomicU64,
}

impl Task {
    /// A task that answers a page's question.
    pub fn new(ask: u32, page: Page, cancelled: Arc<AtomicBool>) -> Self {
        let began = Instant::now();
        let (done, told) = (AtomicU64::new(0), AtomicU64::new(0));
        Task { ask, page, cancelled, what: "", all: 0, done, began, told }
    }

    /// The same task at a step of so many parts.
    #[must_use]
    pub fn at(&self, what: &'static str, all: u64) -> Task {
        let step = Task::new(self.ask, self.page.clone(), self.cancelled.clone());
        let step = Task { what, all, ..step };
        step.tell();
        step
    }

    /// Sends a part of the answer.
    pub fn answer(&self, kind: &str, content: impl Serialize) {
        let _ = self.page.send(Outgoing::answer(kind, self.ask, content));
    }

    /// Sends a file, its name and its type first.
    pub fn file(&self, name: &str, media: &str, content: &[u8]) {
        self.answer("file", serde_json::json!({ "name": name, "media": media }));
        let _ = self.page.send(Outgoing::Bytes(super::tile::file(self.ask, content)));
    }

    /// Says how it ended.
    pub fn end(&self, result: Result<(), Ended>) {
        let last = match result {
            Ok(()) | Err(Ended::Cancelled) => Outgoing::done(self.ask),
            Err(Ended::Refused(refused)) => Outgoing::refused(Some(self.ask), &refused.message, refused.line),
        };
        let _ = self.page.send(last);
    }

    /// Ends here if the request was cancelled.
    ///
    /// # Errors
    /// [`Ended::Cancelled`].
    pub fn check(&self) -> Result<(), Ended> {
        if self.cancelled() { Err(Ended::Cancelled) } else { Ok(()) }
    }

    fn tell(&self) {
        let share = (self.all > 0).then(|| self.done.load(Ordering::Relaxed) as f64 / self.all as f64);
        let _ = self.page.send(Outgoing::progress(self.ask, self.what, share));
    }
}

impl Watch for Task {
    fn finished(&self, cells: u64) {
        self.done.fetch_add(cells, Ordering::Relaxed);
        let now = self.began.elapsed();
        let told = Duration::from_millis(self.told.load(Ordering::Relaxed));
        if now > told + EVERY {
            self.told.store(now.as_millis() as u64, Ordering::Relaxed);
            self.tell();
        }
    }

    fn cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed) || self.page.is_closed()
    }
}
