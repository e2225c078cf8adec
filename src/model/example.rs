//! Equations whose matrices are like no others', for tests.

use nalgebra::{DMatrix, DVector};

use super::equations::Equations;
use crate::system::{Plant, PlantStop};

/// N coordinates, coupled by matrices that are neither symmetric nor alike, with every kind of load and a stop.
pub(super) fn coupled<const N: usize>() -> Equations<N> {
    let entry = |seed: usize, i: usize, j: usize| ((7 * seed + 3 * i + 5 * j + i * j) as f64).sin();
    let matrix = |seed: usize, diagonal: f64| {
        DMatrix::from_fn(N, N, |i, j| entry(seed, i, j) * 0.4 + if i == j { diagonal } else { 0.0 })
    };
    let vector = |seed: usize| DVector::from_fn(N, |i, _| entry(seed, i, 1));
    Equations::new(&Plant {
        n: N,
        mass: matrix(1, 2.0),
        damping: matrix(2, 0.7),
        stiffness: matrix(3, 1.5),
        force_sin: vector(4),
        force_cos: vector(5),
        load: vector(6),
        omega: 1.7,
        stops: vec![PlantStop { direction: vector(7), gap: 0.3, restitution: 0.8 }],
    })
}

/// Calls a generic function for one to five coordinates: as many as there are with a force that is one of them.
macro_rules! for_every_size {
    ($check:ident) => {{
        $check::<1>();
        $check::<2>();
        $check::<3>();
        $check::<4>();
        $check::<5>();
    }};
}

pub(super) use for_every_size;
