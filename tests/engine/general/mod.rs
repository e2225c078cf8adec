//! The engine for any linear oscillator with rigid stops, against a brute-force oracle and what physics demands.

mod adrift;
mod alternating;
mod families;
mod gpu;
mod grazing;
mod invariants;
mod joint;
mod numbers;
mod settling;
mod simultaneous;
mod squeezed;
mod sticking;
pub mod subject;
mod suite;
mod units;
mod unpressed;
