//! What impacts take from a trajectory, and how long contacts hold.

use crate::dynamics::{Event, Impact, Stop, Trajectory, energy_taken};
use crate::model::{Flight, Real};

/// The energy that impacts took, and the time in contact, since an observation began at phase 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss<T> {
    /// Σ ½ m ((d·v−)² − (d·v+)²) with m = 1/(dᵀM⁻¹d); all of it where rebounds are closed, since they take the rest.
    pub energy: T,
    /// The time in which some contact held.
    pub rested: T,
    /// The time of the last event within its forcing period.
    since: T,
    /// Whether some contact has held since.
    held: bool,
}

impl<T: Real> Loss<T> {
    /// Nothing yet, at phase 0.
    pub fn none(held: bool) -> Self {
        Loss { energy: T::zero(), rested: T::zero(), since: T::zero(), held }
    }

    /// Notes an event, with the trajectory just after it.
    #[inline(always)]
    pub fn note<const N: usize>(
        &mut self,
        flight: &Flight<T, N>,
        trajectory: &Trajectory<T, N>,
        event: &Event<T>,
    ) {
        let strobe = matches!(event, Event::Strobe);
        let steps = if strobe { flight.steps } else { trajectory.step };
        let now = T::of(f64::from(steps)) * flight.h + trajectory.offset;
        if self.held {
            self.rested = self.rested + (now - self.since);
        }
        self.since = if strobe { T::zero() } else { now };
        self.held = !trajectory.contact.is_free();
        match *event {
            Event::Impact(Impact { stop, velocity_before, velocity_after }) => {
                self.take(flight, stop, velocity_before, velocity_after);
            }
            Event::Caught { impact, .. } => self.take(flight, impact.stop, impact.velocity_before, T::zero()),
            _ => {}
        }
    }

    /// Notes what an impact takes that ends free flight and begins it again.
    #[inline(always)]
    pub fn take<const N: usize>(&mut self, flight: &Flight<T, N>, stop: Stop, before: T, after: T) {
        let mut mass = T::zero();
        for normal in flight.normals() {
            if normal.stop[0] == stop.0 || normal.stop[1] == stop.0 {
                mass = normal.mass;
            }
        }
        self.energy = self.energy + energy_taken(mass, before, after);
    }
}
