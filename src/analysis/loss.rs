//! What impacts take from a trajectory, and how long contacts hold.

use super::regime::Measures;
use crate::dynamics::{Contact, Event, Impact, Move, Stop, Trajectory, energy_taken, taken_by_clamps};
use crate::model::{Flight, Real};

/// The energy that impacts took, and the time in contact, since an observation began at phase 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss<T> {
    /// Σ ½ m ((d·v−)² − (d·v+)²) with m = 1/(dᵀM⁻¹d), and what clamps take besides; all of it where rebounds are closed, since they
    /// take the rest.
    pub energy: T,
    /// The time in which some contact held; masses that rebound until they rest are not in contact yet.
    pub rested: T,
    /// The time within its forcing period of the last event, or of the end of the rebounds that were closed with it.
    since: T,
    /// What holds since.
    held: Contact,
}

impl<T: Real> Loss<T> {
    /// Nothing yet, at phase 0.
    pub fn none(held: Contact) -> Self {
        Loss { energy: T::zero(), rested: T::zero(), since: T::zero(), held }
    }

    /// What that comes to per unit of time over so many forcing periods, which took a time.
    pub fn measures(&self, observed: u32, time: T) -> Measures {
        let per_time = |sum: T| (sum / time).widen() as f32;
        Measures { observed, power: per_time(self.energy), contact: per_time(self.rested) }
    }

    /// Notes what ended a move, with the trajectory just after it.
    #[inline(always)]
    pub fn note<const N: usize>(
        &mut self,
        flight: &Flight<T, N>,
        trajectory: &Trajectory<T, N>,
        taken: &Move<T>,
    ) {
        let strobe = matches!(taken.event, Event::Strobe);
        let steps = if strobe { flight.steps } else { trajectory.step };
        let now = T::of(f64::from(steps)) * flight.h + trajectory.offset;
        let (holds, held) = (trajectory.contact, !self.held.is_free());
        if held {
            let opened = matches!(taken.event, Event::Released(_)) && holds.is_free();
            let until = if opened { now - taken.time } else { now };
            self.rested = self.rested + if until > self.since { until - self.since } else { T::zero() };
        }
        let rebounds = match taken.event {
            // Unless another contact holds on.
            Event::Caught { rebounds, .. } if self.held.since(holds) == self.held => rebounds,
            _ => T::zero(),
        };
        // They end before the next strobe, but perhaps after phase π.
        let since = now + rebounds;
        let since = if held && self.since > since { self.since } else { since };
        self.since = if strobe { T::zero() } else { since };
        self.held = holds;
        match taken.event {
            Event::Impact(Impact { stop, velocity_before, velocity_after }) => {
                self.take(flight, holds, stop, [velocity_before, velocity_after]);
            }
            Event::Caught { impact, .. } => {
                self.take(flight, holds, impact.stop, [impact.velocity_before, T::zero()]);
            }
            _ => {}
        }
    }

    /// Notes what an impact takes, with the contacts that hold after it.
    #[inline(always)]
    fn take<const N: usize>(
        &mut self,
        flight: &Flight<T, N>,
        holds: Contact,
        stop: Stop,
        [before, after]: [T; 2],
    ) {
        let (mut struck, mut mass) = (0, T::zero());
        for (k, normal) in flight.normals().iter().enumerate() {
            if normal.stop[0] == stop.0 || normal.stop[1] == stop.0 {
                (struck, mass) = (k, normal.mass);
            }
        }
        self.energy = self.energy + energy_taken(mass, before, after);
        self.energy = self.energy + taken_by_clamps(flight, holds, struck, after - before);
    }
}
