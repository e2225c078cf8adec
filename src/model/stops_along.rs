//! The stops along a contact normal, which differ among cells with the same flow.

use super::contact_normal::{ContactNormal, FAR, NO_STOP};
use super::equations::closed;
use super::real::Real;
use super::system::System;
use crate::system::StopValues;

/// The stops at the upper and the lower end of a normal; a gap of [`FAR`] where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopsAlong {
    /// Where d·x, or −d·x, meets them.
    pub gap: [f64; 2],
    /// Their coefficients of restitution.
    pub restitution: [f64; 2],
    /// Which of the plant's stops they are.
    stop: [u8; 2],
    /// How long their directions are in units of the normal's.
    stretch: [f64; 2],
}

impl StopsAlong {
    /// No stop at either end.
    pub const NONE: StopsAlong =
        StopsAlong { gap: [FAR; 2], restitution: [0.0; 2], stop: [NO_STOP; 2], stretch: [1.0; 2] };

    /// Those of a normal of a system.
    pub(super) fn at<T: Real, const N: usize>(normal: &ContactNormal<T, N>, system: &System) -> Self {
        let [gap, restitution] = [normal.gap, normal.restitution].map(|values| values.map(T::widen));
        let mut along = StopsAlong { gap, restitution, stop: normal.stop, stretch: [1.0; 2] };
        // The direction of a line is that of the first stop on it.
        if let [Some(upper), Some(lower)] = along.ends() {
            let (later, side) = if upper < lower { (lower, 1) } else { (upper, 0) };
            along.stretch[side] = system.stretch(later, upper.min(lower)).abs();
        }
        along
    }

    /// Which of the plant's stops are there.
    fn ends(&self) -> [Option<usize>; 2] {
        self.stop.map(|stop| (stop != NO_STOP).then_some(usize::from(stop)))
    }

    /// The same of another system with the same flow.
    #[must_use]
    pub fn with_values_of(self, system: &System) -> Self {
        let (mut along, ends) = (self, self.ends());
        for (side, stop) in ends.into_iter().enumerate() {
            let Some(stop) = stop else { continue };
            let StopValues { gap, restitution } = system.stop_values()[stop];
            along.gap[side] = gap / self.stretch[side];
            along.restitution[side] = restitution;
        }
        if ends.iter().all(Option::is_some) {
            along.gap[1] = closed(along.gap);
        }
        along
    }
}
