//! The oracle against what is known in closed form, in print, or by 32-digit arithmetic.

mod arithmetic;
mod closed_form;
mod horizons;
mod invariants;
mod printed;

use impact_atlas::model::Parameters;

/// The paper's defaults at a point of its parameter plane.
fn paper(omega: f64, delta: f64) -> Parameters {
    Parameters { omega, delta, ..Parameters::default() }
}

/// The start at rest between the stops.
const REST: [f64; 4] = [0.0; 4];
