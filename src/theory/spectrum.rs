//! The Lyapunov spectrum: all exponents of a trajectory, with their statistical error.
//!
//! Deviations made orthogonal again and again: G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980)
//! 9–20 and 21–30, doi:10.1007/BF02128236 and doi:10.1007/BF02128237.

use thiserror::Error;

use super::follower::{Follower, follower};
use super::frame::Frame;
use crate::analysis::constants::{ALIGNING, BATCHES};
use crate::dynamics::{Event, Moves, Stop};
use crate::model::System;

/// The 2n Lyapunov exponents of a trajectory, largest first, natural logarithm; everything is non-dimensional. Fewer where
/// it may drift: those of what is held are left out; see [`System::moored`].
///
/// Section 5 defines them per iterate of the impact map σ→σ; here they are measured per forcing period, and
/// [`Spectrum::per_time`] and [`Spectrum::per_iterate`] are the same numbers in the other units. An exponent is −∞ where
/// a direction is lost altogether: complete chatter and sticking forget two for each contact, since the place and velocity
/// along it no longer matter; an impact with r = 0 forgets one.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// The exponents per forcing period.
    pub per_period: Vec<f64>,
    /// Their standard errors per forcing period, from the scatter of sixteen batches; 0 for a lost direction.
    pub standard_error: Vec<f64>,
    /// Directions that are lost: so many exponents are −∞.
    pub lost: u32,
    /// Forcing periods observed.
    pub periods: u32,
    /// The forcing period 2π/ω.
    pub period: f64,
    /// Impacts observed, at all stops.
    pub impacts: u64,
    /// Impacts observed at each stop, in the plant's order.
    pub impacts_per_stop: Vec<u64>,
    /// Whether complete chatter makes the impacts at a stop infinitely many, in the plant's order.
    pub endless: Vec<bool>,
}

/// The trajectory could not be followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the trajectory was given up after {periods} forcing periods: {reason}; try another --start, less restitution or a faster \
     forcing"
)]
pub struct SpectrumFailed {
    /// Forcing periods that were completed.
    pub periods: u32,
    /// Why.
    pub reason: &'static str,
}

impl Spectrum {
    /// Follows a trajectory from (x, v) at forcing phase 0, in f64: `transient` forcing periods unobserved, then
    /// `observe` periods (16 at least, in whole batches) with a frame of 2n tangent vectors, whose products
    /// are factorised by QR.
    ///
    /// # Errors
    /// [`SpectrumFailed`] for a motion that grows without bounds, or too many moves in forcing period after forcing period.
    ///
    /// # Panics
    /// If the start does not have 2n components.
    pub fn of(
        system: &System,
        start: impl AsRef<[f64]>,
        transient: u32,
        observe: u32,
    ) -> Result<Self, SpectrumFailed> {
        let mut follower = follower(system);
        follower.begin(start.as_ref());
        let mut headway = Headway { periods: 0, moves: Moves::default() };
        for _ in 0..transient {
            loop {
                let event = follower.advance().event;
                if !headway.note(follower.as_ref(), &event)? {
                    break;
                }
            }
        }
        let stops = system.plant().stops.len();
        let mut tally = Tally { impacts: vec![0; stops], endless: vec![false; stops] };
        let mut frame = Frame::new(system, follower.as_mut());
        // The frame turns into the exponents' directions before anything is counted.
        let batch_periods = observe.div_ceil(BATCHES).max(1);
        let aligning = batch_periods * (BATCHES / ALIGNING);
        let mut batches = Vec::new();
        for period in 0..aligning + batch_periods * BATCHES {
            if period >= aligning && (period - aligning).is_multiple_of(batch_periods) {
                batches.push(vec![0.0; 2 * system.plant().n]);
            }
            loop {
                let taken = follower.advance();
                let goes_on = headway.note(follower.as_ref(), &taken.event)?;
                if period >= aligning {
                    tally.note(follower.as_ref(), &taken.event);
                }
                frame.note(follower.as_mut(), taken.time, &taken.event);
                if !goes_on {
                    break;
                }
            }
            let growth = frame.growth(follower.as_mut());
            if let Some(batch) = batches.last_mut() {
                for (sum, growth) in batch.iter_mut().zip(growth) {
                    *sum += growth;
                }
            }
        }
        Ok(tally.spectrum(system, &frame, &batches, batch_periods))
    }

