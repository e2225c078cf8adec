// The constants of one cell, as src/model/flight.rs computes them.

struct Flight {
    phi: array<vec4<f32>, 4>,
    gamma_sin: vec4<f32>,
    gamma_cos: vec4<f32>,
    bound: vec4<f32>,
    forced: vec4<f32>,
    h: f32,
    inverse_h: f32,
    turn_sin: f32,
    turn_cos: f32,
    omega: f32,
    delta: f32,
    r: f32,
    coupling_damping: f32,
    inverse_mass: f32,
    ground_stiffness: f32,
    ground_damping: f32,
    force1: f32,
    force2: f32,
    bound_forcing: f32,
    rate: f32,
    reach: f32,
    mass: f32,
    ground: f32,
    compliance: f32,
    linear_exponent: f32,
    steps: u32,
    // Rows of 16 bytes are filled up to here.
    unused: array<u32, 3>,
}

// What a unit kick of v1 becomes within a step: a polynomial in s/h.
struct Kick {
    terms: array<vec4<f32>, KICK_TERMS>,
}

// The cell that this invocation works on.
var<private> flight: Flight;
var<private> cell: u32;
