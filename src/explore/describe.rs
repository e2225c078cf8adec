//! What a page needs to know before it can ask: the systems, their parameters, the plane that it begins with.

use serde::Serialize;
use serde_json::{Value, json};

use super::backends;
use super::ranges::{component_range, slider};
use super::scene::Scene;
use crate::model::{Parameter, joined};
use crate::plane::{Axis, Component, Plane, Quantity, Start};
use crate::render::live_title;
use crate::system::{BUILTIN, Family};

/// A parameter with the range of its slider.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Described {
    name: &'static str,
    symbol: &'static str,
    about: &'static str,
    value: f64,
    /// The ends of the slider; any value in the parameter's range may be typed.
    slider: [f64; 2],
    /// The range in words.
    range: String,
}

fn parameters(plane: &Plane) -> Vec<Described> {
    let described = |(parameter, value): (Parameter, f64)| Described {
        name: parameter.name(),
        symbol: &parameter.about().symbol,
        about: &parameter.about().about,
        value,
        slider: slider(parameter, value),
        range: parameter.about().range.to_string(),
    };
    plane.parameters.entries().map(described).collect()
}

/// An axis as a page needs it.
fn axis(axis: &Axis) -> Value {
    json!({
        "name": axis.quantity.name(),
        "text": axis.to_string(),
        "first": axis.first,
        "last": axis.last,
        "count": axis.count,
        "log": !axis.spacing.is_linear(),
    })
}

/// A plane as a page asks for it.
pub fn asked(plane: &Plane, backend: &str, own: &'static Family) -> Value {
    let family = plane.parameters.family();
    let known = std::ptr::eq(family, own) || BUILTIN.iter().any(|builtin| builtin.name == family.origin);
    let system = match known {
        true => json!({ "name": family.origin }),
        false => json!({ "text": family.text }),
    };
    let varied =
        |parameter: Parameter| [plane.x.quantity, plane.y.quantity].contains(&Quantity::Parameter(parameter));
    let set: serde_json::Map<String, Value> = (plane.parameters.entries())
        .filter(|(parameter, _)| !varied(*parameter))
        .map(|(parameter, value)| (parameter.name().to_owned(), json!(value)))
        .collect();
    json!({
        "system": system,
        "x": plane.x.to_string(),
        "y": plane.y.to_string(),
        "set": set,
        "start": plane.start.to_string(),
        "transient": plane.task.transient,
        "observe": plane.task.observe,
        "max_period": plane.task.max_period,
        "fixed_periods": plane.task.fixed_periods,
        "backend": backend,
    })
}

/// A plane that is open.
pub fn scene(scene: &Scene, own: &'static Family) -> Value {
    let plane = &scene.plane;
    let family = plane.parameters.family();
    let stops: Vec<&str> = family.stops().iter().map(|stop| stop.name.as_str()).collect();
    let components: Vec<&str> = Component::all(family.n()).map(Component::name).collect();
    let ranges: Vec<[f64; 2]> = (0..components.len()).map(|of| component_range(plane, of)).collect();
    json!({
        "scene": scene.id,
        "plane": asked(plane, &scene.computing.asked.name(), own),
        "x": axis(&plane.x),
        "y": axis(&plane.y),
        "title": live_title(plane),
        "parameters": parameters(plane),
        "components": components,
        "component_ranges": ranges,
        "stops": stops,
        "system": { "name": family.name, "origin": family.origin, "text": family.text, "source": family.source },
        "layers": super::layer::layers(family),
        "start": plane.start.to_string(),
        "starts_symmetric": family.is_paper(),
        "backend": scene.computing.backend.name(),
        "adapter": scene.computing.backend.adapter(),
        "curves": crate::curves::check(plane).is_ok(),
    })
}

/// What every page is told first: the systems, the back ends, the plane to begin with.
pub fn hello(first: &Plane, backend: &str, own: &'static Family) -> Value {
    let entry = |name: &str, family: &'static Family| json!({ "name": name, "title": family.name, "text": family.text });
    let mut systems: Vec<Value> =
        BUILTIN.iter().map(|builtin| entry(builtin.name, Family::builtin(builtin.name))).collect();
    if !BUILTIN.iter().any(|builtin| builtin.name == own.origin) {
        systems.insert(0, entry(&own.origin, own));
    }
    json!({
        "type": "hello",
        "version": env!("CARGO_PKG_VERSION"),
        "layout": super::tile::VERSION,
        "systems": systems,
        "backends": backends::choosable(),
        "plane": asked(first, backend, own),
    })
}

/// A start in words.
pub fn start_words(start: Start) -> String {
    match start {
        Start::State(state) => format!("from {}", joined(&state, ", ")),
        Start::Rest => "from rest".into(),
        Start::Symmetric => "on the 1-1-1 motion, else from rest".into(),
    }
}
