//! Vectors of n components in WGSL: scalars for n = 1, `vec2`, `vec3`, `vec4` above; sums run from left to right.

use super::template::Shape;

/// The type X of a vector and what is done with it.
pub fn source(shape: &Shape) -> String {
    let n = shape.coordinates;
    let alias = if n == 1 { "f32".to_owned() } else { format!("vec{n}<f32>") };
    let each = |term: &dyn Fn(&str, usize) -> String, join: &str| -> String {
        (0..n).map(|i| term(shape.component(i), i)).collect::<Vec<_>>().join(join)
    };
    let fold = |function: &str, term: &dyn Fn(&str) -> String| -> String {
        (1..n).fold(term(shape.component(0)), |so_far, i| {
            format!("{function}({so_far}, {})", term(shape.component(i)))
        })
    };
    let values: String = (0..2 * n)
        .map(|i| {
            let part = if i < n { "x" } else { "v" };
            format!("    values[{i}] = state.{part}{};\n", shape.component(i % n))
        })
        .collect();
    let start = |part: usize| {
        let parts: Vec<String> = (0..n).map(|i| format!("cells[cell].start[{}]", part * n + i)).collect();
        if n == 1 { parts.concat() } else { format!("X({})", parts.join(", ")) }
    };
    let unit = |part: usize| {
        let parts: Vec<String> =
            (0..n).map(|i| format!("select(0.0, 1.0, k == {}u)", part * n + i)).collect();
        if n == 1 { parts.concat() } else { format!("X({})", parts.join(", ")) }
    };
    format!(
        "alias X = {alias};

// a · b.
fn along(a: X, b: X) -> f32 {{
    return {dot};
}}

// The largest |aᵢ|.
fn largest(a: X) -> f32 {{
    return {largest};
}}

// The largest |aᵢ bᵢ|.
fn largest_part(a: X, b: X) -> f32 {{
    return {largest_part};
}}

// The largest |aᵢ| or |bᵢ|.
fn largest_of(a: X, b: X) -> f32 {{
    return max(largest(a), largest(b));
}}

// Σ (aᵢ² + bᵢ²).
fn squares(a: X, b: X) -> f32 {{
    return {squares};
}}

// A matrix, given column by column, times a vector.
fn applied(columns: array<X, COORDINATES>, x: X) -> X {{
    return {applied};
}}

// y plus a matrix, given column by column, times x.
fn applied_onto(columns: array<X, COORDINATES>, x: X, y: X) -> X {{
    return {applied_onto};
}}

fn columns_scaled(a: f32, columns: array<X, COORDINATES>) -> array<X, COORDINATES> {{
    return array<X, COORDINATES>({columns_scaled});
}}

fn are_finite(a: X) -> bool {{
    return {are_finite};
}}

// x1 … xn, v1 … vn; the rest is 0.
fn state_values(state: State) -> array<f32, MOST_COMPONENTS> {{
    var values = array<f32, MOST_COMPONENTS>();
{values}    return values;
}}

// Component k is 1, all others 0.
fn state_unit(k: u32) -> State {{
    return State({unit_x}, {unit_v});
}}

// The start of this invocation's cell.
fn start_of_cell() -> State {{
    return State({start_x}, {start_v});
}}
",
        dot = each(&|c, _| format!("a{c} * b{c}"), " + "),
        largest = fold("max", &|c| format!("abs(a{c})")),
        largest_part = fold("max", &|c| format!("abs(a{c} * b{c})")),
        squares = each(&|c, _| format!("(a{c} * a{c} + b{c} * b{c})"), " + "),
        applied = each(&|c, i| format!("columns[{i}] * x{c}"), " + "),
        applied_onto = (0..n).fold("y".to_owned(), |so_far, i| {
            format!("({so_far} + columns[{i}] * x{})", shape.component(i))
        }),
        columns_scaled = each(&|_, i| format!("a * columns[{i}]"), ", "),
        are_finite = each(&|c, _| format!("is_finite(a{c})"), " && "),
        unit_x = unit(0),
        unit_v = unit(1),
        start_x = start(0),
        start_v = start(1),
    )
}
