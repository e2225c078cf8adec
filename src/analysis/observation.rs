//! An observation: how long it is.

use super::deciding::NEUTRAL_GROWTH;

/// Periods for which a settled trajectory is still observed.
pub const SETTLED_OBSERVATION: u32 = 48;
/// The longest observation turn by turn of what may be on its way still.
pub const BRIEF: u32 = 24;
/// Turns of its own period for which it is observed at least.
pub const SETTLED_TURNS: u32 = 4;
/// The exponent per forcing period below which a motion that is observed turn by turn neither attracts nor repels: over
/// [`SETTLED_OBSERVATION`] it makes a growth of [`NEUTRAL_GROWTH`].
pub const NEUTRAL_RATE: f64 = NEUTRAL_GROWTH / SETTLED_OBSERVATION as f64;

/// An observation that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observation {
    /// Its forcing periods; 0 where none begins.
    pub periods: u32,
    /// The forcing periods of a turn where it is turn by turn, else 0.
    pub turn: u32,
}

impl Observation {
    /// None begins.
    pub const NONE: Self = Observation::over(0);

    /// Period by period.
    pub const fn over(periods: u32) -> Self {
        Observation { periods, turn: 0 }
    }
}
