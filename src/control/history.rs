//! A controlled trajectory written down: every return to σ, and its flight at the end.

use super::witness::{Return, Witness};
use crate::dynamics::{Event, Impact, ImpactEvent, Move, Recording, Sample, Trajectory};
use crate::model::{Flight, StateVector, System};

/// Samples nearer to an impact than this, in units of their distance, are left out.
const NEAR: f64 = 1e-3;

/// Everything that happened at the returns to σ, and the flight of the last iterates.
#[derive(Clone, Debug)]
pub struct History {
    /// The returns, in order.
    pub returns: Vec<Return<f64>>,
    /// The flight from iterate `from` on, of all coordinates; times are non-dimensional and count from its beginning. Where control acts
    /// at an impact, `velocity_after` is that after the correction, and the state and the phase are those before it; there are no
    /// samples right beside impacts.
    pub recording: Recording,
    from: u32,
    interval: f64,
    has_begun: bool,
    time: f64,
    next: u64,
}

impl History {
    /// Records flight from the return `from` on, with a sample each `interval` of time.
    ///
    /// # Panics
    /// If the interval is not positive.
    pub fn new(from: u32, interval: f64) -> Self {
        assert!(interval > 0.0, "samples are taken at times that follow each other, not every {interval}");
        let recording = Recording::default();
        History { returns: Vec::new(), recording, from, interval, has_begun: false, time: 0.0, next: 0 }
    }

    fn is_recording(&self) -> bool {
        self.returns.last().is_some_and(|last| last.iterate >= self.from)
    }

    fn impact<const N: usize, const M: usize>(
        &mut self,
        impact: Impact<f64>,
        flight: &Flight<f64, M>,
        after: &Trajectory<f64, M>,
    ) {
        if impact.velocity_before != 0.0 {
            self.recording.impacts.push(ImpactEvent {
                time: self.time,
                stop: impact.stop,
                velocity_before: impact.velocity_before,
                velocity_after: impact.velocity_after,
                state: StateVector::of(&after.point.state.first::<N>()),
                phase: super::section_point::phase_of(flight, after.step, after.offset),
            });
        }
    }
}

impl Witness<f64> for History {
    fn moved<const N: usize, const M: usize>(
        &mut self,
        flight: &Flight<f64, M>,
        before: &Trajectory<f64, M>,
        taken: &Move<f64>,
        after: &Trajectory<f64, M>,
    ) {
        if !self.is_recording() {
            return;
        }
        let end = self.time + taken.time;
        let near = NEAR * self.interval;
        let strikes = matches!(taken.event, Event::Impact(_) | Event::Caught { .. });
        while (self.next as f64) * self.interval < end {
            let at = self.next as f64 * self.interval;
            self.next += 1;
            let begins = self.recording.impacts.last().is_some_and(|last| at < last.time + near);
            if begins || (strikes && at > end - near) {
                // The impact stands there already.
                continue;
            }
            let state = before.point.flown(flight, (at - self.time).max(0.0), taken.contact).state;
            self.recording.samples.push(Sample { time: at, state: StateVector::of(&state.first::<N>()) });
        }
        if !self.has_begun {
            self.recording.begin_rests(flight, before.contact, 0.0);
            self.has_begun = true;
        }
        self.recording.note_rests(flight, before.contact, taken, after.contact, self.time);
        self.time = end;
        if let Event::Impact(impact) | Event::Caught { impact, .. } = taken.event {
            self.impact::<N, M>(impact, flight, after);
        }
    }

    fn returned(&mut self, met: &Return<f64>) {
        // A kick changes the velocity that the impact left behind.
        if let Some(last) = self.recording.impacts.last_mut().filter(|last| last.stop == met.stop) {
            last.velocity_after = met.velocity;
        }
        self.returns.push(*met);
    }
}

/// Iterates from switching control on until the points stay within `tolerance` of the last `period` of them, which
/// repeat, in units of what is of order one in the system, relative above; `None` where they do not.
pub fn converged_at(
    system: &System,
    returns: &[Return<f64>],
    from: u32,
    period: u32,
    tolerance: f64,
) -> Option<u32> {
    let period = period as usize;
    let controlled = returns.get(from as usize..)?;
    if period == 0 || controlled.len() <= 2 * period {
        return None;
    }
    let (end, unit) = (controlled.len(), system.unit());
    let away = |n: usize| {
        let twin = end - 1 - (end - 1 - n) % period;
        controlled[n].section.away_from(&controlled[twin].section, unit)
    };
    let first = (0..end).rev().take_while(|&n| away(n) <= tolerance).last()?;
    (end - first > 2 * period).then_some(first as u32)
}