    /// The exponents per unit of (non-dimensional) time.
    pub fn per_time(&self) -> Vec<f64> {
        self.per_period.iter().map(|exponent| exponent / self.period).collect()
    }

    /// Returns to the section at a stop: impacts there; none where complete chatter makes them infinitely many.
    ///
    /// # Panics
    /// If the system has no such stop.
    pub fn returns(&self, stop: Stop) -> Option<u64> {
        let at = stop.index();
        (!self.endless[at]).then_some(self.impacts_per_stop[at])
    }

    /// The exponents per iterate of the impact map σ→σ at a stop, at A the paper's unit; none where there are no returns,
    /// or infinitely many.
    ///
    /// # Panics
    /// If the system has no such stop.
    pub fn per_iterate(&self, stop: Stop) -> Option<Vec<f64>> {
        let iterates = self.returns(stop).filter(|&iterates| iterates > 0)?;
        let scaled = |exponent: &f64| exponent * f64::from(self.periods) / iterates as f64;
        Some(self.per_period.iter().map(scaled).collect())
    }

    /// What the sum of the exponents per forcing period must be: −T·tr(M⁻¹C), and 2 ln r for each impact per period.
    pub fn sum_identity(&self, system: &System) -> f64 {
        let stops =
            self.impacts_per_stop.iter().zip(&system.plant().stops).filter(|(impacts, _)| **impacts > 0);
        let struck: f64 = stops
            .map(|(&impacts, stop)| {
                2.0 * libm::log(stop.restitution) * (impacts as f64 / f64::from(self.periods))
            })
            .sum();
        struck - self.period * system.contraction()
    }
}

/// Guards against trajectories that make no headway.
struct Headway {
    /// Forcing periods that are completed.
    periods: u32,
    moves: Moves,
}

impl Headway {
    /// Whether the forcing period goes on after a move.
    fn note(&mut self, follower: &dyn Follower, event: &Event<f64>) -> Result<bool, SpectrumFailed> {
        let periods = self.periods;
        self.moves.note(event);
        if self.moves.are_too_many() {
            return Err(SpectrumFailed { periods, reason: "too many impacts in each forcing period" });
        }
        if !follower.is_bounded() {
            return Err(SpectrumFailed { periods, reason: "it grows without bounds" });
        }
        let is_over = *event == Event::Strobe;
        self.periods += u32::from(is_over);
        Ok(!is_over)
    }
}

/// The impacts that are observed.
struct Tally {
    impacts: Vec<u64>,
    endless: Vec<bool>,
}

impl Tally {
    fn note(&mut self, follower: &dyn Follower, event: &Event<f64>) {
        match event {
            Event::Impact(impact) => self.impacts[impact.stop.index()] += 1,
            Event::Caught { impact, complete_chatter, beside, .. } => {
                // A mass may also come to rest without an impact.
                if impact.velocity_before != 0.0 {
                    self.impacts[impact.stop.index()] += 1;
                    self.endless[impact.stop.index()] |= complete_chatter;
                }
                for stop in follower.stops_of(*beside) {
                    self.endless[stop.index()] = true;
                }
            }
            _ => {}
        }
    }

    fn spectrum(self, system: &System, frame: &Frame, batches: &[Vec<f64>], batch_periods: u32) -> Spectrum {
        let count = batches.len() as f64;
        let per_batch = f64::from(batch_periods);
        let mut measured = vec![(f64::NEG_INFINITY, 0.0); system.dimension()];
        for (j, measured) in measured.iter_mut().enumerate().take(frame.kept()) {
            let mean = batches.iter().map(|batch| batch[j]).sum::<f64>() / count;
            let square = batches.iter().map(|batch| (batch[j] - mean).powi(2)).sum::<f64>() / (count - 1.0);
            *measured = (mean / per_batch, (square / count).sqrt() / per_batch);
        }
        // Exponents that are equal but for their errors come in any order.
        measured.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (per_period, standard_error): (Vec<f64>, Vec<f64>) = measured.into_iter().unzip();
        Spectrum {
            lost: (per_period.len() - frame.kept()) as u32,
            per_period,
            standard_error,
            periods: batch_periods * batches.len() as u32,
            period: system.period(),
            impacts: self.impacts.iter().sum(),
            impacts_per_stop: self.impacts,
            endless: self.endless,
        }
    }
}

#[cfg(test)]
mod tests;
