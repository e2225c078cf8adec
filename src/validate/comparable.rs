//! What of two maps is compared beside their motions, task by task.

use super::alike::{largest, state_difference};
use super::layers::{LayerAgreement, layers};
use crate::analysis::{Schedule, Verdict};
use crate::control::Outcome;
use crate::plane::{Control, RegionMap, Task};

/// A task whose results can be compared.
pub trait Comparable: Task {
    /// How far two cells are apart that hold the same periodic motion, in units of what is of order one; infinite where one is not a
    /// number.
    fn difference(ours: &Self::Cell, theirs: &Self::Cell, unit: f64) -> f64;

    /// How well the layers of two maps agree.
    fn layers(ours: &RegionMap<Self>, theirs: &RegionMap<Self>) -> Vec<LayerAgreement>;
}

impl Comparable for Schedule {
    fn difference(ours: &Verdict, theirs: &Verdict, unit: f64) -> f64 {
        state_difference(&ours.state, &theirs.state, unit)
    }

    fn layers(ours: &RegionMap, theirs: &RegionMap) -> Vec<LayerAgreement> {
        layers(ours, theirs)
    }
}

impl Comparable for Control {
    fn difference(ours: &Outcome, theirs: &Outcome, unit: f64) -> f64 {
        let away = theirs.section.minus(&ours.section);
        let last = away.len() - 1;
        largest(away.iter().enumerate().map(|(i, value)| if i == last { *value } else { value / unit }))
    }

    /// None: a map under control has no layers.
    fn layers(_: &RegionMap<Self>, _: &RegionMap<Self>) -> Vec<LayerAgreement> {
        Vec::new()
    }
}
