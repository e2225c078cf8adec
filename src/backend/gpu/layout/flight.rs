//! The constants of a cell.

use bytemuck::{Pod, Zeroable};

use crate::model::{self, Real};

/// Terms of the kick polynomial in f32: up to the order of a flight.
pub const KICK_TERMS: usize = <f32 as Real>::ORDER + 1;

/// `Flight` in shaders/model/flight.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Flight {
    pub phi: [[f32; 4]; 4],
    pub gamma_sin: [f32; 4],
    pub gamma_cos: [f32; 4],
    pub bound: [f32; 4],
    pub forced: [f32; 4],
    pub h: f32,
    pub inverse_h: f32,
    pub turn_sin: f32,
    pub turn_cos: f32,
    pub omega: f32,
    pub delta: f32,
    pub r: f32,
    pub coupling_damping: f32,
    pub inverse_mass: f32,
    pub ground_stiffness: f32,
    pub ground_damping: f32,
    pub force1: f32,
    pub force2: f32,
    pub bound_forcing: f32,
    pub rate: f32,
    pub reach: f32,
    pub mass: f32,
    pub ground: f32,
    pub compliance: f32,
    pub linear_exponent: f32,
    pub steps: u32,
    pub unused: [u32; 3],
}

impl Flight {
    /// The constants of a cell, rounded to f32.
    pub fn new(flight: &model::Flight<f32>) -> Self {
        Flight {
            phi: flight.phi,
            gamma_sin: flight.gamma_sin,
            gamma_cos: flight.gamma_cos,
            bound: flight.bound,
            forced: flight.forced,
            h: flight.h,
            inverse_h: flight.inverse_h,
            turn_sin: flight.turn_sin,
            turn_cos: flight.turn_cos,
            omega: flight.omega,
            delta: flight.delta,
            r: flight.r,
            coupling_damping: flight.coupling_damping,
            inverse_mass: flight.inverse_mass,
            ground_stiffness: flight.ground_stiffness,
            ground_damping: flight.ground_damping,
            force1: flight.force1,
            force2: flight.force2,
            bound_forcing: flight.bound_forcing,
            rate: flight.rate,
            reach: flight.reach,
            mass: flight.mass,
            ground: flight.ground,
            compliance: flight.compliance,
            linear_exponent: flight.linear_exponent,
            steps: flight.steps,
            unused: [0; 3],
        }
    }
}

/// `Kick` in shaders/model/flight.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Kick {
    pub terms: [[f32; 4]; KICK_TERMS],
}

impl Kick {
    /// The kick polynomial of a cell.
    pub fn new(flight: &model::Flight<f32>) -> Self {
        Kick { terms: std::array::from_fn(|k| flight.kick[k]) }
    }
}
