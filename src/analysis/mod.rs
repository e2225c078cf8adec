//! What a trajectory is: regimes and labels, settling, Lyapunov exponents, the analytic 1-1-1 motion.

mod regime;
mod schedule;
mod symmetric;

pub use regime::{INFINITELY_MANY, Regime, Verdict};
pub use schedule::{Schedule, ScheduleError};
pub use symmetric::symmetric_start;
