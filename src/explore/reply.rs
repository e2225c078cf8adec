//! What pages are told; the other end is `page/protocol.js`, and both are described in `protocol.md`.

use serde::Serialize;
use serde_json::{Value, json};

use crate::analysis::{Regime, Verdict};
use crate::figure::css;
use crate::render::{Motion, paint_of};

/// A message to a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Outgoing {
    /// JSON.
    Text(String),
    /// A tile or a file.
    Bytes(Vec<u8>),
}

impl Outgoing {
    /// An answer of a type, with the number of its question.
    pub fn answer(kind: &str, ask: u32, content: impl Serialize) -> Self {
        Outgoing::of(json!({ "type": kind, "ask": ask, "content": content }))
    }

    /// A message of its own.
    pub fn of(value: Value) -> Self {
        Outgoing::Text(value.to_string())
    }

    /// Nothing is done, and why; `line` is the line of a system's text that is at fault.
    pub fn refused(ask: Option<u32>, message: &str, line: Option<usize>) -> Self {
        Outgoing::of(json!({ "type": "refused", "ask": ask, "message": message, "line": line }))
    }

    /// How far something is, in words and, where that is known, as a share.
    pub fn progress(ask: u32, what: &str, share: Option<f64>) -> Self {
        Outgoing::of(json!({ "type": "progress", "ask": ask, "what": what, "share": share }))
    }

    /// Everything that was asked for has been sent.
    pub fn done(ask: u32) -> Self {
        Outgoing::of(json!({ "type": "done", "ask": ask }))
    }

    /// The tiles of a plane cannot be computed.
    pub fn failed(scene: u32, message: &str) -> Self {
        Outgoing::of(json!({ "type": "failed", "scene": scene, "message": message }))
    }

    /// Motions of a plane by their numbers, from `first` on: what they are called, their paints while nothing else is to be told
    /// from them, and whether a motion begins there at all; `mirrored` says whether systems have a mirror.
    pub fn motions(scene: u32, first: usize, motions: &[Verdict], mirrored: bool) -> Self {
        let told: Vec<Value> = motions
            .iter()
            .map(|verdict| {
                let paint = paint_of(Motion::of(verdict));
                json!({
                    "name": Motion::name(verdict, mirrored),
                    "paint": [css(paint.fill), paint.hatch.map(css)],
                    "begins": verdict.regime != Regime::Inadmissible,
                })
            })
            .collect();
        Outgoing::of(json!({ "type": "motions", "scene": scene, "first": first, "motions": told }))
    }
}
