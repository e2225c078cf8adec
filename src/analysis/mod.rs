//! What a trajectory is: regimes and labels, settling, Lyapunov exponents.

mod abreast;
mod beginning;
mod deciding;
mod exponent;
mod extent;
mod going_on;
mod leap;
mod loss;
mod observation;
mod observer;
mod observing;
mod probe;
mod queue;
mod quiet;
mod rebounds;
mod recurrence;
mod regime;
mod regime_codes;
mod schedule;
mod section;
mod side;
mod spread;
mod stage;
mod trace;
mod turn;
mod unseen;
mod verdict;

pub use abreast::follow_abreast;
pub(crate) use deciding::Evidence;
pub(crate) use exponent::Exponent;
pub use extent::{Extent, ExtentObserver};
pub(crate) use loss::Loss;
pub use observer::Observer;
pub use probe::Probe;
pub use queue::{Queue, Seat};
pub use rebounds::{CHATTER_RUN, Rebounds};
pub use regime::{Counts, INFINITELY_MANY, Measures, Regime, Verdict, motion_label};
pub(crate) use regime_codes::regime_codes;
pub use schedule::{Schedule, ScheduleError};
pub use section::{Reading, Section, SectionError};
pub(crate) use spread::Spread;
pub use stage::Stage;
pub use trace::{Trace, Tracer};
pub(crate) use turn::reported;

/// The numbers that the GPU's shaders share.
pub(crate) mod constants {
    pub use super::abreast::{CLEAR_STEPS, HELD_STEPS, ROUNDS, TURNS};
    pub use super::deciding::{CHAOTIC_GROWTH, NEUTRAL_GROWTH, PLAIN_GROWTH, SIGNIFICANCE};
    pub use super::exponent::{ALIGNING, BATCHES};
    pub use super::leap::{LEFT_BY_LEAP, LONGEST_LEAP};
    pub use super::observation::{BRIEF, NEUTRAL_RATE, SETTLED_OBSERVATION, SETTLED_TURNS};
    pub use super::observer::MOST_LEAPS;
    pub use super::observing::{FOLLOWING, PROOF_SHARE, RETURNED, SETTLING, SETTLING_AT_REST};
    pub use super::recurrence::{DISTINCT, FARTHEST, LEAST_RETURNS, NEARER, PATIENCE_SHARE, QUICKLY};
    pub use super::spread::STATIONARY;
    pub use super::turn::{EXPLODES, FORGETS, SQUARINGS};
    pub use crate::dynamics::constants::{FAIR_MOVES, MOST_MOVES};
}
