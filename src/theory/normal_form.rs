//! How a motion loses its stability: the normal-form coefficient, and super- or subcritical from its sign.
//!
//! The coefficients of period doublings, pitchforks and Neimark–Sacker bifurcations of maps: Yu. A. Kuznetsov, Elements of
//! Applied Bifurcation Theory, Springer (2004), chapters 4 and 5, doi:10.1007/978-1-4757-3978-7.

use nalgebra::{Complex, ComplexField, DMatrix, DVector};

use super::flow::Flow;
use super::jet;
use super::motion::PeriodicMotion;
use super::multipliers::turn;
use super::section_vector::{SectionVector, in_units, magnified};
use crate::model::System;

type ComplexSection = DVector<Complex<f64>>;

/// The normal forms of the map of one turn around a motion: from its second and third derivatives B and C, which follow from
/// exact series along single directions. Displacements and velocities of the map, and of all directions, are in units of `unit`.
pub(crate) struct NormalForm<'a> {
    pub flow: &'a Flow,
    pub motion: &'a PeriodicMotion,
    /// What is of order one on the motion.
    pub unit: f64,
    /// The Jacobian of the turn in units of that; see [`in_units`].
    pub map: &'a DMatrix<f64>,
}

/// What B and C make of a direction d.
struct Direction {
    vector: SectionVector,
    /// B(d, d).
    square: SectionVector,
    /// C(d, d, d).
    cube: SectionVector,
}

impl NormalForm<'_> {
    fn direction(&self, vector: SectionVector) -> Option<Direction> {
        let PeriodicMotion { pattern, sections, .. } = self.motion;
        let unit = self.unit;
        let [_, _, second, third] = jet::turn(self.flow, pattern, sections, &magnified(&vector, unit))?;
        let [second, third] = [second, third].map(|term| magnified(&term, 1.0 / unit));
        Some(Direction { vector, square: second * 2.0, cube: third * 6.0 })
    }

    /// B(a, b), by polarisation.
    fn bilinear(&self, a: &Direction, b: &Direction) -> Option<SectionVector> {
        let sum = self.direction(&a.vector + &b.vector)?;
        Some((sum.square - &a.square - &b.square) * 0.5)
    }

    /// As [`flip_coefficient`].
    pub fn flip(&self) -> Option<f64> {
        let (q, p) = real_eigenvectors(self.map, -1.0)?;
        let q = self.direction(q)?;
        let shift =
            (DMatrix::identity(self.map.nrows(), self.map.ncols()) - self.map).lu().solve(&q.square)?;
        let c = (p.dot(&q.cube) + 3.0 * p.dot(&self.bilinear(&q, &self.direction(shift)?)?)) / 6.0;
        c.is_finite().then_some(c)
    }

    /// As [`fold_coefficient`].
    pub fn fold(&self, along: &SectionVector) -> Option<f64> {
        let (q, p) = real_eigenvectors(self.map, 1.0)?;
        let side = q.dot(along).signum();
        let a = 0.5 * p.dot(&self.direction(q)?.square) * side;
        a.is_finite().then_some(a)
    }

    /// As [`neimark_sacker_coefficient`].
    pub fn neimark_sacker(&self, theta: f64) -> Option<f64> {
        let turned = Complex::new(libm::cos(theta), libm::sin(theta));
        let resonance = |m: i32| (turned.powi(m) - 1.0).modulus() < 1e-6;
        if (1..=4).any(resonance) {
            return None;
        }
        let complex_map = self.map.map(|value| Complex::new(value, 0.0));
        let q = null_vector(&complex_map, turned)?;
        let p = null_vector(&complex_map.transpose(), turned.conj())?;
        let scale = p.dotc(&q);
        let p = p.map(|z| z / scale.conj());
        // q = a + ib.
        let [a, b] = [self.direction(q.map(|z| z.re))?, self.direction(q.map(|z| z.im))?];
        let sum = self.direction(&a.vector + &b.vector)?;
        let difference = self.direction(&a.vector - &b.vector)?;
        let (size, _) = self.map.shape();
        let inner = (DMatrix::identity(size, size) - self.map).lu().solve(&(&a.square + &b.square))?;
        let square = complex(&(&a.square - &b.square), &(&sum.square - &a.square - &b.square));
        let outer = (DMatrix::identity(size, size) * (turned * turned) - &complex_map).lu().solve(&square)?;
        // C(q, q, q̄), B(q, inner) and B(q̄, outer), inner being real.
        let own = complex(
            &(&a.cube + (&sum.cube + &difference.cube - &a.cube * 2.0) / 6.0),
            &(&b.cube + (&sum.cube - &difference.cube - &b.cube * 2.0) / 6.0),
        );
        let h = self.direction(inner)?;
        let with_inner = complex(&self.bilinear(&a, &h)?, &self.bilinear(&b, &h)?);
        let [real, imaginary] = [self.direction(outer.map(|z| z.re))?, self.direction(outer.map(|z| z.im))?];
        let with_outer = complex(
            &(self.bilinear(&a, &real)? + self.bilinear(&b, &imaginary)?),
            &(self.bilinear(&a, &imaginary)? - self.bilinear(&b, &real)?),
        );
        let cubic = own + with_inner * Complex::new(2.0, 0.0) + with_outer;
        let d = 0.5 * (turned.conj() * p.dotc(&cubic)).re;
        d.is_finite().then_some(d)
    }
}

