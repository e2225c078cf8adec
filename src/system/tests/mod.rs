//! Tests of the room.

mod builtin;
mod expression;
mod family;
mod file;
mod mirror;
mod mooring;
mod plant;
mod stop_place;

use nalgebra::{DMatrix, DVector};

use super::{Plant, PlantStop};

/// n masses of 1 on springs of 1 to the ground, forced by sin t, between stops at ±1 on the first.
fn plain(n: usize) -> Plant {
    let stop = |sign: f64| PlantStop {
        direction: DVector::from_fn(n, |i, _| if i == 0 { sign } else { 0.0 }),
        gap: 1.0,
        restitution: 0.8,
    };
    Plant {
        n,
        mass: DMatrix::identity(n, n),
        damping: DMatrix::zeros(n, n),
        stiffness: DMatrix::identity(n, n),
        force_sin: DVector::from_element(n, 1.0),
        force_cos: DVector::zeros(n),
        load: DVector::zeros(n),
        omega: 1.0,
        stops: vec![stop(1.0), stop(-1.0)],
    }
}

fn stop(direction: &[f64], gap: f64) -> PlantStop {
    PlantStop { direction: DVector::from_row_slice(direction), gap, restitution: 0.8 }
}
