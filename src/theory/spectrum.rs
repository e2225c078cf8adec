//! The Lyapunov spectrum: all four exponents of a trajectory, with their statistical error.

use nalgebra::Matrix4;
use thiserror::Error;

use crate::analysis::constants::{ALIGNING, BATCHES};
use crate::dynamics::{Event, Stop, Tangent, Trajectory};
use crate::model::{Flight, State, System};

/// The frame is made orthogonal again after so many time constants of the fastest motion, at the latest.
const REACH: f64 = 2.0;

/// Moves in one forcing period beyond which a trajectory is given up.
const MOST_MOVES: u32 = 1 << 24;

/// The four Lyapunov exponents of a trajectory, largest first, natural logarithm; everything is non-dimensional.
///
/// Section 5 defines them per iterate of the impact map σ→σ; here they are measured per forcing period, and
/// [`Spectrum::per_time`] and [`Spectrum::per_iterate`] are the same numbers in the other units. An exponent is −∞ where
/// a direction is lost altogether: complete chatter and sticking forget two, since the first mass's own place and velocity
/// no longer matter; an impact with r = 0 forgets one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// The exponents per forcing period.
    pub per_period: [f64; 4],
    /// Their standard errors per forcing period, from the scatter of sixteen batches; 0 for a lost direction.
    pub standard_error: [f64; 4],
    /// Directions that are lost: so many exponents are −∞.
    pub lost: u32,
    /// Forcing periods observed.
    pub periods: u32,
    /// The forcing period 2π/ω.
    pub period: f64,
    /// Impacts observed, at both stops.
    pub impacts: u64,
    /// Returns to the section σ: impacts at A; none where complete chatter makes them infinitely many.
    pub iterates: Option<u64>,
}

/// The trajectory could not be followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the trajectory was given up after {periods} forcing periods: {reason}; try another --start, lower r or raise omega"
)]
pub struct SpectrumFailed {
    /// Forcing periods that were completed.
    pub periods: u32,
    /// Why.
    pub reason: &'static str,
}

impl Spectrum {
    /// Follows a trajectory from (x1, x2, v1, v2) at forcing phase 0, in f64: `transient` forcing periods unobserved, then
    /// `observe` periods (16 at least, in whole batches) with a frame of four tangent vectors, whose products
    /// are factorised by QR.
    ///
    /// # Errors
    /// [`SpectrumFailed`] for a state that is no longer finite, or more than 2²⁴ moves in one forcing period.
    pub fn of(
        system: &System,
        start: [f64; 4],
        transient: u32,
        observe: u32,
    ) -> Result<Self, SpectrumFailed> {
        let flight = &Flight::<f64, 2>::new(system);
        let mut trajectory = Trajectory::new(flight, State::from_slice(&start));
        let mut gauge = Gauge::new(flight);
        for period in 0..transient {
            let mut moves = Moves { period, left: MOST_MOVES };
            while trajectory.advance(flight, &mut ()).event != Event::Strobe {
                moves.count(&trajectory)?;
            }
        }
        if !trajectory.contact.is_free() {
            gauge.lose(2);
        }
        // The frame turns into the exponents' directions before anything is counted.
        let batch_periods = observe.div_ceil(BATCHES).max(1);
        let aligning = batch_periods * (BATCHES / ALIGNING);
        let mut batches = Vec::new();
        for period in 0..aligning + batch_periods * BATCHES {
            if period >= aligning && (period - aligning).is_multiple_of(batch_periods) {
                batches.push([0.0; 4]);
            }
            let mut moves = Moves { period: transient + period, left: MOST_MOVES };
            loop {
                let taken = trajectory.advance(flight, &mut gauge.frame);
                moves.count(&trajectory)?;
                gauge.note(flight, taken.time, &taken.event, period >= aligning);
                if taken.event == Event::Strobe {
                    break;
                }
            }
            let growth = gauge.growth();
            if let Some(batch) = batches.last_mut() {
                for (sum, growth) in batch.iter_mut().zip(growth) {
                    *sum += growth;
                }
            }
        }
        Ok(gauge.spectrum(system, &batches, batch_periods))
    }

    /// The exponents per unit of (non-dimensional) time.
    pub fn per_time(&self) -> [f64; 4] {
        self.per_period.map(|exponent| exponent / self.period)
    }

    /// The exponents per iterate of the impact map σ→σ, the paper's unit; none where there are no returns, or infinitely
    /// many.
    pub fn per_iterate(&self) -> Option<[f64; 4]> {
        let iterates = self.iterates.filter(|&iterates| iterates > 0)?;
        Some(self.per_period.map(|exponent| exponent * f64::from(self.periods) / iterates as f64))
    }

    /// What the sum of the exponents per forcing period must be: −T·tr(M⁻¹C) + 2 ln r × (impacts per period).
    pub fn sum_identity(&self, system: &System) -> f64 {
        let trace = system.contraction();
        let r = system.parameters().r;
        let per_period = self.impacts as f64 / f64::from(self.periods);
        let struck = if self.impacts > 0 { 2.0 * r.ln() * per_period } else { 0.0 };
        struck - self.period * trace
    }
}

