//! A shader holds no policy of its own: its thresholds and codes are named, and generated from Rust.
//!
//! 0, 1, 2 and ½ in any spelling are arithmetic: nothing, one, twice, half, the next, parity. Any other number, and every order
//! between codes, is policy until shown otherwise: it is generated, or stands below with its file, how often it occurs there,
//! and why both sides may write it.

use std::path::{Path, PathBuf};

use super::files;

/// Numbers that are arithmetic wherever they stand.
const ARITHMETIC: [f64; 4] = [0.0, 1.0, 2.0, 0.5];

/// Numbers that a formula consists of: the file, the number, how often it is there, and the formula.
const FORMULAS: [(&str, &str, usize, &str); 35] = [
    ("analysis/extent.wgsl", "0.25", 1, "a quarter of a piece, from one point of its quadrature to the next"),
    ("analysis/extent.wgsl", "15.0", 1, "quadrature exact to degree 5: (7a + 16m + 7b)/15"),
    ("analysis/extent.wgsl", "16.0", 1, "quadrature exact to degree 5: (7a + 16m + 7b)/15"),
    ("analysis/extent.wgsl", "3.0", 1, "the cubic through two values and slopes: s²(3 − 2s)"),
    ("analysis/extent.wgsl", "7.0", 1, "quadrature exact to degree 5: (7a + 16m + 7b)/15"),
    ("control/controlled.wgsl", "3u", 1, "the four lanes of a vec4, numbered"),
    ("control/section_point.wgsl", "0.25", 1, "four quarter turns make a turn"),
    ("control/section_point.wgsl", "4.0", 1, "four quarter turns make a turn"),
    ("dynamics/chatter.wgsl", "1.5", 1, "k = 3a(1 − r)/(2c)"),
    (
        "dynamics/chatter.wgsl",
        "3.0",
        2,
        "u falls like exp(−ct/3); a force that grows by c ends rebounds sooner by c/3",
    ),
    ("dynamics/closing.wgsl", "3.0", 1, "a gap integral goes with the third power of a speed"),
    ("dynamics/contact.wgsl", "4.0", 1, "the discriminant b² − 4ac"),
    ("dynamics/course.wgsl", "3", 1, "the term of third degree"),
    ("dynamics/course.wgsl", "3.0", 1, "the derivative of a power"),
    ("dynamics/hull.wgsl", "0.25", 1, "the second and the fourth of five Bernstein coefficients"),
    ("dynamics/quintic.wgsl", "3.0", 4, "the polynomials through two values and slopes; derivatives"),
    ("dynamics/quintic.wgsl", "4.0", 4, "the same; derivatives; the discriminant b² − 4ac"),
    (
        "dynamics/quintic.wgsl",
        "5.0",
        2,
        "the quintic through two values and slopes; the derivative of a power",
    ),
    ("dynamics/touching.wgsl", "0.125", 1, "s(w − s)/2 is w²/8 at most"),
    ("model/logarithm.wgsl", "0x007fffffu", 1, "the bits of the fraction in an f32"),
    ("model/logarithm.wgsl", "0x3f800000u", 1, "the bits of 1 in an f32"),
    ("model/logarithm.wgsl", "127", 1, "the bias of the exponent in an f32"),
    ("model/logarithm.wgsl", "23u", 1, "the length of the fraction in an f32"),
    ("model/logarithm.wgsl", "3", 1, "the last of four terms"),
    ("shared/exact.wgsl", "0x007fffffu", 1, "the bits of the fraction in an f32"),
    ("shared/exact.wgsl", "0x0c000000u", 1, "24 in the exponent of an f32"),
    ("shared/exact.wgsl", "0x7f800000u", 1, "the bits of the exponent in an f32"),
    ("shared/exact.wgsl", "1e-12", 1, "far from underflow; there is no such correction in Rust"),
    ("shared/exact.wgsl", "1e-34", 2, "as far from underflow, once what is small is scaled"),
    ("shared/exact.wgsl", "1e34", 1, "a quotient as far from overflow"),
    ("shared/exact.wgsl", "38", 2, "2³⁸, the root of what scales small numbers"),
    ("shared/exact.wgsl", "76", 2, "2⁷⁶, what scales small numbers"),
    ("shared/exact.wgsl", "1e12", 1, "far from overflow; there is no such correction in Rust"),
    ("shared/exact.wgsl", "4097.0", 2, "2¹² + 1 splits an f32 in halves"),
    ("shared/numbers.wgsl", "0x7f800000u", 2, "the bits of the exponent in an f32"),
];

/// Codes whose order means nothing.
const CODES: [&str; 7] = ["REGIME_", "STAGE_", "PROGRESS_", "EVENT_", "EXTENT_", "METHOD_", "CONVENTION_"];

/// A shader without its comments and attributes.
fn code(text: &str) -> String {
    let mut code = String::new();
    for line in text.lines() {
        let line = line.split("//").next().unwrap_or("");
        let mut parts = line.split('@');
        code.push_str(parts.next().unwrap_or(""));
        for part in parts {
            // `@group(0)`: what is between the brackets belongs to the attribute.
            code.push_str(part.split_once(')').map_or("", |(_, after)| after));
        }
        code.push('\n');
    }
    code
}

