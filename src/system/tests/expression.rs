//! Expressions: what they mean, what they name, where they have no value.

use super::super::ExpressionError;
use super::super::expression::{Expression, has_meaning};

fn compile(text: &str) -> Result<Expression, ExpressionError> {
    Expression::compile(text, &["a".to_owned(), "b".to_owned(), "e".to_owned()])
}

/// At a = 3, b = 4, e = 0.5.
fn value(text: &str) -> f64 {
    compile(text).unwrap().evaluate(&[3.0, 4.0, 0.5]).unwrap()
}

#[test]
fn expressions_mean_what_mathematics_means() {
    let cases = [
        ("1", 1.0),
        ("-2.5e-1", -0.25),
        ("b", 4.0),
        (" a ", 3.0),
        ("1 - a - b", -6.0),
        ("12/a*b", 16.0),
        ("12/a/b", 1.0),
        ("-a^2", -9.0),
        ("2^a^2", 512.0),
        ("2**a", 8.0),
        ("a^-1*3", 1.0),
        ("sqrt(a^2 + b^2)", 5.0),
        ("min(a, b) + max(a, b, 5)*abs(-2)", 13.0),
        ("min(max(a, 1), b) - 3", 0.0),
        ("exp(0) + cos(0) + sin(0)", 2.0),
        ("1/2", 0.5),
        ("e", 0.5),
    ];
    for (text, expected) in cases {
        assert_eq!(value(text), expected, "{text}");
    }
    assert!((value("sin(pi/6)") - 0.5).abs() < 1e-15);
}

#[test]
fn every_use_of_a_parameter_is_found_once() {
    let uses = |text: &str| compile(text).unwrap().uses().map(|id| id.index()).collect::<Vec<_>>();
    assert_eq!(uses("b*a + b"), [1, 0]);
    assert_eq!(uses("0*b + abs(min(1, e))"), [1, 2]);
    assert!(uses("pi/2").is_empty());
}

#[test]
fn a_formula_that_another_family_wrote_reads_its_own_parameters() {
    let here = Expression::compile("a - b", &["a".to_owned(), "b".to_owned()]).unwrap();
    let there = Expression::compile("a - b", &["b".to_owned(), "a".to_owned()]).unwrap();
    assert_eq!(here.evaluate(&[3.0, 1.0]), Ok(2.0));
    assert_eq!(there.evaluate(&[3.0, 1.0]), Ok(-2.0));
}

#[test]
fn what_is_no_expression_says_why_and_where() {
    let cases = [
        ("", "unexpected end of expression at character 1"),
        ("2*", "unexpected end of expression at character 3"),
        ("2 a", "unexpected token at character 3"),
        ("(a", "unclosed parenthesis at character 1"),
        ("a = 1", "unexpected character at character 3"),
        ("a + µ", "unexpected character at character 5"),
        ("2*omga", "`omga` in `2*omga` is not a parameter"),
        ("a + nan", "`nan` in `a + nan` is not a parameter"),
        ("2(a)", "unexpected token at character 2"),
        ("a(b + 1)", "`a` in `a(b + 1)` is not a function"),
        ("sqrt(a, b)", "`sqrt(a, b)` in `sqrt(a, b)` has the wrong number of arguments"),
        ("a > b", "`a > b` compares"),
        ("a > b ? a : b", "compares"),
        ("a && b", "compares"),
        ("1e400", "invalid number at character 1"),
        ("1/(2 - 2)", "`1/(2 - 2)` divides by zero: correct it"),
        ("sqrt(-1)", "`sqrt(-1)` is not a number (NaN)"),
    ];
    for (text, fragment) in cases {
        let message = compile(text).unwrap_err().to_string();
        assert!(message.contains(fragment), "{text}: {message}");
    }
    let known = compile("omga").unwrap_err().to_string();
    assert!(known.ends_with("write one of a, b, e"), "{known}");
}

#[test]
fn a_part_without_a_value_is_named() {
    let fault = |text: &str, values: &[f64]| compile(text).unwrap().evaluate(values).unwrap_err().to_string();
    assert_eq!(fault("1 + a/(b - 4)", &[3.0, 4.0, 0.5]), "`a/(b - 4)` divides by zero in `1 + a/(b - 4)`");
    assert_eq!(fault("sqrt(a)", &[-1.0, 0.0, 0.0]), "`sqrt(a)` is not a number (NaN)");
    assert_eq!(fault("a^b", &[-1.0, 0.5, 0.0]), "`a^b` is not a number (NaN)");
    assert_eq!(fault("exp(a)", &[1e4, 0.0, 0.0]), "`exp(a)` is too large a number");
    assert_eq!(fault("0^a", &[-1.0, 0.0, 0.0]), "`0^a` divides by zero");
}

#[test]
fn functions_and_constants_have_a_meaning() {
    for name in ["pi", "mod", "sqrt", "min", "atan2", "exp"] {
        assert!(has_meaning(name), "{name}");
    }
    for name in ["e", "tau", "gamma", "omega", "mu_m"] {
        assert!(!has_meaning(name), "{name}");
    }
}
