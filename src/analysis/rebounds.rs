//! Whether impacts chatter: rows of them at one stop, each slower than the one before.

use crate::dynamics::{Event, Stop};
use crate::model::Real;

/// How many impacts in a row at one stop, each slower than the one before, are called chatter.
pub const CHATTER_RUN: u32 = 5;

/// Counts impacts in a row at one stop, each slower than the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebounds<T> {
    /// |d·v−| of the last impact; 0 before the first.
    last: T,
    /// Where it was.
    stop: Stop,
    /// Impacts in the present row.
    run: u32,
    /// Impacts in the longest row.
    pub longest: u32,
}

impl<T: Real> Default for Rebounds<T> {
    fn default() -> Self {
        Rebounds { last: T::zero(), stop: Stop::A, run: 0, longest: 0 }
    }
}

impl<T: Real> Rebounds<T> {
    /// Sees what ended a move.
    #[inline(always)]
    pub fn see(&mut self, event: &Event<T>) {
        let (Event::Impact(impact) | Event::Caught { impact, .. }) = event else { return };
        let speed = impact.velocity_before.abs();
        if speed == T::zero() {
            return;
        }
        let slower = impact.stop == self.stop && speed < self.last;
        self.run = if slower { self.run + 1 } else { 1 };
        self.longest = if self.run > self.longest { self.run } else { self.longest };
        self.last = speed;
        self.stop = impact.stop;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Impact;

    #[test]
    fn a_row_of_rebounds_shrinks_at_one_stop() {
        let longest = |impacts: &[(u8, f64)]| {
            let mut rebounds = Rebounds::default();
            for &(stop, velocity_before) in impacts {
                let impact =
                    Impact { stop: Stop(stop), velocity_before, velocity_after: -0.8 * velocity_before };
                rebounds.see(&Event::Impact(impact));
            }
            rebounds.see(&Event::Strobe);
            rebounds.longest
        };
        assert_eq!(longest(&[]), 0);
        assert_eq!(longest(&[(0, 1.0), (1, -1.0), (0, 0.5), (1, -0.5)]), 1);
        assert_eq!(longest(&[(0, 1.0), (0, 0.8), (0, 0.7), (1, -0.9), (1, -0.8), (0, 0.1)]), 3);
        assert_eq!(longest(&[(0, 1.0), (0, 0.8), (0, 0.9), (0, 0.7)]), 2);
        // Two stops on lines of their own are met at velocities of one sign.
        assert_eq!(longest(&[(0, 1.0), (2, 0.9), (0, 0.8), (2, 0.7)]), 1);
    }
}
