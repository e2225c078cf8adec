//! The control methods in WGSL: what of one is at work is asked by its code.

use std::fmt::Write;

use crate::backend::gpu::layout::{code, declaration_of_adapted, declaration_of_control};
use crate::control::METHODS;

/// What each method does under its own name: the head of the function, its arguments, and what there is without control.
const ACTS: [(&str, &str, &str, &str); 3] = [
    ("act", "seen: Seen) -> Action", "seen", "action_none()"),
    // Whether the method itself has come to rest.
    ("is_at_rest", ") -> bool", "", "true"),
    // What it makes of the deviation of an arriving point.
    ("passed", "seen: Seen, arrived: SectionPoint) -> SectionPoint", "seen, arrived", "arrived"),
];

/// The structs `Control` and `Adapted`, and the functions `adapted_begin`, `method_act`, `method_is_at_rest` and `method_passed`.
pub fn source() -> String {
    let mut source = declaration_of_control() + &declaration_of_adapted();
    for (name, head, given, without) in ACTS {
        writeln!(source, "fn method_{name}({head} {{").expect("a string takes anything");
        for method in METHODS {
            let (own, code) = (method.name, code(method));
            writeln!(source, "    if control.method == {code}u {{ return {own}_{name}({given}); }}")
                .expect("a string takes anything");
        }
        writeln!(source, "    return {without};\n}}").expect("a string takes anything");
    }
    source
}
