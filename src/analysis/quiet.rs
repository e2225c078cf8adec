//! Motion that can never impact again.

use crate::dynamics::Point;
use crate::model::{Flight, Real};

/// Whether free motion from this strobe point on stays between the stops for ever.
///
/// The deviation from the forced response loses energy, and x1 of a deviation with energy E is at most
/// √(2E (K⁻¹)₁₁); so x1 stays within that plus the forced amplitude.
#[inline(always)]
pub fn is_quiet<T: Real>(flight: &Flight<T>, point: &Point<T>) -> bool {
    let [forced_x1, forced_x2, forced_v1, forced_v2] = flight.forced;
    let x2 = point.x2 - forced_x2;
    let stretch = (point.x1 - forced_x1) - x2;
    let v1 = point.v1 - forced_v1;
    let v2 = point.v2 - forced_v2;
    let twice_energy = (v1 * v1 + flight.mass * v2 * v2) + (stretch * stretch + flight.ground * x2 * x2);
    flight.reach + flight.compliance * twice_energy.sqrt() < flight.delta
}
