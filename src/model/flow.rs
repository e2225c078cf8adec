//! The flow of free flight and of sticking as one linear system in (x, v, sin φ, cos φ, 1).

use nalgebra::{SMatrix, SVector};

use super::equations::Equations;
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

    /// The largest component.
    #[inline(always)]
    fn amax(&self) -> L {
        let mut most = self.sin.magnitude().larger(self.cos.magnitude()).larger(self.one.magnitude());
        for i in 0..N {
            most = most.larger(self.x[i].magnitude()).larger(self.v[i].magnitude());
        }
        most
    }

    /// Its derivative in free flight, times a factor.
    #[inline(always)]
    fn derived(&self, equations: &Equations<N>, factor: f64) -> Self {
        let Augmented { x, v, sin, cos, .. } = *self;
        let factor = sin.all(factor);
        let omega = sin.all(equations.omega);
        let mut derived = Augmented { x: v, v, sin: omega * cos, cos: -omega * sin, one: sin.all(0.0) };
        let [stiffness, damping] = [applied(&equations.stiffness, &x), applied(&equations.damping, &v)];
        for i in 0..N {
            derived.v[i] = stiffness[i]
                + damping[i]
                + sin.all(equations.sin[i]) * sin
                + sin.all(equations.cos[i]) * cos
                + sin.all(equations.load[i]) * self.one;
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
        let added = |own: L, other: L| L::select(mask, own + other, own);
        let mut sum = *self;
        for i in 0..N {
            sum.x[i] = added(sum.x[i], other.x[i]);
            sum.v[i] = added(sum.v[i], other.v[i]);
        }
        sum.sin = added(sum.sin, other.sin);
        sum.cos = added(sum.cos, other.cos);
        sum.one = added(sum.one, other.one);
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
struct Terms<'a, L: Lanes, const N: usize> {
    equations: &'a Equations<N>,
    t: f64,
    /// k + 1.
    next: f64,
    term: Augmented<L, N>,
    /// The largest component of any of them so far.
    size: L,
    /// Where they do not vanish yet.
    counts: L::Mask,
}

impl<'a, L: Lanes<Real = f64>, const N: usize> Terms<'a, L, N> {
    #[inline(always)]
    fn of(equations: &'a Equations<N>, t: f64, z: Augmented<L, N>) -> Self {
        let counts = z.one.all(0.0).below(z.one.all(1.0));
        Terms { equations, t, next: 1.0, term: z, size: z.amax(), counts }
    }

    /// Goes on to the next term, and says whether it counts anywhere.
    #[inline(always)]
    fn advance(&mut self) -> bool {
        self.term = self.term.derived(self.equations, self.t / self.next);
        self.next += 1.0;
        let length = self.term.amax();
        self.size = self.size.larger(length);
        self.counts = self.counts.and((self.size.all(1e-19) * self.size).below(length));
        self.counts.bits() != 0
    }
}

/// The terms of one state.
pub fn series<const N: usize>(
    equations: &Equations<N>,
    t: f64,
    z: Augmented<f64, N>,
) -> impl Iterator<Item = Augmented<f64, N>> {
    let mut terms = Terms::of(equations, t, z);
    std::iter::once(z).chain(std::iter::from_fn(move || terms.advance().then_some(terms.term)))
}

/// exp(G t) z in free flight.
#[inline(always)]
pub fn over<L: Lanes<Real = f64>, const N: usize>(
    equations: &Equations<N>,
    t: f64,
    z: Augmented<L, N>,
) -> Augmented<L, N> {
    let mut terms = Terms::of(equations, t, z);
    let mut sum = Augmented::all(z.one.all(0.0)).added_where(terms.counts, &z);
    while terms.advance() {
        sum = sum.added_where(terms.counts, &terms.term);
    }
    sum
}

/// The terms f Gᵏ (−t)ᵏ/k! of f exp(−G t) in free flight, until they vanish against their sum: what the functional f was a time t
/// ago.
pub fn series_back<const N: usize>(
    equations: &Equations<N>,
    t: f64,
    f: Functional<N>,
) -> impl Iterator<Item = Functional<N>> {
    let mut size = f.amax();
    std::iter::successors(Some((1.0, f)), move |(k, term)| {
        let next = term.derived(equations, &SMatrix::identity()).scaled(-t / k);
        let length = next.amax();
        size = size.max(length);
        (length > 1e-19 * size).then_some((k + 1.0, next))
    })
    .map(|(_, term)| term)
}

/// A linear functional of a state: what multiplies x, v, sin φ, cos φ and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Functional<const N: usize> {
    /// Of the displacements.
    pub x: SVector<f64, N>,
    /// Of the velocities.
    pub v: SVector<f64, N>,
    /// Of sin φ.
    pub sin: f64,
    /// Of cos φ.
    pub cos: f64,
    /// The coefficient of the constant 1.
    pub one: f64,
}