/// Guards against trajectories without end.
struct Moves {
    period: u32,
    left: u32,
}

impl Moves {
    fn count(&mut self, trajectory: &Trajectory<f64, 2>) -> Result<(), SpectrumFailed> {
        let periods = self.period;
        self.left -= 1;
        if self.left == 0 {
            return Err(SpectrumFailed { periods, reason: "too many impacts in one forcing period" });
        }
        if !trajectory.point.state.is_finite() {
            return Err(SpectrumFailed { periods, reason: "its state is no longer finite" });
        }
        Ok(())
    }
}

/// A frame of tangent vectors, kept orthogonal, and what it has grown by.
struct Gauge {
    frame: [Tangent<f64, 2>; 4],
    /// ln of the growths since they were last asked for.
    growth: [f64; 4],
    /// Time since the frame was last made orthogonal, in time constants of the fastest motion.
    since: f64,
    lost: u32,
    impacts: u64,
    iterates: Option<u64>,
}

impl Gauge {
    fn new(flight: &Flight<f64, 2>) -> Self {
        let unit = |j: usize| {
            let at = |i: usize| if i == j { 1.0 } else { 0.0 };
            Tangent(State::from_slice(&[at(0), at(1), at(2), at(3)]))
        };
        // x2 and v2 first: they are what sticking leaves.
        let frame = [unit(1), unit(3), unit(2), unit(0)];
        let mut gauge = Gauge { frame, growth: [0.0; 4], since: 0.0, lost: 0, impacts: 0, iterates: Some(0) };
        if flight.normals[0].gap[0] == 0.0 {
            gauge.lose(2);
        }
        gauge
    }

    fn note(&mut self, flight: &Flight<f64, 2>, time: f64, event: &Event<f64>, counts: bool) {
        self.since += flight.rate * time;
        match event {
            Event::Impact(impact) => {
                if counts {
                    self.impacts += 1;
                    self.iterates = self.iterates.map(|count| count + u64::from(impact.stop == Stop::A));
                }
                if flight.normals[0].restitution[0] == 0.0 {
                    self.lose(1);
                }
                self.orthogonalise();
            }
            Event::Caught { impact, complete_chatter } => {
                // The mass may also come to rest without an impact.
                if counts && impact.velocity_before != 0.0 {
                    self.impacts += 1;
                    if impact.stop == Stop::A {
                        self.iterates = self.iterates.filter(|_| !complete_chatter).map(|count| count + 1);
                    }
                }
                self.lose(2);
                self.orthogonalise();
            }
            _ if self.since > REACH => self.orthogonalise(),
            _ => {}
        }
    }

    /// From now on so many directions at least are lost for ever.
    fn lose(&mut self, directions: u32) {
        self.lost = self.lost.max(directions);
    }

    /// The QR factorisation: the frame becomes Q, and R's diagonal is counted.
    fn orthogonalise(&mut self) {
        self.since = 0.0;
        let columns: [_; 4] = self.frame.map(|t| nalgebra::Vector4::from_iterator(t.0.values()));
        let (q, r) = Matrix4::from_columns(&columns).qr().unpack();
        // So little restitution that its square is lost in rounding is none.
        let kept = 4 - self.lost as usize;
        let vanished = (0..kept).filter(|&j| r[(j, j)] == 0.0).count();
        self.lose(self.lost + vanished as u32);
        for j in 0..4 {
            if j >= 4 - self.lost as usize {
                self.frame[j] = Tangent(State::zero());
                self.growth[j] = f64::NEG_INFINITY;
            } else {
                self.frame[j] = Tangent(State::from_slice(q.column(j).as_slice()));
                self.growth[j] += r[(j, j)].abs().ln();
            }
        }
    }

    /// The growths since the last call, ln of factors.
    fn growth(&mut self) -> [f64; 4] {
        self.orthogonalise();
        std::mem::take(&mut self.growth)
    }

    fn spectrum(self, system: &System, batches: &[[f64; 4]], batch_periods: u32) -> Spectrum {
        let count = batches.len() as f64;
        let per_batch = f64::from(batch_periods);
        let mut measured = [(f64::NEG_INFINITY, 0.0); 4];
        for j in 0..4 - self.lost as usize {
            let mean = batches.iter().map(|batch| batch[j]).sum::<f64>() / count;
            let square = batches.iter().map(|batch| (batch[j] - mean).powi(2)).sum::<f64>() / (count - 1.0);
            measured[j] = (mean / per_batch, (square / count).sqrt() / per_batch);
        }
        // Exponents that are equal but for their errors come in any order.
        measured.sort_by(|a, b| b.0.total_cmp(&a.0));
        Spectrum {
            per_period: measured.map(|(exponent, _)| exponent),
            standard_error: measured.map(|(_, error)| error),
            lost: self.lost,
            periods: batch_periods * batches.len() as u32,
            period: system.period(),
            impacts: self.impacts,
            iterates: self.iterates,
        }
    }
}
