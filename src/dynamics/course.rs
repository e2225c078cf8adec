//! How a step of free flight goes along a contact normal: d·x, a polynomial in what is left of the step, from the step's end.

use super::along::Along;
use super::point::Point;
use crate::model::{BACK_TERMS, Flight, Lanes, Real, Row};

/// The coefficients of uᵏ in d·x, u = s/h being the share of the step that is left, 0 ≤ u ≤ 1, but for what it is at the end of the
/// step; see [`ContactNormal::back`](crate::model::ContactNormal::back).
#[derive(Clone, Copy, Debug)]
pub struct Course<L>([L; BACK_TERMS]);

/// The course about a time: of d·x what multiplies wᵏ when u changes by w.
#[derive(Clone, Copy, Debug)]
pub struct Here<L>([L; NEAR]);

/// As many as matter near by: the next is lost in rounding.
const NEAR: usize = 5;
/// The terms of a cubic.
const BEGUN: usize = 4;

impl<L: Lanes> Course<L> {
    /// Of the step that ends at a point, with a `speed` along one normal, as it would go without another impact.
    #[inline(always)]
    pub fn to<const N: usize>(end: &Point<L, N>, speed: L, flight: &Flight<L, N>, k: usize) -> Self {
        Course::begun(end, speed, flight, k).completed(end, flight, k)
    }

    /// Of that the terms of a cubic alone, which can be had sooner.
    #[inline(always)]
    pub fn begun<const N: usize>(end: &Point<L, N>, speed: L, flight: &Flight<L, N>, k: usize) -> Self {
        let mut terms = [-(speed * flight.h); BACK_TERMS];
        for term in 2..BEGUN {
            terms[term] = term_of(&flight.normals[k].back[term], end);
        }
        Course(terms)
    }

    /// With the terms that are missing then.
    #[inline(always)]
    #[must_use]
    pub fn completed<const N: usize>(mut self, end: &Point<L, N>, flight: &Flight<L, N>, k: usize) -> Self {
        for term in BEGUN..L::Real::BACK_ORDER + 1 {
            self.0[term] = term_of(&flight.normals[k].back[term], end);
        }
        self
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        let mut terms = no.0;
        for k in 0..L::Real::BACK_ORDER + 1 {
            terms[k] = L::select(mask, yes.0[k], no.0[k]);
        }
        Course(terms)
    }

    /// What multiplies u² and u³.
    #[inline(always)]
    pub fn bends(&self) -> [L; 2] {
        [self.0[2], self.0[3]]
    }

    /// About where the share u is left, on the way from a `place` where the share `since` was: d·x changes by u − since times a
    /// polynomial, the quotient of Horner's scheme there. So it is as exact as that change, which may be far less than what the
    /// step would come to without an impact.
    #[inline(always)]
    pub fn about(&self, u: L, [since, place]: [L; 2]) -> Here<L> {
        let order = L::Real::BACK_ORDER;
        let mut quotient = self.0[order];
        let mut slopes = [quotient; NEAR];
        for k in (1..order).rev() {
            quotient = quotient.times_plus(since, self.0[k]);
            carry_on(&mut slopes, order - k, u, quotient);
        }
        let way = u - since;
        let mut here = [way.times_plus(slopes[0], place); NEAR];
        for k in 1..NEAR {
            here[k] = way.times_plus(slopes[k], slopes[k - 1]);
        }
        Here(here)
    }
}

/// What a row makes of a point.
#[inline(always)]
fn term_of<L: Lanes, const N: usize>(row: &Row<L, N>, point: &Point<L, N>) -> L {
    let mut sum = point.cos.times_plus(row.cos, point.sin.times_plus(row.sin, row.one));
    for i in 0..N {
        sum = point.state.x[i].times_plus(row.state.x[i], sum);
    }
    for i in 0..N {
        sum = point.state.v[i].times_plus(row.state.v[i], sum);
    }
    sum
}

/// The next step of Horner's scheme, with the next coefficient, for a polynomial's value at u, for that of the quotient, and so on,
/// of which so many have begun.
#[inline(always)]
fn carry_on<L: Lanes>(values: &mut [L; NEAR], begun: usize, u: L, next: L) {
    for j in (0..NEAR).rev() {
        let next = if j == 0 { next } else { values[j - 1] };
        if j < begun {
            values[j] = values[j].times_plus(u, next);
        } else if j == begun {
            values[j] = next;
        }
    }
}

impl<L: Lanes> Here<L> {
    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        let mut terms = no.0;
        for k in 0..NEAR {
            terms[k] = L::select(mask, yes.0[k], no.0[k]);
        }
        Here(terms)
    }

    /// Where the motion is.
    #[inline(always)]
    pub fn along<const N: usize>(&self, flight: &Flight<L, N>) -> Along<L> {
        Along { place: self.0[0], speed: -(self.0[1] * flight.inverse_h) }
    }

    /// By how much the share changes that is left until d·x is at a place near by: along the parabola, nearly, and by one of
    /// Newton's steps on the cubic.
    #[inline(always)]
    pub fn change_to(&self, place: L) -> L {
        let [here, slope, bend, twist, _] = self.0;
        let left = place - here;
        let inverse = slope.all(1.0) / slope;
        let straight = left * inverse;
        let bent = bend * inverse * straight;
        let nearly = (bent + bent).times_plus(bent, -bent).times_plus(straight, straight);
        let far = twist.times_plus(nearly, bend).times_plus(nearly, slope);
        let steep = (twist * left.all(3.0)).times_plus(nearly, bend + bend).times_plus(nearly, slope);
        nearly - far.times_plus(nearly, -left) / steep
    }

    /// About the place after such a change.
    #[inline(always)]
    pub fn changed(&self, by: L) -> Self {
        let mut here = [self.0[NEAR - 1]; NEAR];
        for k in (0..NEAR - 1).rev() {
            carry_on(&mut here, NEAR - 1 - k, by, self.0[k]);
        }
        Here(here)
    }

    /// d·x''.
    #[inline(always)]
    pub fn pull<const N: usize>(&self, flight: &Flight<L, N>) -> L {
        let bend = self.0[2];
        (bend + bend) * (flight.inverse_h * flight.inverse_h)
    }
}

#[cfg(test)]
mod tests;
