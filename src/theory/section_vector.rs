//! A state just after an impact, and its forcing phase.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, DVectorView};

use crate::dynamics::Stop;

/// A state just after an impact, on the section at its stop: (v_c+, the other x, the other v, φ), 2n numbers, where c is
/// the contact's own coordinate and φ the forcing phase, not reduced. Non-dimensional; on the section at A of the paper's
/// oscillator it is the paper's X = (x1'+, x2, x2', τ). See [`section_names`](super::section_names).
pub type SectionVector = DVector<f64>;

/// The forcing phase of a section.
pub(crate) fn phase(section: &SectionVector) -> f64 {
    section[section.len() - 1]
}

/// The components of a section that are displacements and velocities.
pub(crate) fn mechanical(section: &SectionVector) -> DVectorView<'_, f64> {
    section.rows(0, section.len() - 1)
}

/// How large a section is, or the difference of two: its phase as it is, displacements and velocities in units of `unit`.
pub(crate) fn extent(section: &SectionVector, unit: f64) -> f64 {
    phase(section).abs().max(mechanical(section).amax() / unit)
}

/// So many of the system's own units are still of order one.
const FEW: f64 = 8.0;

/// What is of order one on a motion with some sections: `unit`, the system's own, or where displacements and velocities are many of
/// these, the largest.
pub(crate) fn unit_about<'a>(unit: f64, sections: impl IntoIterator<Item = &'a SectionVector>) -> f64 {
    let largest = sections.into_iter().map(|section| mechanical(section).amax()).fold(0.0, f64::max);
    // What is infinite or no number says nothing.
    if largest.is_finite() && largest > FEW * unit { largest } else { unit }
}

/// A section, or a deviation on it, with displacements and velocities so many times as large.
pub(crate) fn magnified(section: &SectionVector, factor: f64) -> SectionVector {
    let mut section = section.clone();
    let last = section.len() - 1;
    section.rows_mut(0, last).scale_mut(factor);
    section
}

/// A linear map of deviations on a section with displacements and velocities in units of `unit`: the same map, of entries that are of
/// one size. It also takes derivatives by the entries of the result back to those by the entries of the map.
pub(crate) fn in_units(mut map: DMatrix<f64>, unit: f64) -> DMatrix<f64> {
    let last = map.ncols() - 1;
    map.rows_mut(last, 1).scale_mut(unit);
    map.columns_mut(last, 1).unscale_mut(unit);
    map
}

/// An impact on a motion: where, and the state just after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The stop.
    pub stop: Stop,
    /// The state just after the impact.
    pub section: SectionVector,
}

/// A phase in [0, 2π).
pub(crate) fn wrapped(phase: f64) -> f64 {
    let phase = phase.rem_euclid(TAU);
    if phase < TAU { phase } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_of_order_one_follows_a_motion_that_is_far_larger_than_the_unit() {
        let section = |v: f64, x: f64, phase: f64| SectionVector::from_row_slice(&[v, x, 0.1, phase]);
        let about = |unit: f64, sections: &[SectionVector]| unit_about(unit, sections);
        assert_eq!(
            about(1.0, &[section(-3.9, 0.2, 9e9), section(0.3, -8.0, 0.0)]),
            1.0,
            "no phase is a length"
        );
        assert_eq!(about(1.0, &[section(1.0, 0.2, 0.0), section(0.3, -80.0, 0.0)]), 80.0);
        assert_eq!(about(0.01, &[section(0.2, 0.0, 0.0)]), 0.2);
        for wrong in [f64::NAN, f64::INFINITY] {
            assert_eq!(about(0.5, &[section(wrong, 0.2, 0.0)]), 0.5);
        }
        assert_eq!(about(0.5, &[]), 0.5);
    }
}
