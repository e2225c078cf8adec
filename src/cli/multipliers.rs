//! How multipliers, states and sections are printed.

use std::ops::Range;

use impact_atlas::backend::{Backend, Cpu};
use impact_atlas::dynamics::Stop;
use impact_atlas::model::System;
use impact_atlas::theory::section_names;
use nalgebra::Complex;

use super::note;

/// Says that the CPU computes, for commands that know no other back end.
pub fn note_cpu() {
    note(&format!("computing on {}: {}", Cpu.name(), Cpu.adapter()));
}

/// Complex numbers as [real part, imaginary part].
pub fn pairs(values: Vec<Complex<f64>>) -> Vec<[f64; 2]> {
    // −0 is printed as 0.
    values.iter().map(|value| [value.re + 0.0, value.im + 0.0]).collect()
}

/// Complex numbers as text.
pub fn text(values: Option<&Vec<[f64; 2]>>) -> String {
    let Some(values) = values else {
        return "none: an impact grazes, or they are beyond all numbers".to_owned();
    };
    let text = |&[re, im]: &[f64; 2]| {
        let re = number(re, 6);
        match im {
            0.0 => re,
            _ if im < 0.0 => format!("{re} - {:.6}i", -im),
            _ => format!("{re} + {im:.6}i"),
        }
    };
    values.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// A number with so many decimals, and no sign where they are all 0.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| byte == b'0' || byte == b'.') => digits.to_owned(),
        _ => text,
    }
}

/// Below this, decimals would be zeros, and from its end on digits that mean nothing: numbers are written with an exponent there.
const PLAIN: Range<f64> = 1e-2..1e6;

/// A displacement or a velocity with so many decimals, where the largest that it stands beside has them.
fn measured(value: f64, decimals: usize, largest: f64) -> String {
    if largest == 0.0 || !largest.is_finite() || PLAIN.contains(&largest) {
        number(value, decimals)
    } else {
        format!("{:.decimals$e}", value + 0.0)
    }
}

/// A velocity as text.
pub fn velocity(value: f64) -> String {
    measured(value, 6, value.abs())
}

/// A state at forcing phase 0 as text.
pub fn state(state: &[f64]) -> String {
    let n = state.len() / 2;
    let name = |i: usize| if i < n { format!("x{}", i + 1) } else { format!("v{}", i + 1 - n) };
    point((0..2 * n).map(name), state)
}

/// A point of the impact Poincaré section at a stop as text.
pub fn section(system: &System, stop: Stop, section: &[f64]) -> String {
    let mut names = section_names(system, stop);
    // Just after the impact.
    names[0].push('+');
    point(names, section)
}

/// Displacements, velocities and phases with their names, by the first letter of which they are told apart.
pub fn point(names: impl IntoIterator<Item = String>, values: &[f64]) -> String {
    let named: Vec<(String, f64)> = names.into_iter().zip(values.iter().copied()).collect();
    let text = |(name, value): &(String, f64)| {
        let kind = name.chars().next();
        let same = named.iter().filter(|(other, _)| other.chars().next() == kind);
        let largest = same.fold(0.0, |largest: f64, (_, value)| largest.max(value.abs()));
        let text = if kind == Some('t') { number(*value, 9) } else { measured(*value, 9, largest) };
        format!("{name} {text}")
    };
    named.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// Stability as text.
pub fn stability(stable: Option<bool>) -> &'static str {
    match stable {
        Some(true) => "stable",
        Some(false) => "unstable",
        None => "without linear stability",
    }
}
