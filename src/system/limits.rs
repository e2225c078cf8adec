//! What a plant may have at most.

/// The most coordinates.
pub const MOST_COORDINATES: usize = 4;

/// The most stops.
pub const MOST_STOPS: usize = 4;

/// The least reciprocal condition of a mass matrix, its rows and columns brought to the same size.
pub const LEAST_CONDITION: f64 = 1e-10;
