//! A system under other loads.

use super::system::System;

impl System {
    /// The same system without forcing; ω stays as the clock that counts periods.
    #[must_use]
    pub fn unforced(self) -> Self {
        self.changed(|plant| {
            plant.force_sin.fill(0.0);
            plant.force_cos.fill(0.0);
        })
    }

    /// The same system under a unit load of sin φ on one coordinate and no other.
    ///
    /// # Panics
    /// If there is no such coordinate.
    #[must_use]
    pub fn loaded_alone(&self, coordinate: usize) -> Self {
        self.clone().unforced().changed(|plant| {
            plant.load.fill(0.0);
            plant.force_sin[coordinate] = 1.0;
        })
    }

    /// The same system with other loads of sin φ on its coordinates.
    #[must_use]
    pub fn loaded(self, force_sin: &[f64]) -> Self {
        self.changed(|plant| plant.force_sin.copy_from_slice(force_sin))
    }
}
