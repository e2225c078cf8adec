//! How motions gain and lose stability as ω falls.

use nalgebra::Complex;

use super::paper_point::PaperPoint;
use crate::model::{Parameters, System};
use crate::system::named;
use crate::theory::{
    PeriodicMotion, SymmetricMotion, flip_coefficient, neimark_sacker_coefficient, settled_motion,
    symmetric_motions,
};

named! {
    /// What the motion is like.
    pub(super) enum State {
        /// No physical motion.
        None = "none",
        /// Every multiplier of the half map within the unit circle.
        Stable = "stable",
        /// A real one beyond −1: the pitchfork was passed.
        BeyondMinusOne = "unstable, multiplier beyond −1",
        /// A real one beyond +1.
        BeyondOne = "unstable, multiplier beyond +1",
        /// A complex pair outside: the Neimark–Sacker bifurcation was passed.
        PairOutside = "unstable, complex pair outside",
    }
}

/// A change at a frequency, with falling ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Change {
    pub omega: f64,
    pub before: State,
    pub after: State,
    /// Whether what is lost is taken over by something stable; none where that has no meaning or no answer.
    pub supercritical: Option<bool>,
}

impl Change {
    /// "stable → Neimark–Sacker (supercritical) at ω = 2.5750", or the like.
    pub fn words(&self) -> String {
        let states = [self.before, self.after];
        let kind = if self.before == State::None {
            "it appears"
        } else if self.after == State::None {
            "it ceases to exist"
        } else if states.contains(&State::PairOutside) {
            "Neimark–Sacker"
        } else if states.contains(&State::BeyondMinusOne) {
            "pitchfork"
        } else {
            "fold"
        };
        let turn = if self.after == State::Stable { "regains stability" } else { "loses stability" };
        let turn = if states.contains(&State::None) { "" } else { turn };
        let gap = if turn.is_empty() { "" } else { ": " };
        let kind = format!("{turn}{gap}{kind}");
        let criticality = match self.supercritical {
            Some(true) => " (supercritical)",
            Some(false) => " (subcritical)",
            None => "",
        };
        format!("{kind}{criticality} at ω = {:.4}", self.omega)
    }
}

fn system(omega: f64, delta: f64) -> System {
    System::new(Parameters { omega, delta, ..Parameters::default() })
        .expect("the paper's plane is within the physical range")
}

/// The physical motion with the smaller multipliers, and its system.
fn motion(omega: f64, delta: f64) -> Option<(System, SymmetricMotion)> {
    let system = system(omega, delta);
    let physical = symmetric_motions(&system).ok()?.into_iter().filter(|motion| motion.at_phase_zero.is_ok());
    let steadiest =
        physical.min_by(|a, b| a.spectral_radius(&system).total_cmp(&b.spectral_radius(&system)))?;
    Some((system, steadiest))
}

/// What the physical 1-1-1 symmetric motion is like.
pub(super) fn state(omega: f64, delta: f64) -> State {
    let Some((system, motion)) = motion(omega, delta) else { return State::None };
    let Some(multipliers) = motion.motion.half_multipliers(&system) else { return State::None };
    match multipliers[0] {
        value if value.norm() < 1.0 => State::Stable,
        Complex { re, im: 0.0 } if re < 0.0 => State::BeyondMinusOne,
        Complex { im: 0.0, .. } => State::BeyondOne,
        _ => State::PairOutside,
    }
}

/// The changes from `high` down to `low`, looked for at so many frequencies and then located by bisection.
pub(super) fn changes(delta: f64, high: f64, low: f64, count: u32) -> Vec<Change> {
    let at = |i: u32| high + (low - high) * f64::from(i) / f64::from(count);
    let mut changes = Vec::new();
    let mut before = state(high, delta);
    for i in 1..=count {
        let after = state(at(i), delta);
        if after != before {
            let omega = located(delta, at(i - 1), at(i), before);
            changes.push(Change {
                omega,
                before,
                after,
                supercritical: criticality(delta, omega, before, after),
            });
        }
        before = after;
    }
    changes
}

/// Where the motion stops being like `first`, between two frequencies.
fn located(delta: f64, mut from: f64, mut until: f64, first: State) -> f64 {
    for _ in 0..45 {
        let middle = 0.5 * (from + until);
        if state(middle, delta) == first {
            from = middle;
        } else {
            until = middle;
        }
    }
    0.5 * (from + until)
}

fn criticality(delta: f64, omega: f64, before: State, after: State) -> Option<bool> {
    let states = [before, after];
    if !states.contains(&State::Stable) {
        return None;
    }
    let (system, motion) = motion(omega, delta)?;
    if states.contains(&State::PairOutside) {
        let largest = motion.motion.half_multipliers(&system)?[0];
        return neimark_sacker_coefficient(&system, &motion.motion, largest.arg().abs()).map(|c| c < 0.0);
    }
    if states.contains(&State::BeyondMinusOne) {
        return flip_coefficient(&system, &motion.motion).map(|c| c > 0.0);
    }
    None
}

