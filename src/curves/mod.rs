//! Bifurcation curves: where the motions of a map lose their stability or graze, computed by continuation.
//!
//! A motion's matching equations and the condition of its bifurcation are solved together in two parameters, and followed by
//! pseudo-arclength continuation: around turning points, up to the border of the plane or to the point where the
//! motion ceases to exist.

mod atlas;
mod branch;
mod chain;
mod condition;
mod curve;
mod events;
mod left_out;
mod locus;
mod no_impact;
mod parting;
mod path;
mod regions;
mod response;
mod seeds;
mod spans;
mod special;
mod symmetry;
mod touch;
mod trace;
mod unknowns;
mod until;

pub use atlas::{PlaneCurves, bifurcation_curves, bifurcation_curves_until};
pub use condition::Kind;
pub use curve::{Criticality, Curve, CurveMotion, CurvePoint, End, Special};
pub use left_out::{LeftOut, Why};
pub use spans::{CurvesError, check};
