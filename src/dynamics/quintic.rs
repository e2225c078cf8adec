//! The gap to a stop along a leg, as the polynomial of fifth degree that agrees with it at both ends.

use crate::model::{Lanes, Mask};

/// A polynomial on 0 ≤ u ≤ 1.
#[derive(Clone, Copy, Debug)]
pub struct Quintic<L>([L; 6]);

/// How far from its narrower end a gap is looked at that is narrowest at an end.
pub const ASIDE: f64 = 0.25;

/// Newton steps to its root, and to where it is narrowest, before the last.
pub const STEPS: usize = 2;

impl<L: Lanes> Quintic<L> {
    /// With the same `places` and `slopes` at the two ends, and such coefficients of u² and u³.
    #[inline(always)]
    pub fn through(places: [L; 2], slopes: [L; 2], [bend, twist]: [L; 2]) -> Self {
        let number = |value: f64| bend.all(value);
        let change = places[1] - places[0] - slopes[0] - bend - twist;
        let rise = twist.times_plus(number(-3.0), slopes[1] - slopes[0] - (bend + bend));
        let fourth = change.times_plus(number(5.0), -rise);
        let fifth = change.times_plus(number(-4.0), rise);
        Quintic([places[0], slopes[0], bend, twist, fourth, fifth])
    }

    /// The cubic with the same `places` and `slopes` at the two ends.
    #[inline(always)]
    pub fn cubic(places: [L; 2], slopes: [L; 2], window: L) -> Self {
        let [leaves, arrives] = [slopes[0] * window, slopes[1] * window];
        let change = places[1] - places[0];
        let bend = change * window.all(3.0) - (leaves + leaves) - arrives;
        let twist = leaves + arrives - (change + change);
        let zero = window.all(0.0);
        Quintic([places[0], leaves, bend, twist, zero, zero])
    }

    /// About where a gap, open at u = 0 and closed beyond u = 1, closes: the root of the parabola with the same places and the
    /// same approach (`approach` = speed · w at u = 0).
    #[inline(always)]
    pub fn chord(gaps: [L; 2], approach: L) -> L {
        let zero = approach.all(0.0);
        let bend = gaps[1] - gaps[0] + approach;
        let discriminant = approach.times_plus(approach, -(zero.all(4.0) * bend * gaps[0]));
        let sum = approach.magnitude() + discriminant.larger(zero).root();
        let double = gaps[0] + gaps[0];
        let approaching = zero.below(approach);
        // The form of the quadratic formula without cancellation, for either sign of the speed.
        let above = L::select(approaching, double, sum);
        let below = L::select(approaching, sum, -(bend + bend));
        above / below
    }

    /// Where the gap closes, by Newton's method from `start`; the last step takes over the slope of the one before.
    #[inline(always)]
    pub fn root(&self, start: L) -> L {
        let (mut u, mut inverse) = (start, start);
        let rise = self.rise();
        for _ in 0..STEPS {
            inverse = u.all(1.0) / cubic(rise, u).times_plus(u, self.0[1]);
            u = (-inverse).times_plus(self.at(u), u);
        }
        (-inverse).times_plus(self.at(u), u)
    }

    /// Where the gap is narrowest if the motion comes near, turns and goes: by Newton's method, from where the chord of the slopes
    /// at both ends is zero, `last` being that at u = 1. Otherwise it may be another extremum, or, where there is none on the way,
    /// [`ASIDE`] from the end where the gap is narrower.
    #[inline(always)]
    pub fn narrowest(&self, last: L) -> Narrowest<L> {
        let slope = self.0[1];
        let rise = self.rise();
        let [first, second, third, fourth] = rise;
        let bends = [first, second + second, third * slope.all(3.0), fourth * slope.all(4.0)];
        let (mut u, mut bend) = (slope / (slope - last), first);
        for _ in 0..STEPS + 1 {
            bend = cubic(bends, u);
            u = u - cubic(rise, u).times_plus(u, slope) / bend;
        }
        let (zero, one) = (u.all(0.0), u.all(1.0));
        let aside = L::select(self.0[0].below(self.at(one)), u.all(ASIDE), u.all(1.0 - ASIDE));
        u = L::select(zero.below(u).and(u.below(one)), u, aside);
        Narrowest { u, gap: self.at(u), bend }
    }

    /// How wide the gap is.
    #[inline(always)]
    fn at(&self, u: L) -> L {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        cubic([c2, c3, c4, c5], u).times_plus(u * u, c1.times_plus(u, c0))
    }

    /// The coefficients of how much its derivative has risen since u = 0, over u.
    #[inline(always)]
    fn rise(&self) -> [L; 4] {
        let [_, _, c2, c3, c4, c5] = self.0;
        [c2 + c2, c3 * c2.all(3.0), c4 * c2.all(4.0), c5 * c2.all(5.0)]
    }
}

/// A polynomial of third degree: by pairs of terms, which wait for each other less than one term after the other does.
#[inline(always)]
fn cubic<L: Lanes>(c: [L; 4], u: L) -> L {
    c[3].times_plus(u, c[2]).times_plus(u * u, c[1].times_plus(u, c[0]))
}

/// Where a gap is narrowest, or near its narrower end.
#[derive(Clone, Copy, Debug)]
pub struct Narrowest<L> {
    /// When.
    pub u: L,
    /// How wide it is there.
    pub gap: L,
    /// Its second derivative before the last of Newton's steps.
    bend: L,
}

impl<L: Lanes> Narrowest<L> {
    /// About where a gap that is closed there opens, beyond.
    #[inline(always)]
    pub fn touch(&self) -> L {
        let zero = self.u.all(0.0);
        self.u + (-(self.gap + self.gap) / self.bend).larger(zero).root()
    }
}

#[cfg(test)]
mod tests;
