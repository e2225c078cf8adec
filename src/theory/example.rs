//! A plant that the unit tests share.

use nalgebra::{DMatrix, DVector};

use crate::model::System;
use crate::system::{Plant, PlantStop};

/// Three masses in a chain, fixed to the ground at both ends, the middle one between two stops.
pub fn chain() -> System {
    let matrix = |diagonal: f64, beside: f64| {
        DMatrix::from_fn(3, 3, |i, j| match i.abs_diff(j) {
            0 => diagonal,
            1 => beside,
            _ => 0.0,
        })
    };
    let stop = |side: f64| PlantStop {
        direction: DVector::from_row_slice(&[0.0, side, 0.0]),
        gap: 0.2,
        restitution: 0.7,
    };
    let plant = Plant {
        n: 3,
        mass: DMatrix::from_diagonal(&DVector::from_row_slice(&[1.0, 0.8, 1.3])),
        damping: matrix(0.3, -0.1),
        stiffness: matrix(2.0, -1.0),
        force_sin: DVector::from_row_slice(&[0.3, 1.0, 0.0]),
        force_cos: DVector::from_row_slice(&[0.0, 0.2, 0.1]),
        load: DVector::zeros(3),
        omega: 2.4,
        stops: vec![stop(1.0), stop(-1.0)],
    };
    System::of_plant(plant).expect("the chain is a plant")
}
