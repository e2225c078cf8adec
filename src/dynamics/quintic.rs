//! The gap to a stop along a leg, as the polynomial of fifth degree that agrees with it at both ends.

use crate::model::Lanes;

/// A polynomial in u = s/w, from places, velocities and accelerations at u = 0 and u = 1.
#[derive(Clone, Copy, Debug)]
pub struct Quintic<L>([L; 6]);

/// Newton steps to its root, and to where it is narrowest.
pub const STEPS: usize = 3;

impl<L: Lanes> Quintic<L> {
    /// For a gap that is `gaps` wide at the two ends, approached with `speeds` and the accelerations `pulls`.
    #[inline(always)]
    pub fn through(gaps: [L; 2], speeds: [L; 2], pulls: [L; 2], window: L) -> Self {
        let number = |value: f64| window.all(value);
        let square = window * window;
        let slope = -(speeds[0] * window);
        let bend = -(pulls[0] * square * number(0.5));
        let place = gaps[1] - gaps[0] - slope - bend;
        let arrival = -(speeds[1] * window) - slope - (bend + bend);
        let pull = (-(pulls[1] * square) - (bend + bend)) * number(0.5);
        Quintic([
            gaps[0],
            slope,
            bend,
            place.times_plus(number(10.0), arrival.times_plus(number(-4.0), pull)),
            place.times_plus(number(-15.0), arrival.times_plus(number(7.0), -(pull + pull))),
            place.times_plus(number(6.0), arrival.times_plus(number(-3.0), pull)),
        ])
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

    /// Where the gap closes, by Newton's method from `start`.
    #[inline(always)]
    pub fn root(&self, start: L) -> L {
        let (mut u, slope) = (start, self.0[1]);
        let rise = self.rise();
        for _ in 0..STEPS {
            u = u - self.at(u) / cubic(rise, u).times_plus(u, slope);
        }
        u
    }

    /// Where the gap is narrowest if the motion comes near, turns and goes: by Newton's method, from where the chord of the slopes
    /// at both ends is zero (`departure` = speed · w at u = 1). Otherwise it may be another extremum, or none.
    #[inline(always)]
    pub fn narrowest(&self, departure: L) -> Narrowest<L> {
        let slope = self.0[1];
        let rise = self.rise();
        let [first, second, third, fourth] = rise;
        let bends = [first, second + second, third * slope.all(3.0), fourth * slope.all(4.0)];
        let (mut u, mut bend) = (slope / (slope + departure), first);
        for _ in 0..STEPS {
            bend = cubic(bends, u);
            u = u - cubic(rise, u).times_plus(u, slope) / bend;
        }
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

/// Where a gap is narrowest.
#[derive(Clone, Copy, Debug)]
pub struct Narrowest<L> {
    /// When.
    pub u: L,
    /// How wide it is there.
    pub gap: L,
    /// Its second derivative, before the last of Newton's steps.
    bend: L,
}

impl<L: Lanes> Narrowest<L> {
    /// About where a gap that is closed there closes before.
    #[inline(always)]
    pub fn touch(&self) -> L {
        let zero = self.u.all(0.0);
        self.u - (-(self.gap + self.gap) / self.bend).larger(zero).root()
    }
}

#[cfg(test)]
mod tests;
