//! Plants that the unit tests share.

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector, Matrix2};

use crate::model::{Setting, System};
use crate::system::{BUILTIN, Family, Plant, PlantStop};

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

/// A free unit mass that falls onto a stop at x = 0 with x″ = g + F sin t: the bouncing ball, whose motions of one impact in
/// each forcing period are known in closed form.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// g, towards the stop.
    pub load: f64,
    /// F.
    pub force: f64,
    /// r.
    pub restitution: f64,
}

impl Ball {
    /// One that has a stable motion of one impact, whose multipliers are a complex pair.
    pub const STABLE: Ball = Ball { load: 0.3, force: 0.15, restitution: 0.8 };

    /// The ball as a system, ω = 1.
    pub fn system(self) -> System {
        let one = |value: f64| DMatrix::from_element(1, 1, value);
        let row = |value: f64| DVector::from_element(1, value);
        let plant = Plant {
            n: 1,
            mass: one(1.0),
            damping: one(0.0),
            stiffness: one(0.0),
            force_sin: row(self.force),
            force_cos: row(0.0),
            load: row(self.load),
            omega: 1.0,
            stops: vec![PlantStop { direction: row(1.0), gap: 0.0, restitution: self.restitution }],
        };
        System::of_plant(plant).expect("the ball is a plant")
    }

    /// (v+, φ) of the motion with one impact in each forcing period: v+ = −r g T/(1 + r), since v− = v+ + g T, and
    /// cos φ = −π g (1 − r)/(F (1 + r)), since the ball is back at the stop; sin φ < 0, or > 0 for the `other`. None where
    /// the force is too small.
    pub fn section(self, other: bool) -> Option<[f64; 2]> {
        let Ball { load, force, restitution: r } = self;
        let cos = -PI * load * (1.0 - r) / (force * (1.0 + r));
        let phase = if other { cos.acos() } else { TAU - cos.acos() };
        (cos.abs() <= 1.0).then_some([-r * load * TAU / (1.0 + r), phase])
    }

    /// The derivative of the impact map in (v+, φ) at that motion, by hand.
    pub fn jacobian(self, [speed, phase]: [f64; 2]) -> Matrix2<f64> {
        let Ball { load, force, restitution: r } = self;
        let arrives = speed + load * TAU;
        let pull = load + force * phase.sin();
        // A later time of arrival for a faster start, or a later one.
        let [by_speed, by_phase] = [-TAU / arrives, force * TAU * phase.sin() / arrives];
        Matrix2::new(-r * (1.0 + pull * by_speed), -r * pull * by_phase, by_speed, 1.0 + by_phase)
    }

    /// (x, v) of that motion at forcing phase 0, from its impact at φ − 2π.
    pub fn state(self, [speed, phase]: [f64; 2]) -> [f64; 2] {
        let Ball { load, force, .. } = self;
        let s = TAU - phase;
        let drift = speed + force * phase.cos();
        [s * (drift + 0.5 * load * s) + force * phase.sin(), drift + load * s - force]
    }
}

/// The same plant with one gap and one restitution for all its stops, per unit of their directions.
pub fn with_stops(plant: &Plant, gap: f64, restitution: f64) -> Plant {
    let mut plant = plant.clone();
    for stop in &mut plant.stops {
        (stop.gap, stop.restitution) = (gap * stop.direction.norm(), restitution);
    }
    plant
}

/// The plants of the families that have a mirror once their stops are alike.
pub fn mirrored() -> Vec<Plant> {
    let plants = BUILTIN.iter().map(|builtin| Setting::defaults(Family::builtin(builtin.name)).plant());
    let exchanges = |plant: &Plant| {
        let mirror = with_stops(plant, 0.2, 0.7).mirror();
        mirror.is_some_and(|mirror| mirror.stops.iter().enumerate().any(|(i, &image)| i != image))
    };
    plants.map(Result::unwrap).filter(exchanges).collect()
}
