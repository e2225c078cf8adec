//! The impacts of a periodic motion in their order, and how the last joins the first.

use std::f64::consts::PI;

use arrayvec::ArrayVec;
use nalgebra::DMatrix;

use super::flow::Flow;
use super::label::spelled;
use super::section_vector::{Node, SectionVector, phase};
use crate::dynamics::Stop;
use crate::model::System;
use crate::system::{Family, Plant};

/// Which stops a motion strikes, in order, and how it closes on itself.
///
/// A symmetric motion is described by half of it: after an odd number of half forcing periods it is its own mirror
/// image, x(t + Nπ/ω) = P x(t).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Pattern {
    /// The stops of the impacts: of one period of the motion, or of half of it where it is `mirrored`.
    pub stops: Vec<Stop>,
    /// After how many half forcing periods it closes: 2N, or N where it is `mirrored`.
    pub half_turns: u32,
    /// Whether it closes on its mirror image; only where the system has a mirror.
    pub mirrored: bool,
    /// The stops of the system.
    pub among: StopSet,
}

/// The stops of a system, as patterns and labels know them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct StopSet {
    /// The order in which labels count the impacts at the stops, by their places in the plant's order.
    label_order: Places,
    /// The stop onto which the mirror maps each stop, where there is a mirror.
    images: Option<Places>,
}

/// Places in the plant's order of the stops.
type Places = ArrayVec<usize, { Plant::MOST_STOPS }>;

impl StopSet {
    /// The stops of a system.
    pub fn of(system: &System) -> Self {
        StopSet {
            label_order: system.label_order().iter().copied().collect(),
            images: system.mirror().map(|mirror| mirror.stops.iter().copied().collect()),
        }
    }

    /// The stops of a family, without a mirror.
    pub fn of_family(family: &Family) -> Self {
        StopSet { label_order: family.label_order().iter().copied().collect(), images: None }
    }

    /// The same stops without the mirror.
    #[must_use]
    pub fn without_mirror(self) -> Self {
        StopSet { images: None, ..self }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.label_order.len()
    }

    /// Whether the system has a mirror.
    pub fn has_mirror(&self) -> bool {
        self.images.is_some()
    }

    /// The stop onto which the mirror maps a stop; the same one where there is no mirror.
    pub fn image(&self, stop: Stop) -> Stop {
        self.images.as_ref().map_or(stop, |images| Stop(images[stop.index()] as u8))
    }

    /// Counts in the plant's order of the stops, in that of labels.
    pub fn in_label_order<T: Copy>(&self, counts: &[T]) -> Vec<T> {
        self.label_order.iter().map(|&stop| counts[stop]).collect()
    }

    /// Counts in the order of labels, in the plant's order of the stops.
    pub fn in_plant_order<T: Copy + Default>(&self, counts: &[T]) -> Vec<T> {
        let mut ordered = vec![T::default(); self.count()];
        for (&stop, &count) in self.label_order.iter().zip(counts) {
            ordered[stop] = count;
        }
        ordered
    }
}

impl Pattern {
    /// The pattern of a motion of a system.
    ///
    /// # Panics
    /// If there is no impact, the system does not have a stop, the half turns are none, or odd where the motion is not mirrored.
    pub fn new(system: &System, stops: Vec<Stop>, half_turns: u32, mirrored: bool) -> Self {
        let known = system.plant().stops.len();
        assert!(!stops.is_empty(), "a motion with impacts has one");
        assert!(stops.iter().all(|stop| stop.index() < known), "the system has {known} stops: {stops:?}");
        assert!(
            half_turns > 0 && (mirrored || half_turns.is_multiple_of(2)),
            "{half_turns} half turns are no period"
        );
        Pattern { stops, half_turns, mirrored, among: StopSet::of(system) }
    }

    /// N: the motion repeats after so many forcing periods.
    pub fn n(&self) -> u32 {
        if self.mirrored { self.half_turns } else { self.half_turns / 2 }
    }

    /// p: impacts at Ā, the paper's second stop, in one period of the motion; 0 where there is no second stop.
    pub fn p(&self) -> u32 {
        self.counts().get(Stop::B.index()).copied().unwrap_or(0)
    }

    /// q: impacts at A, the first stop, in one period of the motion.
    pub fn q(&self) -> u32 {
        self.counts()[Stop::A.index()]
    }

    /// Impacts at each stop in one period of the motion, in the plant's order.
    pub fn counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.among.count()];
        for &stop in &self.stops {
            counts[stop.index()] += 1;
            if self.mirrored {
                counts[self.among.image(stop).index()] += 1;
            }
        }
        counts
    }

    /// Impacts in one period of the motion.
    pub fn impacts(&self) -> u32 {
        self.counts().iter().sum()
    }

    /// N and the impacts at each stop in the order of labels (N-p-q of the paper's oscillator), as text.
    pub fn label(&self) -> String {
        spelled(self.n(), self.among.in_label_order(&self.counts()))
    }

    /// The first impact, as it is met again at the end.
    pub(crate) fn closing(&self, flow: &Flow, first: &SectionVector) -> Node {
        let node = Node { stop: self.stops[0], section: first.clone() };
        let mut node = if self.mirrored { flow.mirror_image(&node) } else { node };
        let last = first.len() - 1;
        node.section[last] += self.turn();
        node
    }

    /// The phase at which the first impact is met again.
    pub(crate) fn closing_phase(&self, first: &SectionVector) -> f64 {
        phase(first) + self.turn()
    }

    /// The stop at which the first impact is met again.
    pub(crate) fn closing_stop(&self) -> Stop {
        if self.mirrored { self.among.image(self.stops[0]) } else { self.stops[0] }
    }

    /// How the first impact, as it is met again at the end, changes with the first impact.
    pub(crate) fn closing_matrix(&self, flow: &Flow) -> DMatrix<f64> {
        if self.mirrored { flow.reflection(self.stops[0]) } else { DMatrix::identity(2 * flow.n, 2 * flow.n) }
    }

    /// The inverse of [`Pattern::closing_matrix`]: the mirror is its own.
    pub(crate) fn reopening_matrix(&self, flow: &Flow) -> DMatrix<f64> {
        if self.mirrored {
            flow.reflection(self.closing_stop())
        } else {
            DMatrix::identity(2 * flow.n, 2 * flow.n)
        }
    }

    /// The phase over which it closes.
    pub(crate) fn turn(&self) -> f64 {
        f64::from(self.half_turns) * PI
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_go_from_one_order_to_the_other() {
        let set = StopSet { label_order: Places::from_iter([2, 0, 1]), images: None };
        assert_eq!(set.in_label_order(&[1, 2, 3]), [3, 1, 2]);
        assert_eq!(set.in_plant_order(&[3, 1, 2]), [1, 2, 3]);
        let pattern =
            Pattern { stops: vec![Stop(2), Stop(0), Stop(2)], half_turns: 4, mirrored: false, among: set };
        assert_eq!(
            (pattern.label().as_str(), pattern.counts(), pattern.impacts()),
            ("2-2-1-0", vec![1, 0, 2], 3)
        );
    }

    #[test]
    fn a_mirrored_pattern_counts_its_image_too() {
        let set =
            StopSet { label_order: Places::from_iter([0, 1, 2]), images: Some(Places::from_iter([1, 0, 2])) };
        let pattern = Pattern { stops: vec![Stop(0), Stop(2)], half_turns: 3, mirrored: true, among: set };
        assert_eq!((pattern.label().as_str(), pattern.n()), ("3-1-1-2", 3));
    }
}
