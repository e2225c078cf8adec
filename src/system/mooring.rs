//! Drift: directions in which the masses never come back, for neither springs nor stops resist, are held, since where the masses
//! are along them bears on nothing else.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::plant::Plant;

/// How fast what nothing resists dies away where it is held, in units of ω: by e^(−2π) and e^(−1.6π) in a forcing period. They
/// differ, so that the multipliers are well-conditioned.
const RIGID: [f64; 2] = [1.0, 0.8];
/// The same for displacements that dampers alone resist.
const DAMPED: f64 = 1.0;

/// A row and a direction are orthogonal where their product is below this share of its terms.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Stiffness is looked at for such a direction where its determinant is below this share of the product of its rows' sizes.
const SINGULAR: f64 = 1e-6;

/// What holds a plant in directions in which it may drift.
#[derive(Clone, Debug, PartialEq)]
pub struct Mooring {
    /// The Lyapunov exponents per forcing period that it adds to those of the motion relative to the drift.
    pub exponents: Vec<f64>,
    /// A projection of states (x, v), 2n × 2n, that takes out exactly what is held, and is followed by the relative motion.
    pub relative: DMatrix<f64>,
}

/// Directions in columns, and what says how far a displacement goes along each.
struct Directions {
    /// Q, n × k.
    basis: DMatrix<f64>,
    /// (QᵀMQ)⁻¹QᵀM, k × n.
    dual: DMatrix<f64>,
    /// (QᵀMQ)⁻¹Qᵀ, k × n: how forces push along each.
    push: DMatrix<f64>,
}

impl Mooring {
    /// A plant that is held in the directions a along which neither springs nor stops resist, K a = 0 and d·a = 0 for every stop,
    /// and what holds it. None where there is no such direction.
    ///
    /// *Rigid-body motion*, where C a = 0 as well: with a basis Q of these directions, y = (QᵀMQ)⁻¹QᵀM x is where the masses
    /// are as a whole, and P = 1 − Q(QᵀMQ)⁻¹QᵀM takes x to their places relative to it. Stops meet P x alone, which follows
    /// (P x)″ = P M⁻¹(s sin φ + c cos φ + l − K P x − C P x′), whatever y does. So y″, which is 0 but for loads, is
    /// replaced by y″ = −1.8 ω y′ − 0.8 ω² y: then x is soon what it is in the frame that moves with the masses as a whole.
    ///
    /// Where dampers resist, C a ≠ 0, velocities along a bear on the rest, and displacements y do not. So x − a (y − w) is followed
    /// instead of x, with w′ = y′ − ω w: x in a frame that goes after the masses, with velocities in that frame. This is the
    /// system with ω C a (QᵀMQ)⁻¹QᵀM added to K, and ω M a (QᵀMQ)⁻¹QᵀM to C.
    ///
    /// Nothing is held along directions for which QᵀMQ is singular; no symmetric and positive definite M makes it so.
    pub fn of(plant: &Plant) -> Option<(Plant, Self)> {
        if !may_drift(plant) {
            return None;
        }
        let rigid = Directions::unresisted(plant, &[&plant.stiffness, &plant.damping]);
        let held = rigid.as_ref().map(|rigid| rigid.held(plant));
        let plant = held.as_ref().unwrap_or(plant);
        let damped = Directions::unresisted(plant, &[&plant.stiffness]);
        let slowed = damped.as_ref().map(|damped| damped.followed(plant));
        let moored = slowed.or(held)?;
        let mooring = Mooring::along(&moored, rigid.as_ref(), damped.as_ref())?;
        Some((moored, mooring))
    }

    /// That of a plant which is held along some directions, and followed along others.
    fn along(plant: &Plant, rigid: Option<&Directions>, damped: Option<&Directions>) -> Option<Self> {
        let n = plant.n;
        let none = DVector::zeros(n);
        let state = |x: &DVector<f64>, v: &DVector<f64>| {
            DVector::from_iterator(2 * n, x.iter().chain(v.iter()).copied())
        };
        // How fast each dies away, and a deviation that does, with what measures it.
        let mut dying = Vec::new();
        for (a, measure) in rigid.into_iter().flat_map(Directions::each) {
            dying.push((RIGID[0], (state(&a, &none), state(&measure, &none))));
            dying.push((RIGID[1], (state(&none, &a), state(&none, &measure))));
        }
        for (a, measure) in damped.into_iter().flat_map(Directions::each) {
            dying.push((DAMPED, (state(&a, &(&a * (-DAMPED * plant.omega))), state(&measure, &none))));
        }
        let (rates, (deviations, measures)): (Vec<f64>, (Vec<_>, Vec<_>)) = dying.into_iter().unzip();
        let deviations = DMatrix::from_columns(&deviations);
        let measures = DMatrix::from_columns(&measures).transpose();
        let inverse = (&measures * &deviations).try_inverse()?;
        let relative = DMatrix::identity(2 * n, 2 * n) - deviations * inverse * measures;
        Some(Mooring { exponents: rates.iter().map(|rate| -TAU * rate).collect(), relative })
    }
}

