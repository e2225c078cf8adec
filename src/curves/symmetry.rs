//! The mirror that all systems of a plane have.

use super::unknowns::Span;
use crate::model::{Setting, System};
use crate::plane::Plane;
use crate::theory::{Flow, Pattern, PeriodicMotion, StopSet};

/// Places of a plane at which its systems are asked for their mirror, as shares of its sides: none of them special.
const ASKED: [[f64; 2]; 5] =
    [[0.1732, 0.2236], [0.8661, 0.1414], [0.5291, 0.4796], [0.2646, 0.7874], [0.7483, 0.8307]];

/// The stops of a plane's systems; with the mirror where they all have the same.
///
/// A mirror that they have on a line of the plane alone is none: no motion can be followed off that line by its half.
pub(super) fn stops_of(plane: &Plane, spans: [Span; 2]) -> StopSet {
    let at = |shares: &[f64; 2]| {
        let parameters: Setting =
            spans.iter().zip(shares).fold(plane.parameters, |setting, (span, &share)| {
                setting.with(span.parameter, span.value(share))
            });
        System::new(parameters).ok().map(|system| StopSet::of(&system))
    };
    let mut asked = ASKED.iter().filter_map(at);
    let first = asked.next().unwrap_or_else(|| StopSet::of_family(plane.parameters.family()));
    if asked.all(|other| other == first) { first } else { first.without_mirror() }
}

/// A motion as one among the stops of its plane: in full where its own system alone has a mirror.
pub(super) fn among(stops: &StopSet, system: &System, motion: PeriodicMotion) -> PeriodicMotion {
    if motion.pattern.among == *stops {
        return motion;
    }
    let mut motion = if motion.pattern.mirrored { unfolded(system, &motion) } else { motion };
    motion.pattern.among = stops.clone();
    motion
}

/// A motion that is described by its half, described in full.
fn unfolded(system: &System, half: &PeriodicMotion) -> PeriodicMotion {
    let flow = Flow::new(system);
    let mut whole = half.clone();
    for (stop, section) in half.pattern.stops.iter().zip(&half.sections) {
        let begins = Pattern { stops: vec![*stop], ..half.pattern.clone() };
        whole.pattern.stops.push(begins.closing_stop());
        whole.sections.push(begins.closing(&flow, section).section);
    }
    whole.pattern.mirrored = false;
    whole.pattern.half_turns = 2 * half.pattern.half_turns;
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::plane::{Axis, Start};
    use crate::system::Family;
    use crate::theory::symmetric_motions;

    fn stops(family: &str, set: &[(&str, f64)], x: &str, y: &str) -> StopSet {
        let family = Family::builtin(family);
        let [x, y] = [x, y].map(|axis| Axis::of_family(axis, family).unwrap());
        let defaults = Setting::defaults(family);
        let parameters = set.iter().fold(defaults, |all, (name, value)| all.with_named(name, *value));
        let schedule = Schedule { transient: 1, observe: 1, max_period: 1, fixed_periods: false };
        let plane = Plane { x, y, parameters, start: Start::Rest, task: schedule };
        let spans = super::super::spans::spans(&plane).unwrap();
        stops_of(&plane, spans)
    }

    #[test]
    fn a_mirror_on_a_line_of_the_plane_is_none() {
        let two_sided = |set: &[_], y| stops("two-sided", set, "omega=1:2:5", y).has_mirror();
        assert!(two_sided(&[("beta", 1.0)], "delta=0.1:1:5"));
        assert!(!two_sided(&[("beta", 1.0)], "beta=0.5:1.5:5"));
        assert!(!two_sided(&[("beta", 2.0)], "delta=0.1:1:5"));
        assert!(stops("impact-pair", &[], "nu=1:2:5", "r=0.1:0.9:5").has_mirror());
    }

    #[test]
    fn a_symmetric_motion_in_full_is_the_same_motion() {
        let setting =
            Setting::defaults(Family::builtin("two-sided")).with_named("beta", 1.0).with_named("omega", 2.5);
        let system = System::new(setting).unwrap();
        let solutions = symmetric_motions(&system).unwrap();
        let half = &solutions.iter().find(|solution| solution.at_phase_zero.is_ok()).unwrap().motion;
        let stops = StopSet::of(&system).without_mirror();
        let whole = among(&stops, &system, half.clone());
        assert_eq!((whole.label(), whole.sections.len()), (half.label(), 2 * half.sections.len()));
        let refined = PeriodicMotion::refine(&system, &whole.pattern, &whole.sections).unwrap();
        for (found, given) in refined.sections.iter().zip(&whole.sections) {
            assert!((found - given).amax() < 1e-9, "{found} {given}");
        }
        let [half, whole] = [half, &whole].map(|motion| motion.multipliers(&system).unwrap());
        assert!(half.iter().zip(&whole).all(|(a, b)| (a - b).norm() < 1e-9), "{half:?} {whole:?}");
        assert!((half[0] - half[1]).norm() > 1e-9 || half[0].im == 0.0, "the check can fail");
    }
}
