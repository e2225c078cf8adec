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
        let Quintic(c) = self;
        let mut u = start;
        let (twice, thrice) = (c[2] + c[2], c[3] * u.all(3.0));
        let (four, five) = (c[4] * u.all(4.0), c[5] * u.all(5.0));
        for _ in 0..STEPS {
            // By pairs of terms, which wait for each other less than one term after the other does.
            let square = u * u;
            let high = c[5].times_plus(u, c[4]).times_plus(square, c[3].times_plus(u, c[2]));
            let value = high.times_plus(square, c[1].times_plus(u, c[0]));
            let steep = five.times_plus(u, four).times_plus(square, thrice.times_plus(u, twice));
            u = u - value / steep.times_plus(u, c[1]);
        }
        u
    }

    /// Where the gap is narrowest if the motion comes near, turns and goes: by Newton's method, from where the chord of the slopes
    /// at both ends is zero (`departure` = speed · w at u = 1). Otherwise it may be another extremum, or none.
    #[inline(always)]
    pub fn narrowest(&self, departure: L) -> Narrowest<L> {
        let Quintic(c) = self;
        let (twice, thrice) = (c[2] + c[2], c[3] * departure.all(3.0));
        let (four, five) = (c[4] * departure.all(4.0), c[5] * departure.all(5.0));
        let (six, twelve, twenty) = (thrice + thrice, four * departure.all(3.0), five * departure.all(4.0));
        let mut u = c[1] / (c[1] + departure);
        let mut bend = twice;
        for _ in 0..STEPS {
            let square = u * u;
            let steep = five.times_plus(u, four).times_plus(square, thrice.times_plus(u, twice));
            bend = twenty.times_plus(u, twelve).times_plus(square, six.times_plus(u, twice));
            u = u - steep.times_plus(u, c[1]) / bend;
        }
        let square = u * u;
        let high = c[5].times_plus(u, c[4]).times_plus(square, c[3].times_plus(u, c[2]));
        Narrowest { u, gap: high.times_plus(square, c[1].times_plus(u, c[0])), bend }
    }
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
