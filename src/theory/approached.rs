//! The periodic motion that a trajectory approaches: the exact one beside it.
//!
//! A strobe state that comes back within a small distance may spiral in slowly, alternate about a motion of half the
//! period, or wander in a narrow band. Newton's method tells which: the exact motion beside the state has a period,
//! multipliers, and a linear map that foretells where the state must be one turn later.

use nalgebra::DVector;

use super::strobe::StrobeMotion;
use crate::analysis::{Counts, Measures, Regime, Verdict};
use crate::model::{StateVector, System};

/// The largest distance of a strobe state from the motion that it approaches, for states of order one.
const NEAR: f64 = 1e-2;
/// The largest share of its distance by which a state may be, one turn later, from where the Jacobian foretells it.
const FORETOLD: f64 = 0.2;
/// What single precision and the closing of chatter leave uncertain about a state of order one.
const UNCERTAIN: f64 = 1e-6;
/// −ln of a multiplier so close to one that symmetry cannot be told from a strobe state: it takes a hundred periods to
/// come ten thousand times closer.
const BARELY: f64 = 0.1;

/// The stable motion that a strobe state approaches which comes back after `n` forcing periods: of that period, of a
/// divisor, or of twice as much, since a motion that has just doubled its period returns closely after half of it.
///
/// None where the exact motion is unstable, or where one turn does not lead the state towards it.
pub fn approached(system: &System, state: StateVector, n: u32) -> Option<StrobeMotion> {
    [n, 2 * n].into_iter().find_map(|n| approached_from(system, &state[..], &state[..], n))
}

/// The stable motion that a strobe state approaches, found from `guess` with Newton's method over `n` forcing periods.
pub fn approached_from(
    system: &System,
    guess: impl AsRef<[f64]>,
    state: impl AsRef<[f64]>,
    n: u32,
) -> Option<StrobeMotion> {
    let between = |state: &[f64]| system.between_stops(state.to_vec());
    let motion = StrobeMotion::refine(system, between(guess.as_ref()), n).ok()?;
    (motion.is_stable() == Some(true) && leads_to(system, &between(state.as_ref()), &motion))
        .then_some(motion)
}

/// Whether one turn from a state near a motion ends where the motion's Jacobian foretells it.
fn leads_to(system: &System, state: &[f64], motion: &StrobeMotion) -> bool {
    let exact = DVector::from_column_slice(&motion.state);
    let scale = system.unit() + exact.amax();
    let before = DVector::from_column_slice(state) - &exact;
    if before.amax() > NEAR * scale {
        return false;
    }
    let Some(after) = StrobeMotion::turned(system, state, motion.n) else { return false };
    let missed = DVector::from_vec(after) - exact - &motion.jacobian * &before;
    missed.norm() <= FORETOLD * before.norm() + UNCERTAIN * scale
}

/// A verdict with what the exact motion says of it: label, symmetry, exponent, state, and what is measured, as far as it was observed.
pub fn with_motion(verdict: &Verdict, motion: &StrobeMotion) -> Verdict {
    let observed = verdict.measures.observed;
    let turns = f64::from(observed) / f64::from(motion.n);
    let regime = if motion.sticking { Regime::PeriodicSticking } else { Regime::Periodic };
    Verdict {
        regime,
        n: motion.n as u16,
        counts: Counts::new(&motion.counts()),
        symmetric: motion.symmetric,
        lyapunov: motion.exponent().map_or(f32::NAN, |exponent| exponent as f32),
        state: StateVector::from_slice(&motion.state).unwrap_or(verdict.state),
        impacts: (turns * f64::from(motion.met)).round() as u32,
        peak_impact_velocity: motion.peak as f32,
        measures: Measures { observed, ..motion.measures },
        returning: 0,
        ..*verdict
    }
}

