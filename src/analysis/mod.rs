//! What a trajectory is: regimes and labels, settling, Lyapunov exponents, the analytic 1-1-1 motion.

mod exponent;
mod observer;
mod quiet;
mod recurrence;
mod regime;
mod schedule;
mod spread;
mod symmetric;

pub use observer::Observer;
pub use regime::{INFINITELY_MANY, Regime, Verdict};
pub use schedule::{Schedule, ScheduleError};
pub use symmetric::{SymmetricMotion, symmetric_motions, symmetric_start};
