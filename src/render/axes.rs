//! The axes around the picture of a plane.

use super::symbols;
use crate::figure::{Frame, Scale};
use crate::plane::Plane;

/// The axes of a plane.
pub(super) fn frame_of<T>(plane: &Plane<T>) -> Frame {
    Frame {
        x: Scale::of(&plane.x.steps),
        y: Scale::of(&plane.y.steps),
        x_title: symbols::axis_title(plane.x.quantity),
        y_title: symbols::axis_title(plane.y.quantity),
    }
}
