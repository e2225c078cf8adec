//! A brute-force oracle for any plant, in its own formulation: matrix exponentials of the whole augmented state, crossings
//! found on a dense grid, impacts and rebounds one by one, contacts by the signs of their forces.
//!
//! Of the library it knows the description of a plant alone.
#![allow(dead_code, unused_imports, reason = "every test binary uses its own part of this module")]

pub mod conditioning;
pub mod crossing;
pub mod draw;
pub mod follow;
pub mod mode;

pub use conditioning::{Case, cases};
pub use draw::Setup;
pub use follow::{Follower, Period};
