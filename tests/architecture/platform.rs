//! What trajectories are computed with is the same on every machine: no function of the platform's mathematical library, whose
//! last bits are its own. libm, the crate, is the same everywhere; square roots are rounded the same by all.

use std::path::PathBuf;

use proc_macro2::{Delimiter, TokenTree};

use super::modules::of_the_program;
use super::{ident, is_punct, sources};

/// The rooms in which trajectories are computed, and where they begin.
const ROOMS: [&str; 5] = ["model", "dynamics", "analysis", "theory", "control"];

/// Methods of numbers that the platform's library has.
const OF_THE_PLATFORM: [&str; 22] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "exp2",
    "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "hypot", "cbrt",
];

/// Methods of the same names that are of something else: the exponential of a matrix, whose scalars are libm's.
const OF_OTHERS: [(&str, &str); 1] = [("theory/flow.rs", "exp")];

/// The methods of the platform that the rooms call.
fn calls(sources: &[(PathBuf, String)]) -> Vec<String> {
    let mut found = Vec::new();
    for (name, file, code) in of_the_program(sources) {
        if ROOMS.contains(&name[0].as_str()) {
            let of_others = |method: &str| OF_OTHERS.contains(&(&*file.to_string_lossy(), method));
            let called = called(&code).into_iter().filter(|method| !of_others(method));
            found.extend(called.map(|method| format!("{}: {method}", file.display())));
        }
    }
    found
}

/// The methods of the platform that some code calls, of whatever they are.
fn called(code: &[TokenTree]) -> Vec<String> {
    let mut found = Vec::new();
    for (i, token) in code.iter().enumerate() {
        if let TokenTree::Group(group) = token {
            found.extend(called(&group.stream().into_iter().collect::<Vec<_>>()));
        }
        let Some(method) = ident(Some(token)).filter(|name| OF_THE_PLATFORM.contains(&name.as_str())) else {
            continue;
        };
        let before = |count: usize| i.checked_sub(count).and_then(|i| code.get(i));
        // A field has no arguments, and another crate's function is no method.
        let has_arguments = matches!(
            code.get(i + 1),
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis
        );
        let is_of_number = matches!(ident(before(3)).as_deref(), Some("f64" | "f32"));
        if has_arguments && (is_punct(before(1), '.') || (is_punct(before(1), ':') && is_of_number)) {
            found.push(method);
        }
    }
    found
}

#[test]
fn trajectories_need_nothing_of_the_platform() {
    let wrong = calls(&sources("src", &["rs"]));
    assert!(wrong.is_empty(), "libm has these functions, the same on every machine: {wrong:#?}");
}

#[test]
fn calls_of_the_platform_are_found() {
    let found = |file: &str, text: &str| calls(&[(PathBuf::from(file), text.to_owned())]).len();
    for (text, count) in [
        ("fn f(x: f64) -> f64 { x.sin() }", 1),
        ("fn f(x: f64) -> f64 { g(x.ln() + f64::exp(x), [x.powf(0.5)]) }", 3),
        ("fn f(x: f64) -> f64 { libm::sin(x) + x.sqrt() + flight.sin }", 0),
        ("fn f() {}\n#[cfg(test)]\nmod tests { fn f(x: f64) -> f64 { x.sin() } }", 0),
    ] {
        assert_eq!(found("model/a.rs", text), count, "{text}");
        assert_eq!(found("curves/a.rs", text), 0);
    }
    let [parent, child] = ["#[cfg(test)]\nmod tests;", "fn f(x: f64) -> f64 { x.sin() }"].map(str::to_owned);
    let child = (PathBuf::from("model/a/tests.rs"), child);
    assert_eq!(calls(&[(PathBuf::from("model/a.rs"), parent), child.clone()]).len(), 0);
    assert_eq!(calls(&[child]).len(), 1);
}
