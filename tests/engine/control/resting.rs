//! Control of masses that rest: in corners, for ever, and on several stops at once.

use impact_atlas::analysis::{INFINITELY_MANY, Regime, Schedule};
use impact_atlas::backend::{Backend, ControlJob, Cpu, Job, Unwatched, decide, follow_controlled};
use impact_atlas::control::{Controller, History, control};
use impact_atlas::dynamics::{Stop, record};
use impact_atlas::model::{StateVector, System};
use impact_atlas::system::{Family, Setting};
use impact_atlas::theory::Spectrum;
use nalgebra::{DMatrix, DVector};

use super::gpu;
use super::plants::SETTLING;
use crate::general::subject::{masses, stop};

/// A mass in the plane that a force presses into the corner of a wedge for half of every period, and pulls off.
fn wedge() -> System {
    let mut plant = masses(&[1.0, 1.0], 1.0);
    plant.stiffness = DMatrix::identity(2, 2) * 0.3;
    plant.damping = DMatrix::identity(2, 2) * 0.3;
    plant.force_sin = DVector::from_row_slice(&[0.3, 1.0]);
    plant.load = DVector::from_row_slice(&[0.15, 0.5]);
    plant.stops = vec![stop(&[1.0, 0.0], 0.0, 0.01), stop(&[-0.1, 1.0], 0.0, 0.01)];
    System::of_plant(plant).unwrap()
}

#[test]
fn chatter_in_a_corner_counts_at_both_of_its_stops() {
    let (system, start) = (wedge(), StateVector::zeros(2));
    let schedule = Schedule { transient: 100, observe: 50, max_period: 8, fixed_periods: false };
    let job = Job { system: system.clone(), start };
    let verdict = decide(&Cpu, std::slice::from_ref(&job), &schedule, &Unwatched).unwrap().remove(0);
    assert_eq!(verdict.label(), "1-∞-∞", "{verdict:?}");
    let controlled = ControlJob { job, controller: Controller::None(Stop::A) };
    let found = follow_controlled::<f64>(&controlled, &SETTLING).unwrap();
    assert_eq!(found.verdict.counts, verdict.counts, "{found:?}");
    let spectrum = Spectrum::of(&system, start, 100, 32).unwrap();
    assert_eq!([0, 1].map(|stop| spectrum.returns(Stop(stop))), [None, None]);
    assert_eq!(u32::from(INFINITELY_MANY), u32::from(verdict.counts[0]));
}

/// A ball on a table that shakes less than gravity pulls comes to rest on it: it never returns, and it is not off it.
#[test]
fn a_mass_at_rest_for_ever_is_not_without_impact() {
    let at = |name: &str, parameter: &str, value: f64, start: &[f64]| {
        let setting = Setting::defaults(Family::builtin(name)).with_named(parameter, value);
        let job =
            Job { system: System::new(setting).unwrap(), start: StateVector::from_slice(start).unwrap() };
        let controlled = ControlJob { job, controller: Controller::None(Stop::A) };
        let own = follow_controlled::<f64>(&controlled, &SETTLING).unwrap();
        let theirs = gpu().control(&[controlled], &SETTLING, &Unwatched).unwrap()[0];
        [own, theirs].map(|outcome| outcome.verdict.regime)
    };
    assert_eq!(at("bouncing-ball", "Gamma", 0.5, &[0.3, 0.0]), [Regime::Unresolved; 2]);
    assert_eq!(at("two-sided", "delta", 50.0, &[0.1, 0.0]), [Regime::NoImpact; 2]);
}

/// What is recorded of rests under control is what is recorded without.
#[test]
fn rests_on_two_stops_at_once_are_recorded_each() {
    let (system, start) = (wedge(), [0.0; 4]);
    let (from, periods) = (4, 12);
    let mut history = History::new(from, 1.0);
    control::<f64, _>(&system, &start, &Controller::None(Stop::A), &SETTLING, &mut history).unwrap();
    let begins = history.returns[from as usize].section;
    let free = record(&system, start, 0, periods, 0);
    // Times of one count from a return, of the other from the start.
    let first = free.impacts.iter().filter(|impact| impact.stop == Stop::A).nth(from as usize).unwrap();
    assert!((first.state[2] - begins[0]).abs() < 1e-9, "{first:?} is where the history begins, {begins:?}");
    let of = |stop: u8| {
        let lasts =
            move |sticks: &[impact_atlas::dynamics::Stick], after: f64, until: f64| -> Vec<[f64; 2]> {
                let on = sticks.iter().filter(|stick| stick.stop == Stop(stop));
                on.map(|stick| [stick.from - after, stick.until - after])
                    .filter(|[begins, ends]| *begins > 0.0 && *ends < until)
                    .collect()
            };
        let until = system.period() * f64::from(periods) - first.time - 1e-6;
        [lasts(&history.recording.sticks, 0.0, until), lasts(&free.sticks, first.time, until)]
    };
    for stop in [0, 1] {
        let [controlled, free] = of(stop);
        assert!(free.len() > 3, "{free:?}");
        assert_eq!(controlled.len(), free.len(), "{controlled:?} {free:?}");
        for (a, b) in controlled.iter().zip(&free) {
            assert!((a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6, "{a:?} {b:?}");
        }
    }
}
