//! Where a motion is along a contact normal.

use super::point::Point;
use crate::model::vector::{MOST, dot};
use crate::model::{ContactNormal, Flight, Lanes, Mask};

/// Where the number of a normal is this one.
#[inline(always)]
pub fn is_normal<L: Lanes>(number: L, k: usize) -> L::Mask {
    let k = k as f64;
    number.all(k - 0.5).below(number).and(number.below(number.all(k + 0.5)))
}

/// d·x and d·v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<L> {
    /// d·x.
    pub place: L,
    /// d·v.
    pub speed: L,
}

impl<L: Lanes> Along<L> {
    /// At a point.
    #[inline(always)]
    pub fn of<const N: usize>(point: &Point<L, N>, normal: &ContactNormal<L, N>) -> Self {
        Along { place: dot(&normal.direction, &point.state.x), speed: dot(&normal.direction, &point.state.v) }
    }

    /// The same along each normal; those from the flight's count on mean nothing.
    #[inline(always)]
    pub fn each<const N: usize>(point: &Point<L, N>, flight: &Flight<L, N>) -> [Self; MOST] {
        let mut each = [Along::of(point, &flight.normals[0]); MOST];
        for k in 1..flight.count {
            each[k] = Along::of(point, &flight.normals[k]);
        }
        each
    }

    /// In one lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Along<L::Real> {
        Along { place: self.place.lane(lane), speed: self.speed.lane(lane) }
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        Along { place: L::select(mask, yes.place, no.place), speed: L::select(mask, yes.speed, no.speed) }
    }

    /// The same along so many normals; the others mean nothing.
    #[inline(always)]
    pub fn select_each(mask: L::Mask, yes: &[Self; MOST], no: &[Self; MOST], count: usize) -> [Self; MOST] {
        let mut each = *no;
        for k in 0..count {
            each[k] = Along::select(mask, &yes[k], &no[k]);
        }
        each
    }
}

/// Just after a contact that was met directly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met<T> {
    /// The normal.
    pub normal: usize,
    /// Where the motion is along each normal: exactly on that one's stop.
    pub along: [Along<T>; MOST],
}
