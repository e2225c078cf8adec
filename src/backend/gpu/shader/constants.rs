//! Every number that the shaders share with the Rust side; their codes are in [`super::codes`].

use std::fmt::Write;

use super::template::Shape;
use super::workgroup::WORKGROUP;
use crate::analysis::constants as analysis;
use crate::analysis::{INFINITELY_MANY, Reading, Section};
use crate::backend::gpu::layout::{BACK_TERMS, FINISHED, KICK_TERMS, NORMAL_TERMS, NOT_MEASURED};
use crate::control::constants as control;
use crate::control::{Constant, DELAYS, LONGEST_DELAY, LONGEST_ON_DEVICE, METHODS, NEVER};
use crate::dynamics::Contact;
use crate::dynamics::constants as dynamics;
use crate::model::vector::MOST;
use crate::model::{BOUNDLESS, INVERSE_ODD, Real, sets_of_others};

/// Their declarations in WGSL.
pub fn source(shape: &Shape) -> String {
    let mut source = String::new();
    let integers = [
        ("WORKGROUP", WORKGROUP),
        ("COORDINATES", shape.coordinates as u32),
        ("COMPONENTS", 2 * shape.coordinates as u32),
        ("NORMALS", shape.normals as u32),
        ("OTHERS", sets_of_others(shape.normals) as u32),
        ("STOPS", shape.stops as u32),
        ("MOST", MOST as u32),
        ("MOST_COMPONENTS", 2 * MOST as u32),
        ("CONTACT_FREE", Contact::FREE.code()),
        ("KICK_TERMS", KICK_TERMS as u32),
        ("BACK_TERMS", BACK_TERMS as u32),
        ("NORMAL_TERMS", NORMAL_TERMS as u32),
        ("ORDER", <f32 as Real>::ORDER as u32),
        ("KICK_ORDER", <f32 as Real>::KICK_ORDER as u32),
        ("BACK_ORDER", <f32 as Real>::BACK_ORDER as u32),
        ("INFINITELY_MANY", u32::from(INFINITELY_MANY)),
        ("BATCHES", analysis::BATCHES),
        ("ALIGNING", analysis::ALIGNING),
        ("SETTLING", analysis::SETTLING),
        ("SETTLING_AT_REST", analysis::SETTLING_AT_REST),
        ("FOLLOWING", analysis::FOLLOWING),
        ("PATIENCE_SHARE", analysis::PATIENCE_SHARE),
        ("SETTLED_OBSERVATION", analysis::SETTLED_OBSERVATION),
        ("SETTLED_TURNS", analysis::SETTLED_TURNS),
        ("BRIEF", analysis::BRIEF),
        ("SQUARINGS", analysis::SQUARINGS),
        ("PROOF_SHARE", analysis::PROOF_SHARE),
        ("MOST_LEAPS", analysis::MOST_LEAPS),
        ("LEAST_RETURNS", analysis::LEAST_RETURNS),
        ("MOST_KICKS", dynamics::MOST_KICKS),
        ("HELD_FLIGHTS", dynamics::HELD_FLIGHTS),
        ("SQUEEZES", dynamics::SQUEEZES),
        ("ROUNDS", analysis::ROUNDS),
        ("TURNS", analysis::TURNS),
        ("HELD_STEPS", analysis::HELD_STEPS),
        ("CLEAR_STEPS", analysis::CLEAR_STEPS),
        ("MOST_MOVES", analysis::MOST_MOVES),
        ("FAIR_MOVES", analysis::FAIR_MOVES),
        ("DEPTH", LONGEST_ON_DEVICE.max(LONGEST_DELAY) as u32 + 1),
        ("DELAYS", DELAYS as u32),
        ("LONGEST_DELAY", LONGEST_DELAY as u32),
        ("LONGEST", LONGEST_ON_DEVICE as u32),
        ("LONGEST_PASSAGE", control::LONGEST_PASSAGE),
        ("CONTROL_SETTLING", control::SETTLING),
        ("NEVER", NEVER),
        ("FINISHED", FINISHED),
        ("SECTION_STROBE", Section::STROBE_CODE),
        ("READING_COMPONENT", Reading::COMPONENT_CODE),
        ("READING_GAP", Reading::GAP_CODE),
        ("READING_SPEED", Reading::SPEED_CODE),
    ];
    for (name, value) in integers {
        writeln!(source, "const {name} = {value}u;").expect("a string takes anything");
    }
    let epsilon = f64::from(f32::EPSILON);
    let numbers = [
        ("TRUNCATION", <f32 as Real>::TRUNCATION),
        ("TOUCH", <f32 as Real>::TOUCH),
        ("UNHEEDED", <f32 as Real>::UNHEEDED),
        ("IMMINENT", <f32 as Real>::IMMINENT),
        ("CHATTER", <f32 as Real>::CHATTER),
        ("RETURNING", <f32 as Real>::RETURNING),
        ("SETTLED", <f32 as Real>::SETTLED),
        ("AT_REST", <f32 as Real>::AT_REST),
        ("ROUNDING", <f32 as Real>::ROUNDING),
        ("DISTINCT", analysis::DISTINCT),
        ("NEARER", analysis::NEARER),
        ("QUICKLY", analysis::QUICKLY),
        ("FARTHEST", analysis::FARTHEST),
        ("NOT_MEASURED", f64::from(NOT_MEASURED)),
        ("EPSILON", epsilon),
        ("SQRT_EPSILON", f64::from(f32::EPSILON.sqrt())),
        ("PI", std::f64::consts::PI),
        ("TAU", std::f64::consts::TAU),
        ("HALF_PI", std::f64::consts::FRAC_PI_2),
        ("INVERSE_TAU", 1.0 / std::f64::consts::TAU),
        ("TWO_OVER_PI", std::f64::consts::FRAC_2_PI),
        ("RUNAWAY", control::RUNAWAY),
        ("KICK_ROUNDINGS", dynamics::KICK_ROUNDINGS),
        ("ROUNDINGS", dynamics::ROUNDINGS),
        ("HOPS", dynamics::HOPS),
        ("SHORT", dynamics::SHORT),
        ("LOST_SHARE", dynamics::LOST * epsilon),
        ("TANGENT_SEED", 1.0 / (2.0 * shape.coordinates as f64).sqrt()),
        ("LN_2", std::f64::consts::LN_2),
        ("SQRT_2", std::f64::consts::SQRT_2),
        ("THIRD", 1.0 / 3.0),
        ("TWELFTH", 1.0 / 12.0),
        ("TWO_THIRDS", 2.0 / 3.0),
        ("SWELLING", dynamics::SWELLING),
        ("SEEN_SHARE", dynamics::SEEN / dynamics::SWELLING),
        ("SIXTH", 1.0 / 6.0),
        ("STRAIGHT", <f32 as Real>::STRAIGHT),
        ("EXACT", dynamics::EXACT),
        ("ASIDE", dynamics::ASIDE),
        ("STEADY_BOUND", dynamics::STEADY * dynamics::WIDER),
        ("CHATTER_BOUND", <f32 as Real>::CHATTER * dynamics::WIDER),
        ("FAR", dynamics::FAR),
        ("BOUNDLESS", BOUNDLESS),
        ("STEADY", dynamics::STEADY),
        ("FADING", dynamics::FADING),
        ("NEARLY", dynamics::NEARLY),
        ("INVERSE_SLOW", 1.0 / dynamics::SLOW),
        ("PUSH", dynamics::PUSH),
        ("WIDENING", dynamics::WIDENING),
        ("RETURNED", analysis::RETURNED),
        ("LONGEST_LEAP", analysis::LONGEST_LEAP),
        ("LEFT_BY_LEAP", analysis::LEFT_BY_LEAP),
        ("SHORT_SQUARE", dynamics::SHORT_SQUARE),
        ("LONG_SQUARE", dynamics::LONG_SQUARE),
        ("NEUTRAL_GROWTH", analysis::NEUTRAL_GROWTH),
        ("NEUTRAL_RATE", analysis::NEUTRAL_RATE),
        ("FORGETS", analysis::FORGETS),
        ("EXPLODES", analysis::EXPLODES),
        ("CHAOTIC_GROWTH", analysis::CHAOTIC_GROWTH),
        ("SIGNIFICANCE", analysis::SIGNIFICANCE),
        ("PLAIN_GROWTH", analysis::PLAIN_GROWTH),
        ("STATIONARY", analysis::STATIONARY),
    ];
    for (name, value) in numbers {
        writeln!(source, "const {name}: f32 = {}f;", exact(value)).expect("a string takes anything");
    }
    for (name, constant) in METHODS.iter().flat_map(|method| method.constants) {
        match constant {
            Constant::Whole(value) => writeln!(source, "const {name} = {value}u;"),
            Constant::Number(value) => writeln!(source, "const {name}: f32 = {}f;", exact(*value)),
        }
        .expect("a string takes anything");
    }
    let arrays = [
        ("INVERSE_FACTORIALS", &dynamics::INVERSE_FACTORIALS[..<f32 as Real>::ORDER + 2]),
        ("INVERSE_ODD", &INVERSE_ODD[..]),
    ];
    for (name, values) in arrays {
        let values: Vec<String> = values.iter().map(|&value| format!("{}f", exact(value))).collect();
        writeln!(source, "const {name} = array<f32, {}>({});", values.len(), values.join(", "))
            .expect("a string takes anything");
    }
    source
}

/// A number rounded to f32, written so that it reads back exactly.
fn exact(value: f64) -> String {
    format!("{:e}", value as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generated_numbers_read_back_exactly() {
        for value in [1.0 / 3.0, 4e-9, 1e30, f64::from(f32::EPSILON)] {
            assert_eq!(exact(value).parse::<f32>().unwrap(), value as f32);
        }
    }
}
