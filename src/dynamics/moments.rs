//! First and second moments of points about one.

use crate::model::{Lanes, State};

/// First and second moments of points, each given by how far it is away from a point of reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<L, const N: usize> {
    /// The sum of them.
    pub sum: State<L, N>,
    /// The sum of the squares of their distances.
    pub square: L,
}

impl<L: Lanes, const N: usize> Moments<L, N> {
    /// Of no points.
    pub fn none(zero: L) -> Self {
        Moments { sum: State { x: [zero; N], v: [zero; N] }, square: zero }
    }

    /// Adds a point in some lanes, with the point of reference.
    #[inline(always)]
    pub fn add(&mut self, which: L::Mask, point: &State<L, N>, about: &State<L, N>) {
        let away = point.plus(self.square.all(-1.0), about);
        self.sum = State::select(which, &self.sum.added(&away), &self.sum);
        self.square = L::select(which, self.square + away.square(), self.square);
    }

    /// Those of one lane.
    pub fn lane(&self, lane: usize) -> Moments<L::Real, N> {
        Moments { sum: self.sum.lane(lane), square: self.square.lane(lane) }
    }

    /// Goes on in a lane from others.
    pub fn set_lane(&mut self, lane: usize, moments: &Moments<L::Real, N>) {
        self.sum.set_lane(lane, &moments.sum);
        self.square.renew_lane(lane, moments.square);
    }
}
