//! How results are marked that have the same bits everywhere.

/// What the description of a back end ends with that gives the same bits on every adapter and on the CPU.
pub const REPRODUCIBLE: &str = ", reproducible";
