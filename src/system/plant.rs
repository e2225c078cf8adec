//! The numbers of one cell.

use nalgebra::{DMatrix, DVector};

/// M x″ + C x′ + K x = s sin ωt + c cos ωt + l with rigid stops; everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// n, the number of coordinates.
    pub n: usize,
    /// M.
    pub mass: DMatrix<f64>,
    /// C.
    pub damping: DMatrix<f64>,
    /// K.
    pub stiffness: DMatrix<f64>,
    /// s.
    pub force_sin: DVector<f64>,
    /// c.
    pub force_cos: DVector<f64>,
    /// l.
    pub load: DVector<f64>,
    /// ω.
    pub omega: f64,
    /// The stops.
    pub stops: Vec<PlantStop>,
}

/// A rigid stop, touched where direction · x = gap.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantStop {
    /// d.
    pub direction: DVector<f64>,
    /// The gap.
    pub gap: f64,
    /// r, the coefficient of restitution.
    pub restitution: f64,
}