impl Directions {
    /// The directions along which none of some matrices and no stop resists: the null space that their rows have in common, but for
    /// rounding.
    fn unresisted(plant: &Plant, matrices: &[&DMatrix<f64>]) -> Option<Self> {
        let n = plant.n;
        let of_matrices = matrices.iter().flat_map(|m| m.row_iter()).map(|row| row.transpose());
        let directions = plant.stops.iter().map(|stop| stop.direction.clone());
        let rows = of_matrices.chain(directions).filter(|row| row.amax() > 0.0);
        let rows: Vec<_> = rows.map(|row| (&row / row.amax()).transpose()).collect();
        let factors = DMatrix::from_rows(&rows).full_piv_lu();
        let upper = factors.u();
        let rank = (0..upper.nrows()).take_while(|&i| upper[(i, i)].abs() > ROUNDING).count();
        let free = n - rank;
        if free == 0 {
            return None;
        }
        let [pivots, rest] =
            [(0, rank), (rank, free)].map(|(from, count)| upper.view((0, from), (rank, count)));
        let reduced = pivots.solve_upper_triangular(&rest)?;
        let mut basis = DMatrix::zeros(n, free);
        basis.view_mut((0, 0), (rank, free)).copy_from(&-reduced);
        basis.view_mut((rank, 0), (free, free)).fill_with_identity();
        factors.q().inv_permute_rows(&mut basis);
        let weighed = basis.transpose() * &plant.mass;
        let inverse = (&weighed * &basis).try_inverse()?;
        Some(Directions { dual: &inverse * weighed, push: inverse * basis.transpose(), basis })
    }

    /// Each direction, with what says how far a displacement goes along it.
    fn each(&self) -> impl Iterator<Item = (DVector<f64>, DVector<f64>)> {
        let measures = self.dual.row_iter().map(|row| row.transpose());
        self.basis.column_iter().map(|a| a.into_owned()).zip(measures)
    }

    /// A plant with springs and dampers to ground along directions that nothing resists, and without loads along them.
    fn held(&self, plant: &Plant) -> Plant {
        let whole = symmetric_as(&plant.mass, &plant.mass * &self.basis * &self.dual);
        let [damper, spring] =
            [RIGID[0] + RIGID[1], RIGID[0] * RIGID[1] * plant.omega].map(|value| value * plant.omega);
        let pushed = &plant.mass * &self.basis * &self.push;
        Plant {
            damping: self.apart(&pushed, &plant.damping) + &whole * damper,
            stiffness: self.apart(&pushed, &plant.stiffness) + whole * spring,
            force_sin: self.balanced(&pushed, &plant.force_sin),
            force_cos: self.balanced(&pushed, &plant.force_cos),
            load: self.balanced(&pushed, &plant.load),
            ..plant.clone()
        }
    }

    /// A matrix of what acts on the masses without its part on them as a whole: as it is where there is none but for rounding.
    fn apart(&self, pushed: &DMatrix<f64>, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let part = self.basis.transpose() * matrix;
        let size = self.basis.abs().transpose() * matrix.abs();
        let is_lost = part.iter().zip(&size).all(|(part, size)| part.abs() <= ROUNDING * size);
        if is_lost { matrix.clone() } else { matrix - pushed * matrix }
    }

    /// A force without its part on the masses as a whole: what is left of an entry is 0 where it is lost in rounding.
    fn balanced(&self, pushed: &DMatrix<f64>, force: &DVector<f64>) -> DVector<f64> {
        let (left, size) = (force - pushed * force, force.abs() + pushed.abs() * force.abs());
        left.zip_map(&size, |left, size| if left.abs() <= ROUNDING * size { 0.0 } else { left })
    }

    /// A plant in a frame that goes after the masses along directions that dampers alone resist.
    fn followed(&self, plant: &Plant) -> Plant {
        let along = &self.basis * &self.dual;
        let rate = DAMPED * plant.omega;
        Plant {
            stiffness: &plant.stiffness + &plant.damping * &along * rate,
            damping: &plant.damping + symmetric_as(&plant.mass, &plant.mass * along) * rate,
            ..plant.clone()
        }
    }
}

/// Whether the stiffness is near to singular, and more than one coordinate there for stops to leave a direction. Cheap, for this
/// is asked for every plant.
fn may_drift(plant: &Plant) -> bool {
    let sizes: f64 = plant.stiffness.row_iter().map(|row| row.amax()).product();
    plant.n > 1 && plant.stiffness.determinant().abs() <= SINGULAR * sizes
}

/// A matrix that is symmetric where another one is, made so to the last bit.
fn symmetric_as(other: &DMatrix<f64>, matrix: DMatrix<f64>) -> DMatrix<f64> {
    if *other == other.transpose() { (&matrix + matrix.transpose()) * 0.5 } else { matrix }
}
