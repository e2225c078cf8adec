//! The numbers of a system, and the matrices that they make of Eq. (2).

use impact_atlas::model::Parameters;

use super::dd::Dd;
use super::linear::{Matrix, zero};

/// Indices into the augmented state (y, x2, v1, v2, sin φ, cos φ, s).
pub mod index {
    /// x1 minus the reference stop.
    pub const Y: usize = 0;
    /// Displacement of the second mass.
    pub const X2: usize = 1;
    /// Velocity of the first mass.
    pub const V1: usize = 2;
    /// Velocity of the second mass.
    pub const V2: usize = 3;
    /// sin of the forcing phase.
    pub const SIN: usize = 4;
    /// cos of the forcing phase.
    pub const COS: usize = 5;
    /// The reference stop, +δ or −δ.
    pub const STOP: usize = 6;
}

/// The plain numbers of a system, and the amplitude of its forcing (1, or 0 for the free system).
#[derive(Clone, Copy, Debug)]
pub struct Plant {
    /// The eight parameters.
    pub parameters: Parameters,
    /// Factor on the forcing.
    pub forcing: f64,
}

impl Plant {
    /// The forced system.
    pub fn new(parameters: Parameters) -> Self {
        Plant { parameters, forcing: 1.0 }
    }

    /// The system without forcing; ω only counts periods.
    pub fn unforced(parameters: Parameters) -> Self {
        Plant { parameters, forcing: 0.0 }
    }

    /// The forcing period 2π/ω.
    pub fn period(&self) -> Dd {
        Dd::TAU / Dd::from(self.parameters.omega)
    }

    /// Free flight: Eq. (2), multiplied by the inverse of its diagonal mass matrix, with x1 = y + s.
    pub fn free(&self) -> Matrix<Dd> {
        use index::{COS, SIN, STOP, V1, V2, X2, Y};
        let one = Dd::from(1.0);
        let [omega, zeta, mu_m, mu_k, mu_c, f20] = {
            let p = &self.parameters;
            [p.omega, p.zeta, p.mu_m, p.mu_k, p.mu_c, p.f20].map(Dd::from)
        };
        let forcing = Dd::from(self.forcing);
        let damping = zeta + zeta;
        let masses = [one, mu_m / (one - mu_m)];
        let stiffness = [[one, -one], [-one, one / (one - mu_k)]];
        let dissipation = [[damping, -damping], [-damping, damping / (one - mu_c)]];
        let amplitude = [forcing * (one - f20), forcing * f20];

        let mut a = zero();
        a[Y][V1] = one;
        a[X2][V2] = one;
        for (row, velocity) in [V1, V2].into_iter().enumerate() {
            let over_mass = |value: Dd| value / masses[row];
            a[velocity][Y] = over_mass(-stiffness[row][0]);
            a[velocity][STOP] = over_mass(-stiffness[row][0]);
            a[velocity][X2] = over_mass(-stiffness[row][1]);
            a[velocity][V1] = over_mass(-dissipation[row][0]);
            a[velocity][V2] = over_mass(-dissipation[row][1]);
            a[velocity][SIN] = over_mass(amplitude[row]);
        }
        a[SIN][COS] = omega;
        a[COS][SIN] = -omega;
        a
    }

    /// M1 at rest on the reference stop: its rows vanish, M2 moves alone.
    pub fn resting(&self) -> Matrix<Dd> {
        let mut a = self.free();
        a[index::Y] = zero()[index::Y];
        a[index::V1] = zero()[index::V1];
        a
    }
}
