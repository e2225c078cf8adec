//! What systems with the same flow have in common beside their plants: the cells of a plane have it once for many.

use arrayvec::ArrayVec;

use super::equations::Equations;
use super::system_error::{MOST_STEPS, Stiff, SystemError};
use crate::system::{Plant, Setting};

/// rate·h of a step of length h is kept below this: large enough for few steps, small enough for low orders.
pub(super) const STEP: f64 = 1.0;

/// Stops in the order in which labels count their impacts, by their places in the plant's order.
pub(super) type LabelOrder = ArrayVec<usize, { Plant::MOST_STOPS }>;

/// What systems with the same flow have in common, beside their plants.
#[derive(Clone, Debug)]
pub(super) struct Common {
    /// The setting that one of them was made from, if they were made from settings.
    pub like: Option<Setting>,
    /// The stops in the order in which labels count their impacts.
    pub label_order: LabelOrder,
    /// How long the directions of the stops are, in the plant's order.
    pub lengths: ArrayVec<f64, { Plant::MOST_STOPS }>,
    /// See [`System::rate`](super::System::rate).
    pub rate: f64,
    /// See [`System::steps`](super::System::steps).
    pub steps: u32,
}

impl Common {
    /// With a forcing period that is cut into steps short enough for the fastest motion.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where these would be too many.
    pub fn of(setting: Option<Setting>, plant: &Plant, label_order: LabelOrder) -> Result<Self, SystemError> {
        let (rate, omega) = (rate(plant), plant.omega);
        let half_steps = (0.5 * rate * plant.period() / STEP).ceil();
        if half_steps.is_nan() || half_steps > f64::from(MOST_STEPS / 2) {
            return Err(SystemError::TooStiff(Box::new(Stiff { setting, omega, rate })));
        }
        let lengths = plant.stops.iter().map(|stop| stop.direction.norm()).collect();
        Ok(Common { like: setting, label_order, lengths, rate, steps: 2 * half_steps as u32 })
    }
}

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

/// See [`System::rate`](super::System::rate).
fn rate(plant: &Plant) -> f64 {
    match plant.n {
        1 => Equations::<1>::new(plant).rate(),
        2 => Equations::<2>::new(plant).rate(),
        3 => Equations::<3>::new(plant).rate(),
        4 => Equations::<4>::new(plant).rate(),
        _ => Equations::<5>::new(plant).rate(),
    }
}