/// The coefficient whose sign decides what happens at a multiplier −1: for a period doubling, or a symmetric
/// motion's pitchfork (of the half map), c of ξ → −ξ + cξ³.
///
/// c > 0 is supercritical: a stable motion of twice the period (or two mirrored ones) takes over. None where an
/// impact grazes or another multiplier is ±1.
pub fn flip_coefficient(system: &System, motion: &PeriodicMotion) -> Option<f64> {
    of_motion(system, motion, |form| form.flip())
}

/// The quadratic coefficient at a multiplier +1, a of ξ → ξ + aξ²; zero at a cusp. None as for
/// [`flip_coefficient`].
///
/// The direction of ξ is that of the two null vectors on whose side `along` lies; the sign of a depends on it.
pub fn fold_coefficient(system: &System, motion: &PeriodicMotion, along: &SectionVector) -> Option<f64> {
    of_motion(system, motion, |form| form.fold(&magnified(along, 1.0 / form.unit)))
}

/// Re d at a pair of multipliers e^(±iθ), θ in (0, π), d of z → e^(iθ) z (1 + d|z|²).
///
/// Re d < 0 is supercritical: a stable invariant circle takes over. None where an impact grazes, at θ of 0, π and
/// (the strong resonances) π/2 and 2π/3 within 1e-6.
pub fn neimark_sacker_coefficient(system: &System, motion: &PeriodicMotion, theta: f64) -> Option<f64> {
    of_motion(system, motion, |form| form.neimark_sacker(theta))
}

fn of_motion(
    system: &System,
    motion: &PeriodicMotion,
    coefficient: impl Fn(&NormalForm<'_>) -> Option<f64>,
) -> Option<f64> {
    let flow = Flow::new(system);
    let unit = flow.unit();
    let map = in_units(turn(&flow, &motion.pattern, &motion.sections)?, unit);
    coefficient(&NormalForm { flow: &flow, motion, unit, map: &map })
}

fn complex(real: &SectionVector, imaginary: &SectionVector) -> ComplexSection {
    real.zip_map(imaginary, Complex::new)
}

/// Right and left eigenvectors q and p of a real multiplier, |q| = 1 and p·q = 1.
fn real_eigenvectors(map: &DMatrix<f64>, multiplier: f64) -> Option<(SectionVector, SectionVector)> {
    let complex = map.map(|value| Complex::new(value, 0.0));
    let value = Complex::new(multiplier, 0.0);
    let real = |v: ComplexSection| {
        let largest =
            v.iter().copied().max_by(|a, b| a.modulus().total_cmp(&b.modulus())).unwrap_or_default();
        v.map(|z| (z / largest).re)
    };
    let q = real(null_vector(&complex, value)?).normalize();
    let p = real(null_vector(&complex.transpose(), value)?);
    let product = p.dot(&q);
    (product.abs() > 1e-12).then(|| (q, p / product))
}

/// A unit vector v with matrix·v = value·v, by inverse iteration just beside the value.
fn null_vector(matrix: &DMatrix<Complex<f64>>, value: Complex<f64>) -> Option<ComplexSection> {
    let beside = value * Complex::new(1.0 + 1e-10, 1e-10);
    let factors = (matrix - DMatrix::identity(matrix.nrows(), matrix.ncols()) * beside).lu();
    const START: [f64; 8] = [0.6, -0.5, 0.4, 0.5, -0.3, 0.7, 0.2, -0.4];
    let mut vector = ComplexSection::from_fn(matrix.nrows(), |i, _| Complex::new(START[i], 0.0));
    for _ in 0..4 {
        vector = factors.solve(&vector)?;
        let length = vector.norm();
        if !length.is_finite() || length == 0.0 {
            return None;
        }
        vector = vector.map(|z| z / length);
    }
    Some(vector)
}