/// Where a motion loses its stability.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loss {
    /// N-p-q.
    pub label: String,
    pub omega: f64,
    /// The multiplier of largest modulus there.
    pub multiplier: Complex<f64>,
}

impl Loss {
    /// What becomes of it.
    pub fn kind(&self) -> &'static str {
        match self.multiplier {
            Complex { re, im: 0.0 } if re < 0.0 => "by a multiplier −1 (period doubling)",
            Complex { im: 0.0, .. } => "by a multiplier +1",
            _ => "by a complex pair (Neimark–Sacker)",
        }
    }
}

/// The frequencies that a motion is followed over, and the halvings that locate its loss.
const STEPS: u32 = 200;
const HALVINGS: u32 = 40;

/// The motion on which a point settles, where that is a periodic one.
fn settled(point: &PaperPoint) -> Option<PeriodicMotion> {
    let verdict = point.verdict();
    let is_periodic = verdict.regime.is_periodic();
    is_periodic.then(|| settled_motion(&point.system(), verdict.state, verdict.n.into()).ok())?
}

/// Follows the motion on which a point settles to another frequency, and says where it loses its stability.
///
/// None where it settles on no periodic motion, or keeps its stability, or ceases to exist first.
pub(super) fn lost(point: &PaperPoint, until: f64) -> Option<Loss> {
    let mut motion = settled(point)?;
    let at = |omega: f64, from: &PeriodicMotion| {
        let system = system(omega, point.delta);
        let motion = PeriodicMotion::refine(&system, &from.pattern, &from.sections).ok()?;
        let largest = motion.multipliers(&system)?[0];
        Some((motion, largest))
    };
    let mut stable = point.omega;
    for i in 1..=STEPS {
        let omega = point.omega + (until - point.omega) * f64::from(i) / f64::from(STEPS);
        let (next, largest) = at(omega, &motion)?;
        if largest.norm() < 1.0 {
            (motion, stable) = (next, omega);
            continue;
        }
        let (mut unstable, mut multiplier) = (omega, largest);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stable + unstable);
            let (next, largest) = at(middle, &motion)?;
            if largest.norm() < 1.0 {
                (motion, stable) = (next, middle);
            } else {
                (unstable, multiplier) = (middle, largest);
            }
        }
        return Some(Loss { label: motion.label(), omega: 0.5 * (stable + unstable), multiplier });
    }
    None
}

/// Follows the motion on which a point settles to another frequency, stable or not, and says where it ceases to be a
/// motion: there it touches a stop, or one of its impacts comes to nothing.
///
/// None where it settles on no periodic motion, or is one all the way.
pub(super) fn grazes(point: &PaperPoint, until: f64) -> Option<f64> {
    let mut motion = settled(point)?;
    let near = |omega: f64, from: &PeriodicMotion| {
        let next = PeriodicMotion::refine(&system(omega, point.delta), &from.pattern, &from.sections).ok()?;
        (next.pattern == from.pattern).then_some(next)
    };
    let mut inside = point.omega;
    for i in 1..=STEPS {
        let omega = point.omega + (until - point.omega) * f64::from(i) / f64::from(STEPS);
        if let Some(next) = near(omega, &motion) {
            (motion, inside) = (next, omega);
            continue;
        }
        let mut outside = omega;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            match near(middle, &motion) {
                Some(next) => (motion, inside) = (next, middle),
                None => outside = middle,
            }
        }
        return Some(0.5 * (inside + outside));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_pitchfork_is_met() {
        let found = changes(0.1, 3.8, 3.6, 10);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].before, found[0].after), (State::Stable, State::BeyondMinusOne));
        assert!((found[0].omega - 3.6907).abs() < 1e-4 && found[0].supercritical == Some(true), "{found:?}");
        assert!(found[0].words().starts_with("loses stability: pitchfork (supercritical) at ω = 3.690"));
        assert_eq!(changes(0.1, 3.8, 3.7, 10), [], "nothing happens above");
    }

    #[test]
    fn a_motion_is_followed_to_its_loss() {
        let loss = lost(&PaperPoint::new(1.63, 0.1), 1.62).unwrap();
        assert_eq!((&*loss.label, loss.kind()), ("2-4-4", "by a multiplier −1 (period doubling)"));
        assert!((1.626..1.627).contains(&loss.omega), "{loss:?}");
        assert_eq!(lost(&PaperPoint::new(1.63, 0.1), 1.629), None, "it is stable there");
        assert_eq!(lost(&PaperPoint::new(2.83, 0.1), 2.8), None, "chaos has no motion to follow");
    }

    /// The period doubling lies between 2.9298 and 2.9299; the motion goes on, unstable, until it touches.
    #[test]
    fn a_motion_is_followed_beyond_its_loss_to_where_it_grazes() {
        let point = PaperPoint::new(2.95, 0.1);
        let (lost, touches) = (lost(&point, 2.92).unwrap(), grazes(&point, 2.92).unwrap());
        assert!((2.9298..2.9299).contains(&lost.omega), "{lost:?}");
        assert!(touches < lost.omega && touches > 2.92, "{touches}");
        assert_eq!(grazes(&point, 2.93), None, "it does not touch down to there");
    }
}
