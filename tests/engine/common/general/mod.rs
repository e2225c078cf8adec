//! A brute-force oracle for any plant, in its own formulation: matrix exponentials of the whole augmented state, crossings
//! found on a dense grid, impacts and rebounds one by one, contacts by the signs of their forces.
//!
//! Of the library it knows the description of a plant alone.

pub mod conditioning;
pub mod crossing;
pub mod draw;
pub mod follow;
pub mod mode;

pub use follow::{Follower, Period};
