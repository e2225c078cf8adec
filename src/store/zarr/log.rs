//! What every process did with the tiles of a store: a file of lines for each, in the order of the events.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use parking_lot::Mutex;
use serde::{Deserialize, Serialize};

use super::{HIDDEN, StoreError, ZarrStore};

/// Something that happened to a process, or to a tile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", tag = "event")]
pub enum Event {
    /// The process began.
    Begun {
        /// When, in seconds since 1970.
        at: f64,
    },
    /// It came to its end.
    Ended {
        /// When, in seconds since 1970.
        at: f64,
    },
    /// The tile was written.
    Done {
        /// The tile.
        tile: u32,
        /// Its cells.
        cells: u64,
        /// How long computing and writing it took.
        seconds: f64,
        /// When, in seconds since 1970.
        at: f64,
    },
    /// It failed twice.
    Failed {
        /// The tile.
        tile: u32,
        /// Why.
        message: String,
        /// When, in seconds since 1970.
        at: f64,
    },
}

/// Seconds since 1970.
pub(super) fn now() -> f64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |since| since.as_secs_f64())
}

/// The log of one process.
#[derive(Debug)]
pub struct Log {
    file: Mutex<File>,
}

impl Log {
    /// Begins the log of this process in a store.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn begin(store: &ZarrStore) -> Result<Self, StoreError> {
        let name = format!("{:.6}-{}.log", now(), std::process::id());
        let path = store.path.join(HIDDEN).join(name);
        let file = fs::create_dir_all(store.path.join(HIDDEN))
            .and_then(|()| OpenOptions::new().create(true).append(true).open(path));
        let log = file.map(|file| Log { file: Mutex::new(file) }).map_err(|source| store.io(source))?;
        log.note(&Event::Begun { at: now() });
        Ok(log)
    }

    /// Notes that a tile is there.
    pub fn done(&self, tile: u32, cells: u64, seconds: f64) {
        self.note(&Event::Done { tile, cells, seconds, at: now() });
    }

    /// Notes that a tile failed.
    pub fn failed(&self, tile: u32, message: String) {
        self.note(&Event::Failed { tile, message, at: now() });
    }

    /// A line that cannot be written is left out: the tiles tell what is there.
    fn note(&self, event: &Event) {
        let Ok(mut line) = serde_json::to_vec(event) else { return };
        line.push(b'\n');
        let _ = self.file.lock().write_all(&line);
    }
}

impl Drop for Log {
    fn drop(&mut self) {
        self.note(&Event::Ended { at: now() });
    }
}

impl Event {
    /// When it happened, in seconds since 1970.
    pub fn at(&self) -> f64 {
        match *self {
            Event::Begun { at } | Event::Ended { at } | Event::Done { at, .. } | Event::Failed { at, .. } => {
                at
            }
        }
    }
}

/// The events of every process, in its order; lines that were cut off are left out.
pub(super) fn read(store: &Path) -> Vec<Vec<Event>> {
    let Ok(entries) = fs::read_dir(store.join(HIDDEN)) else { return Vec::new() };
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "log"));
    paths.sort();
    let events = |text: String| text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    paths.iter().filter_map(|path| fs::read_to_string(path).ok().map(events)).collect()
}
