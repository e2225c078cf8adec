//! The stops along a contact normal, which differ among cells with the same flow.

use super::contact_normal::{ContactNormal, FAR};
use super::equations::closed;
use super::system::System;
use crate::system::StopValues;

/// The stops at the upper and the lower end of a normal; a gap of [`FAR`] where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StopsAlong {
    /// Where d·x, or −d·x, meets them.
    pub gap: [f64; 2],
    /// Their coefficients of restitution.
    pub restitution: [f64; 2],
    /// Which of the plant's stops they are.
    stop: [u8; 2],
}

impl StopsAlong {
    /// Those of a normal.
    pub(super) fn at<const N: usize>(normal: &ContactNormal<f64, N>) -> Self {
        StopsAlong { gap: normal.gap, restitution: normal.restitution, stop: normal.stop }
    }

    /// The same of another system with the same flow.
    #[must_use]
    pub fn with_values_of(self, system: &System) -> Self {
        let mut along = self;
        let ends = [0, 1].map(|side| (self.gap[side] < FAR).then(|| usize::from(self.stop[side])));
        // The direction of a line is that of the first stop on it.
        let Some(first) = ends.into_iter().flatten().min() else { return along };
        for (side, stop) in ends.into_iter().enumerate() {
            let Some(stop) = stop else { continue };
            let StopValues { gap, restitution } = system.stop_values()[stop];
            let scale = if stop == first { 1.0 } else { system.stretch(stop, first) };
            along.gap[side] = gap / scale.abs();
            along.restitution[side] = restitution;
        }
        if ends.iter().all(Option::is_some) {
            along.gap[1] = closed(along.gap);
        }
        along
    }
}
