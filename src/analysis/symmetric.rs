//! Placeholder of the analytic 1-1-1 motion.

use crate::model::System;

/// State at phase 0 on the nudged stable-branch 1-1-1 motion, where it exists and is physical; non-dimensional.
pub fn symmetric_start(_system: &System) -> Option<[f64; 4]> {
    None
}
