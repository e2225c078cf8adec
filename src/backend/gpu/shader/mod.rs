//! The shader: fragments in their order, unrolled for a shape, after declarations generated from this crate's own.

mod codes;
mod constants;
mod exact;
mod kernel;
mod methods;
mod residence;
mod sections;
mod space;
mod template;
mod vectors;
mod workgroup;

pub use exact::{Arithmetic, exact};
pub use kernel::Kernel;
pub use residence::Residence;
pub use space::Space;
pub use template::Shape;
pub use workgroup::WORKGROUP;

use super::layout;
use crate::control::METHODS;

/// What every kernel begins with.
const COMMON: [&str; 42] = [
    include_str!("../../../../shaders/shared/numbers.wgsl"),
    include_str!("../../../../shaders/model/logarithm.wgsl"),
    include_str!("../../../../shaders/model/flight.wgsl"),
    include_str!("../../../../shaders/dynamics/stop.wgsl"),
    include_str!("../../../../shaders/dynamics/held.wgsl"),
    include_str!("../../../../shaders/dynamics/series.wgsl"),
    include_str!("../../../../shaders/dynamics/point.wgsl"),
    include_str!("../../../../shaders/dynamics/along.wgsl"),
    include_str!("../../../../shaders/dynamics/course.wgsl"),
    include_str!("../../../../shaders/dynamics/tangent.wgsl"),
    include_str!("../../../../shaders/dynamics/contact.wgsl"),
    include_str!("../../../../shaders/dynamics/clear.wgsl"),
    include_str!("../../../../shaders/dynamics/pressing.wgsl"),
    include_str!("../../../../shaders/dynamics/imminent.wgsl"),
    include_str!("../../../../shaders/dynamics/chatter.wgsl"),
    include_str!("../../../../shaders/dynamics/hull.wgsl"),
    include_str!("../../../../shaders/dynamics/leg.wgsl"),
    include_str!("../../../../shaders/dynamics/quintic.wgsl"),
    include_str!("../../../../shaders/dynamics/face.wgsl"),
    include_str!("../../../../shaders/dynamics/touching.wgsl"),
    include_str!("../../../../shaders/dynamics/crossing.wgsl"),
    include_str!("../../../../shaders/dynamics/placing.wgsl"),
    include_str!("../../../../shaders/dynamics/corner.wgsl"),
    include_str!("../../../../shaders/dynamics/gliding.wgsl"),
    include_str!("../../../../shaders/dynamics/trajectory.wgsl"),
    include_str!("../../../../shaders/dynamics/squeeze.wgsl"),
    include_str!("../../../../shaders/dynamics/closing.wgsl"),
    include_str!("../../../../shaders/dynamics/striking.wgsl"),
    include_str!("../../../../shaders/dynamics/holding.wgsl"),
    include_str!("../../../../shaders/dynamics/sticking.wgsl"),
    include_str!("../../../../shaders/analysis/recurrence.wgsl"),
    include_str!("../../../../shaders/analysis/exponent.wgsl"),
    include_str!("../../../../shaders/analysis/turn.wgsl"),
    include_str!("../../../../shaders/analysis/spread.wgsl"),
    include_str!("../../../../shaders/analysis/quiet.wgsl"),
    include_str!("../../../../shaders/analysis/loss.wgsl"),
    include_str!("../../../../shaders/analysis/observer.wgsl"),
    include_str!("../../../../shaders/analysis/beginning.wgsl"),
    include_str!("../../../../shaders/analysis/observing.wgsl"),
    include_str!("../../../../shaders/analysis/leap.wgsl"),
    include_str!("../../../../shaders/analysis/deciding.wgsl"),
    include_str!("../../../../shaders/analysis/verdict.wgsl"),
];

/// What is read of a normal that a force changes, and how where one comes on top.
const DRIVEN: [[&str; 2]; 7] = [
    [
        "return flight.normals[normal].bound_forcing;",
        "return flight.normals[normal].bound_forcing + driven.bound[normal];",
    ],
    [
        "return flights[flow].pressed_forcing[others_place(contact, normal)];",
        "return flights[flow].pressed_forcing[others_place(contact, normal)] + driven.bound[normal];",
    ],
    [
        "return flights[flow].sixth_forcing[others_place(contact, normal)];",
        "return flights[flow].sixth_forcing[others_place(contact, normal)] + driven.bound[normal];",
    ],
    [
        "return flight.normals[normal].held_gamma_sin;",
        "return state_plus(flight.normals[normal].held_gamma_sin, controlled.force, state_of_values(control.drive_held_sin[normal]));",
    ],
    [
        "return flight.normals[normal].held_gamma_cos;",
        "return state_plus(flight.normals[normal].held_gamma_cos, controlled.force, state_of_values(control.drive_held_cos[normal]));",
    ],
    [
        "return flight.normals[normal].back_sin[term];",
        "return flight.normals[normal].back_sin[term] + controlled.force * control.drive_back_sin[normal][term];",
    ],
    [
        "return flight.normals[normal].back_cos[term];",
        "return flight.normals[normal].back_cos[term] + controlled.force * control.drive_back_cos[normal][term];",
    ],
];

