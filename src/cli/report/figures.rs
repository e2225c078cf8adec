//! The figures of checks, as they are printed.

use impact_atlas::validate::Check;

pub fn figure(value: f64) -> String {
    if value >= 2.0 && value.fract() == 0.0 {
        return format!("{value:.0}");
    }
    if value == 0.0 || value.abs() >= 1e-3 { format!("{value:.5}") } else { format!("{value:.2e}") }
}

pub fn bound(check: &Check) -> String {
    format!("{} {}", if check.at_least { "at least" } else { "at most" }, check.bound)
}
