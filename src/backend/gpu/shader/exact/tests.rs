use super::*;

/// A kernel that computes something from two numbers.
fn kernel(what: &str) -> String {
    let begin = "struct Dispatch { begin: u32 }\n@group(0) @binding(0) var<uniform> dispatch: Dispatch;\n";
    let out = "@group(0) @binding(1) var<storage, read_write> out: array<f32>;\n";
    let main = format!("@compute @workgroup_size(1) fn main() {{ let a = out[0]; let b = out[1]; {what} }}");
    [Arithmetic::Exact.source(), begin, out, &main].concat()
}

/// How many expressions of an entry point are combined with the zero, and how many functions it calls.
fn counts(what: &str) -> (usize, usize) {
    let module = exact(&kernel(what)).unwrap();
    let function = &module.entry_points[0].function;
    let is_guard = |expression: &&Expression| {
        matches!(expression, Expression::Binary { op: BinaryOperator::ExclusiveOr, .. })
    };
    let guards = function.expressions.iter().map(|(_, expression)| expression).filter(is_guard).count();
    let calls = function.body.iter().filter(|statement| matches!(statement, Statement::Call { .. })).count();
    (guards, calls)
}

#[test]
fn every_operation_is_guarded_or_called() {
    assert_eq!(counts("out[0] = a * b + a;"), (2, 0));
    assert_eq!(counts("out[0] = a / b - sqrt(a);"), (1, 2));
    assert_eq!(counts("out[0] = max(abs(a), -b);"), (0, 0));
    assert_eq!(counts("let v = vec3<f32>(a, b, a) * 2.0; out[0] = v.x;"), (1, 0));
    assert_eq!(counts("let v = vec3<f32>(a, b, a) / vec3<f32>(b); out[0] = v.x;"), (0, 3));
    assert_eq!(counts("out[u32(a) + 1u] = b;"), (0, 0));
}

#[test]
fn what_has_no_exact_form_is_refused() {
    for what in ["sin(a)", "fma(a, b, a)", "dot(vec2<f32>(a, b), vec2<f32>(b, a))", "a % b", "log(a)"] {
        let refused = exact(&kernel(&format!("out[0] = {what};"))).unwrap_err();
        assert!(refused.contains("has no exact form"), "{what}: {refused}");
    }
}