/// The source of a kernel for a shape.
pub fn source(kernel: Kernel, shape: &Shape, residence: Residence, arithmetic: Arithmetic) -> String {
    let is_control = kernel == Kernel::Control;
    let methods = METHODS.iter().filter(|_| is_control).map(|method| &method.shader);
    let fragments = COMMON.iter().chain(kernel.fragments()).chain(methods);
    let fragments: String = fragments.map(|fragment| shape.unrolled(fragment) + "\n").collect();
    // A force in phase with the forcing is added to what it changes.
    let fragments = match kernel {
        Kernel::Follow | Kernel::Trace | Kernel::Extent => fragments,
        Kernel::Control => {
            let fragments = ["gamma_sin", "gamma_cos", "sin"].iter().fold(fragments, |text, name| {
                text.replace(&format!("flight.{name};"), &format!("driven.{name};"))
                    .replace(&format!("flight.{name},"), &format!("driven.{name},"))
                    .replace(&format!("flight.{name})"), &format!("driven.{name})"))
            });
            DRIVEN.iter().fold(fragments, |text, [alone, driven]| {
                assert_eq!(text.matches(alone).count(), 1, "{alone}");
                text.replace(alone, driven)
            })
        }
    };
    let control = if is_control { sections::source(shape) + &methods::source() } else { String::new() };
    [
        arithmetic.source(),
        codes::source(shape).as_str(),
        constants::source(shape).as_str(),
        vectors::source(shape).as_str(),
        &layout::declarations_for(shape),
        &layout::STRUCTS.join("\n"),
        &pressing_share(shape),
        &control,
        &residence.source(kernel),
        &fragments.replace("observer.", &format!("{}.", residence.observer(kernel))),
    ]
    .join("\n")
}

/// How the pressing on a contact follows from the accelerations along the normals: a table of the flow, or 1 where there is
/// one normal only.
fn pressing_share(shape: &Shape) -> String {
    let head = "fn pressing_share(contacts: u32, s: u32, t: u32) -> f32 {\n";
    if shape.normals == 1 {
        return format!("{head}    return 1.0;\n}}\n");
    }
    let square = shape.normals * shape.normals;
    let row = shape.normals;
    format!("{head}    return flights[flow].pressing[(contacts - 1u) * {square}u + s * {row}u + t];\n}}\n")
}

#[cfg(test)]
mod tests {
    use strum::VariantArray;

    use super::*;

    /// Every shape that there is.
    fn shapes() -> Vec<Shape> {
        let normals = |coordinates| (1..=4).map(move |normals| (coordinates, normals));
        (1..=4)
            .flat_map(normals)
            .map(|(coordinates, normals)| Shape { coordinates, normals, stops: 4 })
            .collect()
    }

    fn shapes_and_residences() -> impl Iterator<Item = (Shape, Residence)> {
        let with = |shape| Residence::VARIANTS.iter().map(move |&residence| (shape, residence));
        shapes().into_iter().flat_map(with)
    }

    #[test]
    fn every_shader_can_be_computed_exactly() {
        for &kernel in Kernel::VARIANTS {
            for (shape, residence) in shapes_and_residences() {
                let source = source(kernel, &shape, residence, Arithmetic::Exact);
                let module = exact(&source).unwrap_or_else(|error| panic!("{shape:?} {error}"));
                let all = naga::valid::ValidationFlags::all();
                naga::valid::Validator::new(all, naga::valid::Capabilities::empty())
                    .validate(&module)
                    .unwrap_or_else(|error| panic!("{shape:?} {error:?}"));
            }
        }
    }

    #[test]
    fn the_shaders_are_valid_and_need_no_feature() {
        for &kernel in Kernel::VARIANTS {
            for (shape, residence) in shapes_and_residences() {
                let source = source(kernel, &shape, residence, Arithmetic::Native);
                let module = naga::front::wgsl::parse_str(&source)
                    .unwrap_or_else(|error| panic!("{shape:?} {}", error.emit_to_string(&source)));
                let all = naga::valid::ValidationFlags::all();
                naga::valid::Validator::new(all, naga::valid::Capabilities::empty())
                    .validate(&module)
                    .unwrap_or_else(|error| panic!("{shape:?} {error:?}"));
            }
        }
    }
}
