//! What a trajectory leaves on a section while it is observed.

use super::probe::Probe;
use super::rebounds::Rebounds;
use super::regime::Verdict;
use crate::dynamics::{Event, Trajectory};
use crate::model::{Flight, Real};

/// What a trajectory left on a section, and what it settled on.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// What the trajectory settled on.
    pub verdict: Verdict,
    /// What was read on the section, in order; non-dimensional.
    pub readings: Vec<f64>,
    /// Passages that were seen but not kept, for want of room.
    pub left_out: u32,
    /// The longest row of impacts at one stop, each slower than the one before.
    pub rebounds: u32,
}

/// Reads a section, as far as there is room.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracer<T> {
    probe: Probe,
    capacity: usize,
    readings: Vec<T>,
    /// Passages through the section.
    passages: u32,
    rebounds: Rebounds<T>,
}

impl<T: Real> Tracer<T> {
    /// Reads at most `capacity` passages.
    pub fn new(probe: Probe, capacity: usize) -> Self {
        Tracer { probe, capacity, readings: Vec::new(), passages: 0, rebounds: Rebounds::default() }
    }

    /// Sees an event, and the trajectory just after it.
    #[inline(always)]
    pub fn see<const N: usize>(
        &mut self,
        flight: &Flight<T, N>,
        trajectory: &Trajectory<T, N>,
        event: &Event<T>,
    ) {
        self.rebounds.see(event);
        if let Some(reading) = self.probe.read(flight, trajectory, event) {
            self.passages = self.passages.saturating_add(1);
            if self.readings.len() < self.capacity {
                self.readings.push(reading);
            }
        }
    }

    /// The trace of a trajectory with this verdict.
    pub fn finish(self, verdict: Verdict) -> Trace {
        let kept = self.readings.len() as u32;
        Trace {
            verdict,
            readings: self.readings.into_iter().map(T::widen).collect(),
            left_out: self.passages - kept,
            rebounds: self.rebounds.longest,
        }
    }
}
