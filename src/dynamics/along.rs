//! Where a motion is along contact normals.

use std::ops::Index;

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
}

/// Where a motion is along each normal.
///
/// How many normals there are goes along with it: where the compiler knows that, what there is along each is in registers, and
/// nothing waits for memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alongs<L> {
    /// Those from the count on mean nothing.
    each: [Along<L>; MOST],
    /// How many normals there are.
    pub count: usize,
}

impl<L: Lanes> Alongs<L> {
    /// The same along so many normals.
    #[inline(always)]
    pub fn all(along: Along<L>, count: usize) -> Self {
        Alongs { each: [along; MOST], count }
    }

    /// At a point, along the normals of a flight, which are so many.
    #[inline(always)]
    pub fn of<const N: usize>(point: &Point<L, N>, flight: &Flight<L, N>, count: usize) -> Self {
        debug_assert_eq!(count, flight.count);
        let mut alongs = Alongs::all(Along::of(point, &flight.normals[0]), count);
        for k in 1..count {
            alongs.each[k] = Along::of(point, &flight.normals[k]);
        }
        alongs
    }

    /// Says where it is along one of them.
    #[inline(always)]
    pub fn set(&mut self, k: usize, along: Along<L>) {
        self.each[k] = along;
    }

    /// In one lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Alongs<L::Real> {
        Alongs { each: self.each.map(|along| along.lane(lane)), count: self.count }
    }

    /// `yes` where the mask holds, `no` elsewhere; of either along as many normals.
    #[inline(always)]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        debug_assert_eq!(yes.count, no.count);
        let mut each = no.each;
        for k in 0..yes.count {
            each[k] = Along::select(mask, &yes.each[k], &no.each[k]);
        }
        Alongs { each, count: yes.count }
    }
}

impl<L> Index<usize> for Alongs<L> {
    type Output = Along<L>;

    #[inline(always)]
    fn index(&self, k: usize) -> &Along<L> {
        &self.each[k]
    }
}

/// Just after a contact that was met directly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met<T> {
    /// The normal.
    pub normal: usize,
    /// Where the motion is along each normal: exactly on that one's stop.
    pub along: Alongs<T>,
}
