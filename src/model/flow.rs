//! The flow of free flight as one linear system in (x, v, sin φ, cos φ, 1).

use nalgebra::SMatrix;

use super::free_flight::FreeFlight;
use super::real::{Lanes, Mask};
use super::state::State;

/// x, v, and what the forcing and the constant load multiply; of several states side by side, one in each lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Augmented<L, const N: usize> {
    /// Displacements.
    pub x: [L; N],
    /// Velocities.
    pub v: [L; N],
    /// sin φ.
    pub sin: L,
    /// cos φ.
    pub cos: L,
    /// 1, the factor of the constant load.
    pub one: L,
}

impl<L: Lanes<Real = f64>, const N: usize> Augmented<L, N> {
    /// The same number everywhere.
    #[inline(always)]
    pub fn all(value: L) -> Self {
        Augmented { x: [value; N], v: [value; N], sin: value, cos: value, one: value }
    }

    /// Component `i` of (x, v, sin φ, cos φ, 1), to be changed.
    #[inline(always)]
    pub fn component(&mut self, i: usize) -> &mut L {
        let Augmented { x, v, sin, cos, one } = self;
        x.iter_mut().chain(v).chain([sin, cos, one]).nth(i).expect("there are 2N + 3 of them")
    }

    /// The displacements and velocities.
    #[inline(always)]
    pub(super) fn mechanical(&self) -> State<L, N> {
        State { x: self.x, v: self.v }
    }

    /// The largest modulus of a component, of those of the phase the given share; those are left out that are not numbers.
    #[inline(always)]
    fn amax(&self, weight: f64) -> L {
        // The larger of two is the second where either is not a number: a series with an infinite load goes on, and shows it.
        let mut most = self.sin.all(0.0);
        for value in [self.sin, self.cos, self.one] {
            most = (value.magnitude() * value.all(weight)).larger(most);
        }
        for i in 0..N {
            most = self.x[i].magnitude().larger(most);
            most = self.v[i].magnitude().larger(most);
        }
        most
    }

    /// Its derivative in free flight, times a factor.
    #[inline(always)]
    fn derived(&self, free: &FreeFlight<N>, factor: f64) -> Self {
        let Augmented { x, v, sin, cos, .. } = *self;
        let factor = sin.all(factor);
        let omega = sin.all(free.omega);
        let mut derived = Augmented { x: v, v, sin: omega * cos, cos: -omega * sin, one: sin.all(0.0) };
        let [stiffness, damping] = [applied(&free.stiffness, &x), applied(&free.damping, &v)];
        for i in 0..N {
            derived.v[i] = stiffness[i]
                + damping[i]
                + sin.all(free.sin[i]) * sin
                + sin.all(free.cos[i]) * cos
                + sin.all(free.load[i]) * self.one;
            derived.x[i] = derived.x[i] * factor;
            derived.v[i] = derived.v[i] * factor;
        }
        derived.sin = derived.sin * factor;
        derived.cos = derived.cos * factor;
        derived
    }

    /// self + other where the mask holds, self elsewhere.
    #[inline(always)]
    fn added_where(&self, mask: L::Mask, other: &Self) -> Self {
        let mut sum = *self;
        for i in 0..N {
            sum.x[i] = L::select(mask, self.x[i] + other.x[i], self.x[i]);
            sum.v[i] = L::select(mask, self.v[i] + other.v[i], self.v[i]);
        }
        sum.sin = L::select(mask, self.sin + other.sin, self.sin);
        sum.cos = L::select(mask, self.cos + other.cos, self.cos);
        sum.one = L::select(mask, self.one + other.one, self.one);
        sum
    }
}

/// A matrix times vectors side by side; each product and each sum is rounded.
#[inline(always)]
fn applied<L: Lanes, const N: usize>(matrix: &SMatrix<f64, N, N>, x: &[L; N]) -> [L; N] {
    let mut sum = *x;
    for i in 0..N {
        sum[i] = x[0].all(matrix[(i, 0)]) * x[0];
        for j in 1..N {
            sum[i] = sum[i] + x[j].all(matrix[(i, j)]) * x[j];
        }
    }
    sum
}

/// The terms Gᵏ z tᵏ/k! of exp(G t) z in free flight, in each lane until they vanish against their sum.
struct Series<'a, L: Lanes, const N: usize> {
    free: &'a FreeFlight<N>,
    t: f64,
    /// k + 1.
    next: f64,
    term: Augmented<L, N>,
    /// The largest component of any of them so far.
    size: L,
    /// Where they do not vanish yet.
    counts: L::Mask,
}

impl<'a, L: Lanes<Real = f64>, const N: usize> Series<'a, L, N> {
    #[inline(always)]
    fn of(free: &'a FreeFlight<N>, t: f64, z: Augmented<L, N>) -> Self {
        let counts = z.one.all(0.0).below(z.one.all(1.0));
        Series { free, t, next: 1.0, term: z, size: z.amax(free.weight), counts }
    }

    /// Goes on to the next term, and says whether it counts anywhere.
    #[inline(always)]
    fn advance(&mut self) -> bool {
        self.term = self.term.derived(self.free, self.t / self.next);
        self.next += 1.0;
        let length = self.term.amax(self.free.weight);
        self.size = length.larger(self.size);
        self.counts = self.counts.and((self.size.all(1e-19) * self.size).below(length));
        self.counts.bits() != 0
    }
}

/// The terms Gᵏ z tᵏ/k! of exp(G t) z in free flight, until they vanish against their sum.
pub fn series<const N: usize>(
    free: &FreeFlight<N>,
    t: f64,
    z: Augmented<f64, N>,
) -> impl Iterator<Item = Augmented<f64, N>> {
    let mut terms = Series::of(free, t, z);
    std::iter::once(z).chain(std::iter::from_fn(move || terms.advance().then_some(terms.term)))
}

/// exp(G t) z in free flight.
#[inline(always)]
pub fn over<L: Lanes<Real = f64>, const N: usize>(
    free: &FreeFlight<N>,
    t: f64,
    z: Augmented<L, N>,
) -> Augmented<L, N> {
    let mut terms = Series::of(free, t, z);
    let mut sum = Augmented::all(z.one.all(0.0)).added_where(terms.counts, &z);
    while terms.advance() {
        sum = sum.added_where(terms.counts, &terms.term);
    }
    sum
}
