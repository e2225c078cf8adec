//! The impacts of a periodic motion in their order, and how the last joins the first.

use nalgebra::Vector4;

use super::flow::{PHASE, Section};
use super::matching::Node;
use crate::dynamics::Stop;

/// Which stops a motion strikes, in order, and how it closes on itself.
///
/// A symmetric motion is described by half of it: after an odd number of half forcing periods it is its own mirror
/// image, x(t + Nπ/ω) = −x(t).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Pattern {
    /// The stops of the impacts: of one period of the motion, or of half of it where it is `mirrored`.
    pub stops: Vec<Stop>,
    /// After how many half forcing periods it closes: 2N, or N where it is `mirrored`.
    pub half_turns: u32,
    /// Whether it closes on its mirror image.
    pub mirrored: bool,
}

impl Pattern {
    /// N: the motion repeats after so many forcing periods.
    pub fn n(&self) -> u32 {
        if self.mirrored { self.half_turns } else { self.half_turns / 2 }
    }

    /// p: impacts at Ā in one period of the motion.
    pub fn p(&self) -> u32 {
        self.impacts_at(Stop::B)
    }

    /// q: impacts at A in one period of the motion.
    pub fn q(&self) -> u32 {
        self.impacts_at(Stop::A)
    }

    /// Impacts in one period of the motion.
    pub fn impacts(&self) -> u32 {
        self.p() + self.q()
    }

    fn impacts_at(&self, stop: Stop) -> u32 {
        let seen = |stop: Stop| self.stops.iter().filter(|&&other| other == stop).count() as u32;
        if self.mirrored { seen(Stop::A) + seen(Stop::B) } else { seen(stop) }
    }

    /// N-p-q, as text.
    pub fn label(&self) -> String {
        format!("{}-{}-{}", self.n(), self.p(), self.q())
    }

    /// The first impact, as it is met again at the end.
    pub(crate) fn closing(&self, first: &Section) -> Node {
        let turned = f64::from(self.half_turns) * std::f64::consts::PI;
        let mut section = self.closing_factors().component_mul(first);
        section[PHASE] += turned;
        let stop = if self.mirrored { opposite(self.stops[0]) } else { self.stops[0] };
        Node { stop, section }
    }

    /// What the components of the first impact are multiplied by where it is met again.
    pub(crate) fn closing_factors(&self) -> Vector4<f64> {
        let factor = if self.mirrored { -1.0 } else { 1.0 };
        Vector4::new(factor, factor, factor, 1.0)
    }
}

/// The other stop.
pub(crate) fn opposite(stop: Stop) -> Stop {
    if stop == Stop::A { Stop::B } else { Stop::A }
}
