//! A brute-force oracle for the oscillator, independent of the crate's own mathematics.
//!
//! # Formulation
//! Between events everything is linear in the seven numbers `(y, x2, v1, v2, sin φ, cos φ, s)`, where `s = ±δ` is
//! the stop that was touched last (the reference) and `y = x1 − s`. The state at any time after an event is the
//! matrix exponential applied to the state at the event: [`flow`] tabulates it in double-double arithmetic, so no
//! error of stepping builds up, and because y is *exactly* zero at an impact, hops far smaller than the rounding of
//! x1 itself are still resolved. While M1 rests on a stop the same holds with the rows of y and v1 zeroed.
//!
//! Both gaps and the contact force are linear functionals of those seven numbers, so one search ([`crossing`])
//! finds impacts and releases: a stretch is only called free where a bound on the second derivative proves it,
//! everything else is subdivided, and roots are bisected to the last bit.
//!
//! # Phase
//! The phasor restarts at exactly (0, 1) with every forcing period, and is recomputed from the time in the period
//! after every event.
//!
//! # Chatter
//! Hops are followed one by one until the rebound speed u is below 1e-9 against a pressing acceleration a that
//! cannot change sign before the hops have died out; then M1 is put to rest. What is left out lasts 2u/(a(1−r))
//! and moves M1 by u²/(2a), an impulse of about u³/(a²(1−r)) on M2.
//!
//! Everything is generic over the arithmetic: `f64` for the suites, [`Dd`] (32 digits) as the referee.

pub mod crossing;
mod dd;
pub mod flow;
pub mod follow;
mod linear;
pub mod lyapunov;
mod plant;
mod real;
pub mod settle;

pub use dd::Dd;
pub use follow::{Follower, Stop};
pub use plant::Plant;
pub use real::Real;
