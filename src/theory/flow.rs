//! Free flight over any length of time, as a matrix.

use nalgebra::{Matrix6, Vector4, Vector6};

use crate::dynamics::Stop;
use crate::model::{Equations, System};

/// A state just after an impact, on the section at its stop: (v1+, x2, v2, φ), where φ is the forcing phase, not
/// reduced. Non-dimensional; on the section at A it is the paper's X = (x1'+, x2, x2', τ).
pub type Section = Vector4<f64>;

/// Where the components of a [`Section`] stand.
pub(crate) const V1_PLUS: usize = 0;
/// Displacement of the second mass.
pub(crate) const X2: usize = 1;
/// Velocity of the second mass.
pub(crate) const V2: usize = 2;
/// Forcing phase.
pub(crate) const PHASE: usize = 3;

/// Where x1 stands in the state z of a [`Flow`].
pub(crate) const Z_X1: usize = 0;
/// Second mass's displacement.
pub(crate) const Z_X2: usize = 1;
/// First mass's velocity.
pub(crate) const Z_V1: usize = 2;
/// Second mass's velocity.
pub(crate) const Z_V2: usize = 3;
/// Sine of the forcing phase.
pub(crate) const Z_SIN: usize = 4;
/// Cosine of the forcing phase.
pub(crate) const Z_COS: usize = 5;

/// The generator of free flight in z = (x1, x2, v1, v2, sin φ, cos φ).
pub(crate) fn generator(system: &System) -> Matrix6<f64> {
    let equations = Equations::<2>::new(system.plant());
    let mut g = Matrix6::zeros();
    g.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
    g.fixed_view_mut::<2, 2>(2, 0).copy_from(&equations.stiffness);
    g.fixed_view_mut::<2, 2>(2, 2).copy_from(&equations.damping);
    g.fixed_view_mut::<2, 1>(2, Z_SIN).copy_from(&equations.sin);
    g.fixed_view_mut::<2, 1>(2, Z_COS).copy_from(&equations.cos);
    g[(Z_SIN, Z_COS)] = equations.omega;
    g[(Z_COS, Z_SIN)] = -equations.omega;
    g
}

/// The flow z' = G z of Eq. (2) between impacts, with the forcing phasor in z = (x1, x2, v1, v2, sin φ, cos φ).
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    /// G.
    pub generator: Matrix6<f64>,
    /// ω.
    pub omega: f64,
    /// δ.
    pub delta: f64,
    /// r.
    pub r: f64,
}

impl Flow {
    /// The flow of a system.
    pub fn new(system: &System) -> Self {
        let plant = system.plant();
        Flow {
            generator: generator(system),
            omega: plant.omega,
            delta: plant.stops[0].gap,
            r: plant.stops[0].restitution,
        }
    }

    /// exp(G t).
    pub fn over(&self, time: f64) -> Matrix6<f64> {
        (self.generator * time).exp()
    }

    /// The whole state just after an impact.
    pub fn lifted(&self, stop: Stop, section: &Section) -> Vector6<f64> {
        let (sin, cos) = section[PHASE].sin_cos();
        Vector6::new(stop.side::<f64>() * self.delta, section[X2], section[V1_PLUS], section[V2], sin, cos)
    }
}
