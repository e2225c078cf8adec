//! What systems with the same flow have in common: the cells of a plane have it once for many.

use std::sync::Arc;

use arrayvec::ArrayVec;

use super::equations::Equations;
use super::of_flow::OfFlow;
use super::system_error::{MOST_STEPS, Stiff, SystemError};
use crate::system::{Mooring, Plant, Setting, StopValues, near};

/// rate·h of a step of length h is kept below this: large enough for few steps, small enough for low orders.
pub(super) const STEP: f64 = 1.0;

/// Stops in the order in which labels count their impacts, by their places in the plant's order.
pub(super) type LabelOrder = ArrayVec<usize, { Plant::MOST_STOPS }>;

/// A plant that may drift, and what holds it.
#[derive(Clone, Debug)]
pub(super) struct Adrift {
    /// The plant without what holds it.
    pub plant: Arc<Plant>,
    /// See [`System::mooring`](super::System::mooring).
    pub mooring: Arc<Mooring>,
}

/// What systems with the same flow have in common.
#[derive(Clone, Debug)]
pub(super) struct Common {
    /// The setting that one of them was made from, if they were made from settings.
    pub like: Option<Setting>,
    /// The plant of one of them.
    pub plant: Plant,
    /// Where it is held, since it may drift.
    pub adrift: Option<Adrift>,
    /// The stops in the order in which labels count their impacts.
    pub label_order: LabelOrder,
    /// How long the directions of the stops are, in the plant's order.
    pub lengths: ArrayVec<f64, { Plant::MOST_STOPS }>,
    /// See [`System::normals`](super::System::normals).
    pub normals: usize,
    /// See [`System::rate`](super::System::rate).
    pub rate: f64,
    /// See [`System::steps`](super::System::steps).
    pub steps: u32,
    /// What follows from the flow, found when it is first asked for; systems of other settings may have it in common, too.
    pub of_flow: Arc<OfFlow>,
}

impl Common {
    /// With a forcing period that is cut into steps short enough for the fastest motion.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where these would be too many.
    pub fn of(setting: Option<Setting>, plant: Plant, label_order: LabelOrder) -> Result<Self, SystemError> {
        let ((rate, normals), omega) = (rate_and_normals(&plant), plant.omega);
        let half_steps = (0.5 * rate * plant.period() / STEP).ceil();
        if half_steps.is_nan() || half_steps > f64::from(MOST_STEPS / 2) {
            return Err(SystemError::TooStiff(Box::new(Stiff { setting, omega, rate })));
        }
        let lengths = plant.stops.iter().map(|stop| stop.direction.norm()).collect();
        let (steps, of_flow) = (2 * half_steps as u32, Arc::default());
        Ok(Common { like: setting, plant, adrift: None, label_order, lengths, normals, rate, steps, of_flow })
    }

    /// Which of some stops, in the plant's order, have the same gap, per length of their direction, and the same restitution,
    /// within a few ulps: one bit for each pair.
    pub fn alike(&self, stops: &[StopValues]) -> u64 {
        let measures = |i: usize| [stops[i].gap / self.lengths[i], stops[i].restitution];
        let mut bits = 0;
        for i in 0..self.lengths.len() {
            let own = measures(i);
            for other in (0..i).map(measures) {
                bits = 2 * bits + u64::from(near(own[0], other[0]) && near(own[1], other[1]));
            }
        }
        bits
    }
}

/// Whether systems that have the same plant are the same.
impl PartialEq for Common {
    fn eq(&self, other: &Self) -> bool {
        let alike = match (&self.like, &other.like) {
            (Some(own), Some(other)) => own.with_stop_parameters(&other.stop_parameters()) == *other,
            (own, other) => own.is_none() && other.is_none(),
        };
        let rest = |common: &Self| (common.rate, common.steps);
        alike && self.label_order == other.label_order && rest(self) == rest(other)
    }
}

/// See [`System::rate`](super::System::rate) and [`System::normals`](super::System::normals).
fn rate_and_normals(plant: &Plant) -> (f64, usize) {
    fn of<const N: usize>(plant: &Plant) -> (f64, usize) {
        let equations = Equations::<N>::new(plant);
        (equations.rate(), equations.count)
    }
    match plant.n {
        1 => of::<1>(plant),
        2 => of::<2>(plant),
        3 => of::<3>(plant),
        4 => of::<4>(plant),
        _ => of::<5>(plant),
    }
}
