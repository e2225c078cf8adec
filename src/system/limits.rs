//! What a plant may have at most.

/// The most coordinates.
pub const MOST_COORDINATES: usize = 4;

/// The most stops.
pub const MOST_STOPS: usize = 4;

/// The shortest direction of a stop.
pub const SHORTEST_DIRECTION: f64 = 1e-9;

/// The longest direction of a stop.
pub const LONGEST_DIRECTION: f64 = 1e9;

/// The farthest that a stop may stand from 0: beyond it there is none to meet.
pub const FARTHEST_STOP: f64 = 1e18;

/// The least reciprocal condition of a mass matrix, its rows and columns brought to the same size.
pub const LEAST_CONDITION: f64 = 1e-10;
