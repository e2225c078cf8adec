//! What bounds a number of a motion for less than a step: a sum over the moduli of its state.

use super::real::{Lanes, Real};
use super::row::Row;
use super::vector::{MOST, absolute_onto};

/// Sets of contacts along all normals but one.
pub const OTHERS: usize = sets_of_others(MOST);

/// The same where there are so many normals.
pub const fn sets_of_others(normals: usize) -> usize {
    1 << (normals - 1)
}

/// Which of them holds, of those that `held` says, bit by bit: its bits but that of the normal.
#[inline(always)]
pub fn others(held: u32, normal: usize) -> usize {
    let below = held & ((1 << normal) - 1);
    (below | (held >> (normal + 1)) << normal) as usize
}

/// |f| ≤ x·|x| + v·|v| + forcing within one step from a state, and to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound<T, const N: usize> {
    /// What multiplies the displacements.
    pub x: [T; N],
    /// What multiplies the velocities.
    pub v: [T; N],
    /// What forcing and loads add.
    pub forcing: T,
}

impl<T: Copy, const N: usize> Bound<T, N> {
    /// Every number alike.
    pub(super) fn all(value: T) -> Self {
        Bound { x: [value; N], v: [value; N], forcing: value }
    }
}

impl<L: Lanes, const N: usize> Bound<L, N> {
    /// For a state; `forcing` stands for that of the bound.
    #[inline(always)]
    pub fn of(&self, x: &[L; N], v: &[L; N], forcing: L) -> L {
        absolute_onto(&self.x, x, forcing) + absolute_onto(&self.v, v, forcing.all(0.0))
    }
}

impl<const N: usize> Bound<f64, N> {
    /// Of what is at most so much by each number of its state, forcing phasor and 1.
    pub(super) fn by(row: &Row<f64, N>) -> Self {
        Bound { x: row.state.x, v: row.state.v, forcing: libm::hypot(row.sin, row.cos) + row.one }
    }

    /// Rounded to another precision.
    pub(super) fn round<T: Real>(&self) -> Bound<T, N> {
        Bound { x: self.x.map(T::of), v: self.v.map(T::of), forcing: T::of(self.forcing) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_with_a_normal_is_known_by_its_others() {
        assert_eq!([0b0001, 0b0011, 0b1011, 0b1111].map(|held| others(held, 0)), [0, 1, 5, 7]);
        assert_eq!([0b0010, 0b0011, 0b1011, 0b1111].map(|held| others(held, 1)), [0, 1, 5, 7]);
        assert_eq!([0b1000, 0b1001, 0b1101, 0b1111].map(|held| others(held, 3)), [0, 1, 5, 7]);
    }
}
