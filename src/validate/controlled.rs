//! Two maps under control.

use super::agreement::Agreement;
use super::compare::compare;
use crate::control::SectionValues;
use crate::plane::ControlMap;

/// Compares the motions that two maps of the same plane under control reach.
///
/// End states are points on σ, the hardest impact of a period, their phases taken the short way round. Nothing is
/// continued: mirrored twins count with their whole difference.
///
/// # Panics
/// If the maps are not of the same plane.
pub fn compare_controlled(reference: &ControlMap, candidate: &ControlMap) -> Agreement {
    assert_eq!(reference.plane, candidate.plane, "only maps of the same plane can be compared");
    let ours = reference.motions();
    let mut theirs = candidate.motions();
    for (a, b) in ours.verdicts.iter().zip(&mut theirs.verdicts) {
        let [ours, theirs] = [&a.state, &b.state]
            .map(|state| SectionValues::from_slice(state).expect("a state has 2 to 8 values"));
        let away = theirs.minus(&ours);
        for ((b, &a), &away) in b.state.iter_mut().zip(a.state.iter()).zip(away.iter()) {
            *b = a + away;
        }
    }
    Agreement { layers: Vec::new(), ..compare(&ours, &theirs) }
}