/// The words of a shader: names, numbers, and whatever else consists of letters, digits, `_`, `$` and points.
fn words(code: &str) -> Vec<(usize, &str)> {
    let part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '$' | '.');
    let mut words = Vec::new();
    let mut from = None;
    for (i, c) in code.char_indices() {
        let exponent = |from: usize| {
            let so_far = &code[from..i];
            matches!(c, '+' | '-')
                && so_far.starts_with(|c: char| c.is_ascii_digit())
                && !so_far.starts_with("0x")
                && so_far.ends_with(['e', 'E'])
        };
        match from {
            Some(begin) if !part(c) && !exponent(begin) => {
                words.push((begin, &code[begin..i]));
                from = None;
            }
            None if part(c) => from = Some(i),
            _ => {}
        }
    }
    words
}

/// The value of a number; none of a word that is none.
fn value(word: &str) -> Option<f64> {
    if !word.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    if let Some(digits) = word.strip_prefix("0x") {
        return u64::from_str_radix(digits.trim_end_matches(['u', 'i']), 16).ok().map(|bits| bits as f64);
    }
    word.trim_end_matches(['u', 'i', 'f', 'h']).parse().ok()
}

/// The numbers of a shader that are not arithmetic, in their order.
fn policy(text: &str) -> Vec<String> {
    let code = code(text);
    let number = |&(_, word): &(usize, &str)| value(word).is_some_and(|value| !ARITHMETIC.contains(&value));
    words(&code).iter().filter(|word| number(word)).map(|(_, word)| (*word).to_owned()).collect()
}

/// The codes of a shader that are compared by their order.
fn ordered(text: &str) -> Vec<String> {
    let code = code(text);
    let among = |word: &str| CODES.iter().any(|kind| word.starts_with(kind));
    let beside = |(at, word): (usize, &str)| {
        let before = code[..at].trim_end().trim_end_matches('=').ends_with(['<', '>']);
        let after = code[at + word.len()..].trim_start().starts_with(['<', '>']);
        (before || after).then(|| word.to_owned())
    };
    words(&code).into_iter().filter(|(_, word)| among(word)).filter_map(beside).collect()
}

/// What is wrong with the numbers of some shaders, given the formulas that they may hold.
fn undeclared(shaders: &[(PathBuf, String)], formulas: &[(&str, &str, usize, &str)]) -> Vec<String> {
    let mut wrong = Vec::new();
    let declared = |file: &Path, number: &str| {
        formulas.iter().find(|(of, known, ..)| Path::new(of) == file && *known == number)
    };
    for (file, text) in shaders {
        let numbers = policy(text);
        for number in &numbers {
            let there = numbers.iter().filter(|other| *other == number).count();
            if declared(file, number).is_none_or(|&(_, _, times, _)| times != there) {
                wrong.push(format!("{}: {number}, {there} times", file.display()));
            }
        }
    }
    for (file, number, ..) in formulas {
        let text = shaders.iter().find(|(shader, _)| shader == Path::new(file));
        if text.is_none_or(|(_, text)| !policy(text).iter().any(|there| there == number)) {
            wrong.push(format!("{file}: {number} is declared and not there"));
        }
    }
    wrong
}

#[test]
fn shaders_have_no_threshold_of_their_own() {
    let shaders = files("shaders");
    let wrong = undeclared(&shaders, &FORMULAS);
    assert!(
        wrong.is_empty(),
        "name it in Rust and generate it, or say which formula it belongs to: {wrong:#?}"
    );
    assert!(FORMULAS.iter().all(|(.., why)| !why.is_empty()));
}

#[test]
fn codes_are_not_compared_by_their_order() {
    for (file, text) in files("shaders") {
        let wrong = ordered(&text);
        assert!(wrong.is_empty(), "{}: ask a predicate generated from Rust: {wrong:?}", file.display());
    }
}

#[test]
fn thresholds_and_orders_are_found() {
    let found = |text: &str| undeclared(&[(PathBuf::from("a.wgsl"), text.to_owned())], &[]).len();
    assert_eq!(found("fn f() -> bool { return since >= 3u * n; }\n"), 1);
    assert_eq!(found("let a = observe / 4u;\nlet b = array<f32, 8>();\nlet c = 1e-4 + 0x10u + 1.5e+3;\n"), 5);
    assert_eq!(found("// 3 of them\n@binding(7) var<storage> x3: vec4<f32>; //: each 5\n"), 0);
    assert_eq!(found("a[0] = 2.0 * b$k.x + 0.5 * c[$i + 1u] - 1e0;\n"), 0);
    assert_eq!(found("let a = min(observe / 4u, b);\nlet c = d / 4u;\n"), 2);
    let known = |times: usize| {
        undeclared(&[(PathBuf::from("a.wgsl"), "a(4u, 4u)\n".to_owned())], &[("a.wgsl", "4u", times, "why")])
    };
    assert!(known(2).is_empty());
    assert_eq!(known(1).len(), 2, "one more than was declared");
    assert_eq!(undeclared(&[], &[("a.wgsl", "4u", 1, "why")]).len(), 1, "declared and gone");
    assert_eq!(ordered("if event >= EVENT_IMPACT && EVENT_CAUGHT <= event { }\n").len(), 2);
    assert!(ordered("if event == EVENT_IMPACT || (a < b) == (c > d) { }\n").is_empty());
}
