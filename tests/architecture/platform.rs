//! What trajectories are computed with is the same on every machine: no function of the platform's mathematical library, whose
//! last bits are its own. libm, the crate, is the same everywhere; square roots are rounded the same by all.

use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenTree};

use super::{files, ident, is_punct, tokens};

/// The rooms in which trajectories are computed, and where they begin.
const ROOMS: [&str; 5] = ["model", "dynamics", "analysis", "theory", "control"];

/// Methods of numbers that the platform's library has.
const OF_THE_PLATFORM: [&str; 22] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "exp2",
    "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "hypot", "cbrt",
];

/// Methods of the same names that are of something else: the exponential of a matrix, whose scalars are libm's.
const OF_OTHERS: [(&str, &str); 1] = [("theory/flow.rs", "exp")];

/// Files that tests alone are compiled with.
fn is_of_tests(file: &Path) -> bool {
    file.iter()
        .any(|part| ["tests", "tests.rs", "example.rs", "swing.rs"].iter().any(|of_tests| part == *of_tests))
}

/// The methods of the platform that files call outside their tests.
fn calls(files: &[(PathBuf, String)]) -> Vec<String> {
    let of_rooms = |file: &Path| ROOMS.iter().any(|room| file.starts_with(room)) && !is_of_tests(file);
    let mut found = Vec::new();
    for (file, text) in files.iter().filter(|(file, _)| of_rooms(file)) {
        let code = text.split("#[cfg(test)]\nmod tests").next().expect("there is a first part");
        let mut groups = vec![tokens(code)];
        while let Some(tokens) = groups.pop() {
            for (i, token) in tokens.iter().enumerate() {
                if let TokenTree::Group(group) = token {
                    groups.push(group.stream().into_iter().collect());
                }
                let name = ident(tokens.get(i + 1)).filter(|name| OF_THE_PLATFORM.contains(&name.as_str()));
                // Neither a field nor another type's function.
                let is_called = matches!(
                    tokens.get(i + 2),
                    Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis
                );
                let of_number = is_punct(Some(token), '.')
                    || (is_punct(Some(token), ':')
                        && matches!(
                            ident(i.checked_sub(2).and_then(|i| tokens.get(i))).as_deref(),
                            Some("f64" | "f32")
                        ));
                if let (Some(name), true, true) = (name, is_called, of_number)
                    && !OF_OTHERS.iter().any(|(of, other)| file == Path::new(of) && name == *other)
                {
                    found.push(format!("{}: {name}", file.display()));
                }
            }
        }
    }
    found
}

#[test]
fn trajectories_need_nothing_of_the_platform() {
    let files: Vec<_> = files("src")
        .into_iter()
        .filter(|(file, _)| file.extension().is_some_and(|end| end == "rs"))
        .collect();
    let wrong = calls(&files);
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
        assert_eq!(found("curves/a.rs", text) + found("model/a/tests.rs", text), 0);
    }
}
