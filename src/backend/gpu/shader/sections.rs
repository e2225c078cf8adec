//! Points of a section in WGSL: 2n components in two halves, whatever coordinate is the section's own.

use super::template::Shape;

/// What is done with points of a section and does not look the same for every number of coordinates.
pub fn source(shape: &Shape) -> String {
    let n = shape.coordinates;
    let component = |i: usize| {
        let half = if i < n { "head" } else { "tail" };
        format!("section.{half}{}", shape.component(i % n))
    };
    let listed =
        |values: Vec<String>| if n == 1 { values.concat() } else { format!("X({})", values.join(", ")) };
    let halves = |values: Vec<String>| {
        let (head, tail) = values.split_at(n);
        format!("SectionPoint({}, {})", listed(head.to_vec()), listed(tail.to_vec()))
    };
    let tau = component(2 * n - 1);
    let values: String = (0..2 * n).map(|i| format!("    values[{i}] = {};\n", component(i))).collect();
    let picked: String =
        (1..2 * n).map(|i| format!("    if i == {i}u {{ return {}; }}\n", component(i))).collect();
    format!(
        "// τ.
fn section_tau(section: SectionPoint) -> f32 {{
    return {tau};
}}

fn section_with_tau(given: SectionPoint, tau: f32) -> SectionPoint {{
    var section = given;
    {tau} = tau;
    return section;
}}

fn section_component(section: SectionPoint, i: u32) -> f32 {{
{picked}    return {first};
}}

// The components in order; the rest is 0.
fn section_values(section: SectionPoint) -> array<f32, MOST_COMPONENTS> {{
    var values = array<f32, MOST_COMPONENTS>();
{values}    return values;
}}

fn section_of_values(values: array<f32, COMPONENTS>) -> SectionPoint {{
    return {of_values};
}}

fn state_of_values(values: array<f32, COMPONENTS>) -> State {{
    return {state_of_values};
}}

fn x_of_values(values: array<f32, COORDINATES>) -> X {{
    return {x_of_values};
}}

// A point whose first component is this, and all others 0.
fn section_of_first(first: f32) -> SectionPoint {{
    return SectionPoint({only_first}, X());
}}

// The components of a state on the surface at phase τ.
fn surface_components(state: State, tau: f32) -> SectionPoint {{
{components}}}

// The displacements and velocities of components with d·x = `along`.
fn surface_unpacked(section: SectionPoint, along: f32) -> State {{
    let direction = flights[flow].normals[control.normal].direction;
{unpacked}}}
",
        first = component(0),
        of_values = halves((0..2 * n).map(|i| format!("values[{i}]")).collect()),
        state_of_values =
            halves((0..2 * n).map(|i| format!("values[{i}]")).collect()).replace("SectionPoint(", "State("),
        x_of_values = listed((0..n).map(|i| format!("values[{i}]")).collect()),
        only_first = listed((0..n).map(|i| if i == 0 { "first" } else { "0.0" }.to_owned()).collect()),
        components = cases(n, |own| {
            let part = |part: &str, i: usize| format!("state.{part}{}", shape.component(i));
            let mut values = vec![part("v", own)];
            values.extend(others(n, own).map(|i| part("x", i)));
            values.extend(others(n, own).map(|i| part("v", i)));
            values.push("tau".to_owned());
            halves(values)
        }),
        unpacked = cases(n, |own| {
            let direction = |i: usize| format!("direction{}", shape.component(i));
            let mut values = vec![String::new(); 2 * n];
            let mut rest = "along".to_owned();
            for (place, i) in others(n, own).enumerate() {
                values[i] = component(1 + place);
                values[n + i] = component(n + place);
                rest = format!("({rest} - {} * {})", direction(i), values[i]);
            }
            values[own] = format!("{rest} / {}", direction(own));
            values[n + own] = component(0);
            halves(values).replace("SectionPoint(", "State(")
        }),
    )
}

/// The coordinates but one, in order.
fn others(n: usize, own: usize) -> impl Iterator<Item = usize> {
    (0..n).filter(move |&i| i != own)
}

/// What is returned for each coordinate that may be the section's own.
fn cases(n: usize, value: impl Fn(usize) -> String) -> String {
    let asked: String =
        (1..n).map(|own| format!("    if control.own == {own}u {{ return {}; }}\n", value(own))).collect();
    format!("{asked}    return {};\n", value(0))
}