impl<const N: usize> Functional<N> {
    /// `row` · a, with a the accelerations of free flight.
    pub fn of_acceleration(equations: &Equations<N>, row: &SVector<f64, N>) -> Self {
        Functional {
            x: equations.stiffness.tr_mul(row),
            v: equations.damping.tr_mul(row),
            sin: row.dot(&equations.sin),
            cos: row.dot(&equations.cos),
            one: row.dot(&equations.load),
        }
    }

    /// The functional of the derivative, on a motion whose accelerations are `projector` times those of free flight
    /// and whose velocities lie in its range: functional · G.
    fn derived(&self, equations: &Equations<N>, projector: &SMatrix<f64, N, N>) -> Self {
        let row = projector.tr_mul(&self.v);
        Functional {
            x: equations.stiffness.tr_mul(&row),
            v: projector.tr_mul(&self.x) + equations.damping.tr_mul(&row),
            sin: row.dot(&equations.sin) - equations.omega * self.cos,
            cos: row.dot(&equations.cos) + equations.omega * self.sin,
            one: row.dot(&equations.load),
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Functional {
            x: self.x * factor,
            v: self.v * factor,
            sin: self.sin * factor,
            cos: self.cos * factor,
            one: self.one * factor,
        }
    }

    fn abs(&self) -> Self {
        Functional {
            x: self.x.abs(),
            v: self.v.abs(),
            sin: self.sin.abs(),
            cos: self.cos.abs(),
            one: self.one.abs(),
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Functional {
            x: self.x + other.x,
            v: self.v + other.v,
            sin: self.sin + other.sin,
            cos: self.cos + other.cos,
            one: self.one + other.one,
        }
    }

    fn amax(&self) -> f64 {
        self.x.amax().max(self.v.amax()).max(self.sin.abs()).max(self.cos.abs()).max(self.one.abs())
    }

    /// The larger of two, component by component.
    pub fn sup(&self, other: &Self) -> Self {
        Functional {
            x: self.x.sup(&other.x),
            v: self.v.sup(&other.v),
            sin: self.sin.max(other.sin),
            cos: self.cos.max(other.cos),
            one: self.one.max(other.one),
        }
    }
}

/// A bound on the second derivative of a functional for every time |s| ≤ t from a state of a motion, component by component:
/// Σ tᵏ/k! |functional · Gᵏ⁺²|.
pub fn second_derivative_bound<const N: usize>(
    equations: &Equations<N>,
    projector: &SMatrix<f64, N, N>,
    functional: &Functional<N>,
    t: f64,
) -> Functional<N> {
    let mut term = functional.derived(equations, projector).derived(equations, projector);
    let mut sum = term.abs();
    for k in 1..64 {
        term = term.derived(equations, projector).scaled(t / f64::from(k));
        sum = sum.plus(&term.abs());
        if term.amax() <= 1e-12 * sum.amax() {
            break;
        }
    }
    sum
}
