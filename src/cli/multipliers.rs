//! How multipliers and sections are printed.

use impact_atlas::backend::{Backend, Cpu};
use nalgebra::Complex;

use super::note;

/// Says that the CPU computes, for commands that know no other back end.
pub fn note_cpu() {
    note(&format!("computing on {}: {}", Cpu.name(), Cpu.adapter()));
}

/// Complex numbers as [real part, imaginary part].
pub fn pairs(values: [Complex<f64>; 4]) -> [[f64; 2]; 4] {
    // −0 is printed as 0.
    values.map(|value| [value.re + 0.0, value.im + 0.0])
}

/// Complex numbers as text.
pub fn text(values: Option<&[[f64; 2]; 4]>) -> String {
    let Some(values) = values else {
        return "none: an impact grazes, or they are beyond all numbers".to_owned();
    };
    let texts = values.map(|[re, im]| {
        let re = number(re, 6);
        match im {
            0.0 => re,
            _ if im < 0.0 => format!("{re} - {:.6}i", -im),
            _ => format!("{re} + {im:.6}i"),
        }
    });
    texts.join(", ")
}

/// A number with so many decimals, and no sign where they are all 0.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| byte == b'0' || byte == b'.') => digits.to_owned(),
        _ => text,
    }
}

/// A state at forcing phase 0 as text.
pub fn state(state: [f64; 4]) -> String {
    let [x1, x2, v1, v2] = state.map(|value| number(value, 9));
    format!("x1 {x1}, x2 {x2}, v1 {v1}, v2 {v2}")
}

/// A point of the impact Poincaré section as text.
pub fn section(section: [f64; 4]) -> String {
    let [v1, x2, v2, tau] = section.map(|value| number(value, 9));
    format!("v1+ {v1}, x2 {x2}, v2 {v2}, tau {tau}")
}

/// Stability as text.
pub fn stability(stable: Option<bool>) -> &'static str {
    match stable {
        Some(true) => "stable",
        Some(false) => "unstable",
        None => "without linear stability",
    }
}
