//! What pages ask for; the other end is `page/protocol.js`, and both are described in `protocol.md`.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::lattice::{Cell, TileKey, Window};

/// A message from a page. `ask` is a number of the page's choice that every answer carries.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// A plane to look at.
    Open { ask: u32, plane: Box<AskedPlane> },
    /// The tiles that are in sight and not there yet, those first that matter most; whatever was wanted before and is not
    /// among them is given up.
    Want {
        scene: u32,
        tiles: Vec<TileKey>,
        #[serde(default)]
        layer: Option<String>,
    },
    /// The legend of so many cells of each motion.
    Legend { ask: u32, scene: u32, cells: Vec<(u16, u64)>, rows: usize },
    /// Ticks and titles for what is seen: places in cells of level 0, pixels across and up, the size of letters.
    Axes { ask: u32, scene: u32, x: [f64; 2], y: [f64; 2], size: [f64; 2], em: f64 },
    /// The colour bar of a layer of numbers, of what is known of a window.
    Bar { ask: u32, scene: u32, layer: String, window: Window, length: f64, em: f64 },
    /// Everything about one cell.
    Probe { ask: u32, scene: u32, cell: Cell, width: u32 },
    /// The bifurcation curves of a window.
    Curves { ask: u32, scene: u32, window: Window, max_period: u32, all: bool },
    /// The bifurcation diagram along a line between two places in cells of level 0.
    Slice { ask: u32, scene: u32, from: [f64; 2], to: [f64; 2], columns: u32, width: u32 },
    /// A window as a file.
    Save {
        ask: u32,
        scene: u32,
        window: Window,
        format: Format,
        size: [u32; 2],
        curves: Option<u32>,
        #[serde(default)]
        layer: Option<String>,
    },
    /// The command line that makes the figure of a window.
    Command {
        ask: u32,
        scene: u32,
        window: Window,
        size: [u32; 2],
        curves: Option<u32>,
        #[serde(default)]
        layer: Option<String>,
    },
    /// What was asked for is not wanted any more.
    Cancel { ask: u32 },
}

/// A plane as a page asks for it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AskedPlane {
    /// The system.
    pub system: AskedSystem,
    /// The horizontal axis, `NAME=FIRST:LAST:COUNT[:log]`; that of the system where there is none.
    #[serde(default)]
    pub x: Option<String>,
    /// The vertical axis.
    #[serde(default)]
    pub y: Option<String>,
    /// Parameters by their names; those that are not given have the system's defaults.
    #[serde(default)]
    pub set: BTreeMap<String, f64>,
    /// rest, symmetric, or the numbers of a state.
    pub start: String,
    /// Forcing periods before the observation.
    pub transient: u32,
    /// Forcing periods of the observation.
    pub observe: u32,
    /// Largest N looked for.
    pub max_period: u32,
    /// Whether every cell runs all of its periods.
    #[serde(default)]
    pub fixed_periods: bool,
    /// What computes: see [`super::backends::Asked`].
    pub backend: String,
}

/// A system as a page asks for it: one that is known, by its name, or the text of a file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AskedSystem {
    /// One that comes with the program, or the one that it was started with.
    Name(String),
    /// The text of a file.
    Text(String),
}

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// A picture in pixels.
    Png,
    /// A picture in lines.
    Svg,
    /// The data.
    Npz,
}

impl Request {
    /// The number that answers carry, and the plane that it is about.
    pub fn ask(&self) -> (Option<u32>, Option<u32>) {
        match *self {
            Request::Open { ask, .. } | Request::Cancel { ask } => (Some(ask), None),
            Request::Want { scene, .. } => (None, Some(scene)),
            Request::Legend { ask, scene, .. }
            | Request::Axes { ask, scene, .. }
            | Request::Bar { ask, scene, .. }
            | Request::Probe { ask, scene, .. }
            | Request::Curves { ask, scene, .. }
            | Request::Slice { ask, scene, .. }
            | Request::Save { ask, scene, .. }
            | Request::Command { ask, scene, .. } => (Some(ask), Some(scene)),
        }
    }
}