/// A verdict in doubt with what the exact motion says of it; none where the verdict is in no doubt, or no motion answers.
///
/// In doubt is a strobe state that comes back without having settled. So is a periodic verdict whose largest multiplier is
/// close to one in modulus: beside a pitchfork an unsymmetric motion passes for a symmetric one, and a state that still
/// spirals in for an unsymmetric one. A period with a positive exponent contradicts itself: where no exact motion
/// is approached either, it is unresolved.
pub fn confirmed(system: &System, verdict: &Verdict) -> Option<Verdict> {
    if verdict.returning == 0 && forgets_everything(system, verdict) {
        return Some(Verdict { lyapunov: f32::NEG_INFINITY, ..*verdict });
    }
    let n = if verdict.returning > 0 { verdict.returning } else { barely_attracting(verdict)? };
    let motion = approached(system, verdict.state, u32::from(n)).filter(StrobeMotion::has_impacts);
    match motion {
        Some(motion) => Some(with_motion(verdict, &motion)),
        None => contradicts_itself(verdict).then(|| undone(verdict)),
    }
}

/// Whether every deviation from a periodic motion dies out within a period: all that moves, but for a drift, comes to rest on a stop.
fn forgets_everything(system: &System, verdict: &Verdict) -> bool {
    verdict.regime == Regime::PeriodicSticking && system.dimension() == 2
}

/// N of a periodic verdict whose largest multiplier is close to one in modulus, as far as its exponent was measured.
fn barely_attracting(verdict: &Verdict) -> Option<u16> {
    let growth = f64::from(verdict.lyapunov) * f64::from(verdict.n);
    (verdict.regime.is_periodic() && growth > -BARELY).then_some(verdict.n)
}

/// Whether a verdict has a period and a positive exponent.
fn contradicts_itself(verdict: &Verdict) -> bool {
    verdict.regime.is_periodic() && verdict.lyapunov > 0.0
}

/// A verdict without the motion that it named, to be looked at for longer.
fn undone(verdict: &Verdict) -> Verdict {
    Verdict {
        regime: Regime::Unresolved,
        n: 0,
        counts: Counts::default(),
        symmetric: false,
        returning: verdict.n,
        ..*verdict
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;

    fn system(omega: f64, delta: f64) -> System {
        System::new(Parameters { omega, delta, ..Parameters::default() }).unwrap()
    }

    /// The 1-3-2 motion beside its period doubling, multiplier −0.9927.
    fn flipping() -> (System, StrobeMotion) {
        let system = system(1.338_983_050_847_457_6, 0.14);
        let state = StrobeMotion::turned(&system, [0.0; 4], 4000).unwrap();
        let motion = StrobeMotion::refine(&system, state, 1).unwrap();
        (system, motion)
    }

    #[test]
    fn twice_the_period_of_a_motion_is_found_to_be_the_motion() {
        let (system, motion) = flipping();
        let doubled = StrobeMotion::refine(&system, &motion.state, 2).unwrap();
        assert_eq!((doubled.n, doubled.label()), (1, motion.label()));
    }

    #[test]
    fn a_state_that_alternates_about_a_motion_approaches_it_and_one_far_away_does_not() {
        let (system, motion) = flipping();
        assert!(motion.is_stable().unwrap());
        let beside = |by: f64| {
            let [x1, x2, v1, v2] = motion.state[..] else { panic!("four components") };
            [x1, x2 + by, v1, v2]
        };
        let found = approached(&system, beside(1e-4).into(), 2).unwrap();
        assert_eq!(found.label(), motion.label());
        assert!(
            approached(&system, beside(0.3).into(), 2).is_none_or(|other| other.label() != motion.label())
        );
        assert!(!leads_to(&system, &beside(0.05), &motion), "too far to be foretold");
    }

    #[test]
    fn an_unstable_motion_is_not_approached() {
        // The 1-1-1 symmetric motion beyond its pitchfork.
        let system = system(3.6, 0.1);
        let unstable = crate::theory::symmetric_motions(&system).unwrap()[0].motion.at_phase_zero(&system);
        assert!(approached(&system, StateVector::from_slice(&unstable).unwrap(), 1).is_none());
    }
}
