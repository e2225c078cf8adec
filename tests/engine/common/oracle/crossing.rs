//! The first time at which linear functionals of the state stop being positive.

use super::flow::{Flow, Functional};
use super::linear::Vector;
use super::real::Real;

/// A functional that is watched, from a time on until which it is known to be positive.
#[derive(Debug)]
pub struct Watched<'a, R> {
    /// What is watched.
    pub functional: &'a Functional<R>,
    /// The time since the event from which on its sign is searched.
    pub from: R,
}

/// The first time in (0, `until`] at which one of the functionals reaches zero, and which one does.
pub fn first<R: Real>(
    flow: &Flow<R>,
    start: &Vector<R>,
    watched: &[Watched<'_, R>],
    until: R,
) -> Option<(R, usize)> {
    let zero = R::of(0.0);
    let mut index = 0_usize;
    loop {
        let grid = R::of(index as f64) * flow.step();
        if grid >= until {
            return None;
        }
        let state = flow.sample(start, index);
        let end = least(flow.step(), until - grid);
        let mut found: Option<(R, usize)> = None;
        for (which, Watched { functional, from }) in watched.iter().enumerate() {
            let begin = greatest(zero, *from - grid);
            let curvature = flow.bound(functional, 2, &state);
            if begin >= end || (begin == zero && stays_positive(functional, &state, end.f64(), curvature)) {
                continue;
            }
            let polynomial =
                Polynomial { coefficients: flow.local(&state).polynomial(functional), curvature };
            if let Some(root) = polynomial.first_root(begin, end)
                && found.is_none_or(|(earlier, _)| root < earlier)
            {
                found = Some((root, which));
            }
        }
        if let Some((root, which)) = found {
            return Some((grid + root, which));
        }
        index += 1;
    }
}

/// Whether value, slope and a bound on the curvature prove a functional positive over a whole stretch.
fn stays_positive<R: Real>(
    functional: &Functional<R>,
    state: &Vector<R>,
    width: f64,
    curvature: f64,
) -> bool {
    let value = functional.derivative(0, state).f64();
    let slope = functional.derivative(1, state).f64();
    value + (slope * width).min(0.0) - 0.5 * width * width * curvature > 0.0
}

/// A functional within one step, as a polynomial in time, with a bound on its second derivative there.
#[derive(Debug)]
pub struct Polynomial<R> {
    /// Ascending coefficients.
    pub coefficients: Vec<R>,
    /// Bound on |p''| in the step.
    pub curvature: f64,
}

impl<R: Real> Polynomial<R> {
    fn value(&self, time: R) -> R {
        self.coefficients.iter().rev().fold(R::of(0.0), |sum, &c| sum * time + c)
    }

    fn slope(&self, time: R) -> R {
        let scaled = self.coefficients.iter().enumerate().skip(1).rev();
        scaled.fold(R::of(0.0), |sum, (k, &c)| sum * time + R::of(k as f64) * c)
    }

    /// The first time in [begin, end] at which the polynomial is no longer positive.
    pub fn first_root(&self, begin: R, end: R) -> Option<R> {
        if self.value(begin) > R::of(0.0) { self.search(begin, end) } else { Some(begin) }
    }

    /// Subdivides until every part is proven positive or holds a single, isolated sign change.
    fn search(&self, a: R, b: R) -> Option<R> {
        let zero = R::of(0.0);
        let width = (b - a).f64();
        let (left, right) = (self.value(a).f64(), self.value(b));
        if right > zero && left.min(right.f64()) > 0.125 * width * width * self.curvature {
            return None;
        }
        let middle = (a + b) * R::of(0.5);
        let monotone = self.slope(a).f64().abs() > width * self.curvature;
        if monotone || middle <= a || middle >= b {
            return if right > zero { None } else { Some(self.bisect(a, b)) };
        }
        if self.value(middle) > zero {
            self.search(a, middle).or_else(|| self.search(middle, b))
        } else {
            self.search(a, middle)
        }
    }

    /// The sign change in [a, b], positive at a and not at b, to the last bit.
    fn bisect(&self, mut a: R, mut b: R) -> R {
        loop {
            let middle = (a + b) * R::of(0.5);
            if middle <= a || middle >= b {
                return b;
            }
            if self.value(middle) > R::of(0.0) {
                a = middle;
            } else {
                b = middle;
            }
        }
    }
}

/// The smaller of two numbers.
fn least<R: Real>(a: R, b: R) -> R {
    if b < a { b } else { a }
}

/// The larger of two numbers.
fn greatest<R: Real>(a: R, b: R) -> R {
    if b > a { b } else { a }
}
