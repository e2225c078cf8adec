//! Control of other plants than the paper's, and on the sections of other stops than the first.

use std::f64::consts::{PI, TAU};
use std::time::{Duration, Instant};

use impact_atlas::backend::{Backend, ControlJob, Job, Unwatched, follow_controlled};
use impact_atlas::control::methods::{Convention, DelaySetting, PulseSetting, Sign, SineSetting};
use impact_atlas::control::{
    ControlSchedule, Controlled, Controller, Outcome, Return, Scheme, SectionPoint, SectionValues, Surface,
    Target, control, multipliers,
};
use impact_atlas::dynamics::{Contact, Event, Stop, Trajectory};
use impact_atlas::model::{Flight, State, StateVector, System};
use impact_atlas::system::{Family, Plant, PlantStop, builtin};
use nalgebra::{DMatrix, DVector};

use crate::common::adapter::open;
use crate::common::drawn::row_of_four;

use super::{FIXED_POINT, Returns, TARGET, away, gpu, starts, system};

/// A family that comes with the program, at its defaults but for what is set.
fn family(name: &str, set: &[(&str, f64)]) -> System {
    let family = Family::parse(builtin(name).unwrap(), name).unwrap();
    let mut values = family.defaults();
    for (parameter, value) in set {
        values[family.parameter(parameter).unwrap().index()] = *value;
    }
    System::of_plant(family.plant(&values).unwrap()).unwrap()
}

fn run(system: &System, controller: &Controller<f64>, start: &[f64]) -> (Outcome, Vec<Return<f64>>) {
    let schedule =
        ControlSchedule { from: 300, iterates: 2300, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let mut returns = Returns::default();
    let outcome = control::<f64, _>(system, start, controller, &schedule, &mut returns).unwrap();
    (outcome, returns.0)
}

fn feedback(stop: Stop, components: usize, gain: f64) -> Scheme {
    let gains = SectionValues::from_slice(&vec![gain; components]).unwrap();
    Scheme::Delay(DelaySetting { stop, gains, delay: 1, sign: Sign::Stabilising })
}

fn pulse(stop: Stop, target: &[f64]) -> Scheme {
    let given = SectionValues::from_slice(target).unwrap().map(Some);
    // The second of the three masses meets the stops, and the second of two its stop of its own.
    let own = usize::from(target.len() == 6 || (target.len() == 4 && stop == Stop::B));
    Scheme::Pulse(PulseSetting {
        stop,
        period: 1,
        target: Target { reference: 1.0, given, own },
        noise: 0.0,
        seed: 1,
    })
}

/// The ball on the shaken table: e = 0.5 and Γ = 1.6, beyond the doubling at 1.526824. Its 1-1 motion has
/// v+ = 2πe/(1 + e), Γ cos τ = π(1 − e)/(1 + e); with S = Γ sin τ its multipliers have the sum 1 + e² − S(1 + e)² and the
/// product e².
const RESTITUTION: f64 = 0.5;
const SHAKING: f64 = 1.6;

fn bouncing() -> (System, [f64; 2], [f64; 2]) {
    let e = RESTITUTION;
    let system = family("bouncing-ball", &[("Gamma", SHAKING), ("r", e)]);
    let phase = (PI * (1.0 - e) / (1.0 + e) / SHAKING).acos();
    let (sum, product) = (1.0 + e * e - SHAKING * phase.sin() * (1.0 + e).powi(2), e * e);
    let root = (sum * sum / 4.0 - product).sqrt();
    (system, [TAU * e / (1.0 + e), phase], [sum / 2.0 - root, sum / 2.0 + root])
}

#[test]
fn feedback_holds_the_ball_beyond_its_period_doubling() {
    let (system, fixed, [largest, other]) = bouncing();
    assert!(largest < -1.0 && other > -1.0);
    let free = multipliers(&system, &Controller::None(Stop::A), &fixed).unwrap().unwrap();
    assert_eq!(free.len(), 2);
    assert!((free[0].re - largest).abs() < 1e-6 && (free[1].re - other).abs() < 1e-6, "{free:?}");
    // μ² − (λ + g) μ + g = 0 is stable from g = −(1 + λ)/2 on.
    let threshold = -(1.0 + largest) / 2.0;
    for (gain, held) in [(threshold - 0.02, false), (threshold + 0.02, true), (0.4, true)] {
        let controller = feedback(Stop::A, 2, gain).resolve(&system).unwrap();
        let computed = multipliers(&system, &controller, &fixed).unwrap().unwrap();
        assert_eq!((computed.len(), computed[0].norm() < 1.0), (4, held), "g = {gain}: {computed:?}");
    }
    // Beside the 1-1 motion at phase 0, from where it is left for the doubled one.
    let [v, tau] = fixed;
    let flown = TAU - tau;
    let y = v * flown - flown * flown / 2.0 + SHAKING * (flown * tau.cos() + tau.sin());
    let beside = [y, v - flown + SHAKING * (tau.cos() - 1.0) + 0.05];
    let controller = feedback(Stop::A, 2, 0.4).resolve(&system).unwrap();
    let (outcome, returns) = run(&system, &controller, &beside);
    assert_eq!((outcome.period, outcome.verdict.label().as_str()), (1, "1-1"), "{outcome:?}");
    assert!(!outcome.verdict.symmetric);
    assert!(away(outcome.section, fixed) < 1e-9, "{outcome:?}");
    assert!(returns.last().unwrap().signal < 1e-12, "the control does not vanish");
    let (uncontrolled, _) = run(&system, &Controller::None(Stop::A), &beside);
    assert_eq!(uncontrolled.period, 2, "{uncontrolled:?}");
    let weak = feedback(Stop::A, 2, 0.05).resolve(&system).unwrap();
    assert_eq!(run(&system, &weak, &beside).0.period, 2);
}

#[test]
fn pulses_hold_a_target_on_the_second_stop() {
    let system = family("two-sided", &[]);
    let target = [0.7, 4.0];
    let controller = pulse(Stop::B, &target).resolve(&system).unwrap();
    let (outcome, returns) = run(&system, &controller, &[0.0, 0.0]);
    assert_eq!(outcome.period, 1, "{outcome:?}");
    assert!(returns[300..].iter().all(|met| away(met.section, target) < 1e-14 && met.velocity > 0.0));
    // Each flight begins at x = −βδ: what it arrives at is the same each time, and where an own flight of it ends.
    let arrived = returns.last().unwrap().arrived;
    let flight = Flight::<f64, 1>::new(&system);
    let mut trajectory = Trajectory::at_phase(&flight, State { x: [-0.6], v: [0.7] }, 4.0);
    let mut at_stops = [0; 2];
    while at_stops[1] == 0 {
        if let Event::Impact(impact) | Event::Caught { impact, .. } =
            trajectory.advance(&flight, &mut []).event
        {
            at_stops[impact.stop.index()] += 1;
        }
    }
    assert!((trajectory.point.state.v[0] - arrived[0]).abs() < 1e-10, "{arrived:?}");
    assert_eq!(outcome.verdict.counts[..], at_stops);
    let (free, _) = run(&system, &Controller::None(Stop::B), &[0.0, 0.0]);
    assert!(away(free.section, target) > 1e-2, "{free:?}");
    // The same numbers on the section of the first stop lead into it.
    let refused = pulse(Stop::A, &target).resolve(&system).unwrap_err().to_string();
    assert!(refused.contains("v1+ = 0.7"), "{refused}");
}

#[test]
fn the_papers_other_stop_has_the_mirror_image() {
    let system = system();
    let [v1, x2, v2, tau] = FIXED_POINT;
    let image = [-v1, -x2, -v2, tau + PI];
    let at_b = |controller: &Controller<f64>| {
        starts(6).map(|start| run(&system, controller, &start).0).collect::<Vec<_>>()
    };
    let held = at_b(&feedback(Stop::B, 4, 0.4).resolve(&system).unwrap());
    let there = |outcome: &&Outcome| outcome.period == 1 && away(outcome.section, image) < 1e-7;
    let captured: Vec<_> = held.iter().filter(there).collect();
    assert!(!captured.is_empty(), "{held:?}");
    for outcome in captured {
        assert_eq!(outcome.verdict.label(), "1-1-2");
    }
    assert_eq!(at_b(&Controller::None(Stop::B)).iter().filter(there).count(), 0);
    let [here, there] = [(Stop::A, FIXED_POINT), (Stop::B, image)]
        .map(|(stop, point)| multipliers(&system, &Controller::None(stop), &point).unwrap().unwrap());
    for (a, b) in here.iter().zip(&there) {
        assert!((a - b).norm() < 1e-5, "{here:?} {there:?}");
    }
    // So does the target, the 1-1-1 motion of the reference frequency.
    let target = |stop| TARGET.resolve(&system, stop, &[0, 1, 2, 3]).unwrap();
    let [v1, x2, v2, tau] = std::array::from_fn(|i| target(Stop::A)[i]);
    assert!(away(target(Stop::B), [-v1, -x2, -v2, tau + PI]) < 1e-12);
}

/// The chain of three masses, its middle one between stops: what control sees at stop A is what the motion does there.
#[test]
fn three_masses_are_followed_without_control() {
    let system = family("three-mass-chain", &[]);
    let flight = Flight::<f64, 3>::new(&system);
    let start = [0.1, 0.0, -0.2, 0.0, 0.3, 0.0];
    let (outcome, returns) = run(&system, &Controller::None(Stop::A), &start);
    assert_eq!(returns.len(), 2300, "{outcome:?}");
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&start));
    let (mut seen, mut at_b) = (0, 0);
    while seen < 20 {
        let event = trajectory.advance(&flight, &mut []).event;
        let (Event::Impact(impact) | Event::Caught { impact, .. }) = event else { continue };
        if impact.stop == Stop::B {
            at_b += 1;
            continue;
        }
        let State { x, v } = trajectory.point.state;
        let tau = (f64::from(trajectory.step) * flight.h + trajectory.offset) * flight.omega;
        let met = &returns[seen];
        assert!(away(met.section, [v[1], x[0], x[2], v[0], v[2], tau]) < 1e-10, "{met:?}");
        assert_eq!((met.impacts, met.section), ([1, at_b, 0, 0], met.arrived));
        (seen, at_b) = (seen + 1, 0);
    }
    // A pulse moves all but the coordinate on the stop: the uncontrolled motion is elsewhere.
    let last: Vec<f64> = returns.last().unwrap().section.to_vec();
    let mut target = last.clone();
    target[1] += 0.05;
    let controller = pulse(Stop::A, &target).resolve(&system).unwrap();
    let (held, moved) = run(&system, &controller, &start);
    assert!(moved[300..].iter().all(|met| away(met.section, &target) < 1e-14));
    assert!(held.period == 1 && away(&last, &target) > 1e-2);
}

#[test]
fn masses_that_hit_each_other_are_put_back_in_touch() {
    let system = family("colliding-pair", &[]);
    let plant = system.plant();
    let stop = Stop::A;
    let controller = Controller::None(stop);
    let (_, free) = run(&system, &controller, &[0.0; 4]);
    let mut target: Vec<f64> = free.last().unwrap().section.to_vec();
    target[1] += 0.02;
    let controller = pulse(stop, &target).resolve(&system).unwrap();
    let (outcome, returns) = run(&system, &controller, &[0.0; 4]);
    assert!(returns[300..].iter().all(|met| away(met.section, &target) < 1e-14), "{outcome:?}");
    let flight = Flight::<f64, 2>::new(&system);
    let surface = Surface::new(&system, &flight, stop);
    let placed =
        SectionPoint::<f64, 2>::new(&target).trajectory(&flight, &surface, Contact::FREE).point.state;
    let along: f64 = plant.stops[0].direction.iter().zip(&placed.x).map(|(d, x)| d * x).sum();
    assert!((along - plant.stops[0].gap).abs() < 1e-15, "{along}");
    assert!(away(free.last().unwrap().section, &target) > 1e-2);
}

/// Two masses, each with a stop of its own.
fn apart() -> System {
    let stop = |direction: [f64; 2], gap| PlantStop {
        direction: DVector::from_row_slice(&direction),
        gap,
        restitution: 0.8,
    };
    System::of_plant(Plant {
        n: 2,
        mass: DMatrix::identity(2, 2),
        damping: DMatrix::from_row_slice(2, 2, &[0.2, -0.1, -0.1, 0.2]),
        stiffness: DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]),
        force_sin: DVector::from_row_slice(&[1.0, 0.0]),
        force_cos: DVector::zeros(2),
        load: DVector::zeros(2),
        omega: 1.1,
        stops: vec![stop([1.0, 0.0], 0.2), stop([0.0, 1.0], 0.4)],
    })
    .unwrap()
}

#[test]
fn a_correction_beyond_another_stop_is_left_out() {
    for (x2, escapes) in [(0.3, 0), (0.5, 2000)] {
        let controller = pulse(Stop::A, &[-0.4, x2, 0.1, 1.0]).resolve(&apart()).unwrap();
        let (outcome, returns) = run(&apart(), &controller, &[0.0; 4]);
        assert_eq!(outcome.escapes, escapes, "x2 = {x2}: {outcome:?}");
        assert!(returns[300..].iter().all(|met| met.escaped == (escapes > 0)));
    }
}

/// Forty returns.
const FORTY: ControlSchedule =
    ControlSchedule { from: 0, iterates: 40, fixed: true, max_period: ControlSchedule::MAX_PERIOD };

/// A force −0.3 sin φ on one of n coordinates.
fn in_phase(coordinate: usize, n: usize) -> Scheme {
    let mut given = SectionValues::from_slice(&vec![0.0; 2 * n]).unwrap().map(|_: f64| None);
    given[0] = Some(-0.1);
    Scheme::Sine(SineSetting {
        stop: Stop::A,
        convention: Convention::Force,
        coordinate,
        amplitude: -0.3,
        alpha: 0.0,
        dead_band: 0.0,
        gamma: 1.0,
        phase: 0.0,
        component: 0,
        target: Target { reference: 1.0, given, own: 0 },
    })
}

/// The returns to the first stop from a point there, under a controller whose force acts from the beginning.
fn returns<const N: usize, const M: usize>(
    system: &System,
    controller: Controller<f64>,
    start: &[f64],
) -> Vec<Return<f64>> {
    let flight = Flight::<f64, M>::new(&controller.flown(system).unwrap());
    let surface = Surface::new(system, &flight, Stop::A);
    let begun = SectionPoint::<f64, N>::new(start).trajectory(&flight, &surface, Contact::FREE);
    let mut controlled = Controlled::<f64, N, M>::new(begun, surface, controller, &FORTY);
    controlled.force(&flight);
    let mut returns = Returns::default();
    controlled.follow(&flight, &FORTY, &mut returns);
    returns.0
}

#[test]
fn a_force_on_the_second_mass_is_a_change_of_its_forcing() {
    let (system, start) = (apart(), [-0.4, 0.1, 0.1, 1.0]);
    let changed = system.clone().loaded(&[1.0, -0.3]);
    let expected = returns::<2, 2>(&changed, Controller::None(Stop::A), &start);
    let forced =
        |coordinate| returns::<2, 3>(&system, in_phase(coordinate, 2).resolve(&system).unwrap(), &start);
    for (a, b) in forced(1).iter().zip(&expected).take(8) {
        assert!(away(a.section, b.section) < 1e-9, "{a:?} {b:?}");
    }
    assert!(away(forced(0)[0].section, expected[0].section) > 1e-3, "the coordinate makes no difference");
    assert!(in_phase(2, 2).resolve(&system).unwrap_err().to_string().contains("no coordinate 2"));
}

#[test]
fn a_force_on_the_last_of_four_masses_is_a_change_of_its_forcing() {
    let stop =
        PlantStop { direction: DVector::from_row_slice(&[1.0, 0.0, 0.0, 0.0]), gap: 0.2, restitution: 0.8 };
    let system = System::of_plant(row_of_four(1.1, vec![stop])).unwrap();
    let start = [-0.4, 0.1, 0.1, 0.0, 0.0, 0.1, -0.1, 1.0];
    let changed = system.clone().loaded(&[1.0, 0.0, 0.0, -0.3]);
    let expected = returns::<4, 4>(&changed, Controller::None(Stop::A), &start);
    let forced = returns::<4, 5>(&system, in_phase(3, 4).resolve(&system).unwrap(), &start);
    assert_eq!(forced.len(), 40);
    for (a, b) in forced.iter().zip(&expected).take(8) {
        assert!(away(a.section, b.section) < 1e-9, "{a:?} {b:?}");
    }
    let unforced = returns::<4, 4>(&system, Controller::None(Stop::A), &start);
    assert!(away(unforced[1].section, expected[1].section) > 1e-3, "the force makes no difference");
}

#[test]
fn settings_that_do_not_fit_the_system_are_refused() {
    let refused = |scheme: Scheme, system: &System| scheme.resolve(system).unwrap_err().to_string();
    let (ball, chain) = (bouncing().0, family("three-mass-chain", &[]));
    assert!(refused(feedback(Stop::A, 4, 0.3), &ball).contains("gains: 4 numbers"));
    assert!(refused(feedback(Stop::B, 2, 0.3), &ball).contains("no stop 1"));
    assert!(refused(pulse(Stop::A, &[0.1; 4]), &chain).contains("v2+, x1, x3, v1, v3, tau"));
    let reference =
        Scheme::Pulse(PulseSetting { stop: Stop::A, period: 1, target: TARGET, noise: 0.0, seed: 1 });
    assert!(refused(reference, &ball).contains("give the target itself, v1+, tau"));
}

fn job(system: &System, start: &[f64], scheme: Scheme) -> ControlJob {
    ControlJob {
        job: Job { system: system.clone(), start: StateVector::from_slice(start).unwrap() },
        controller: scheme.resolve(system).unwrap(),
    }
}

/// Control that settles, on plants of all sorts, at any of their stops.
fn settling() -> Vec<(&'static str, ControlJob)> {
    let (ball, [v, tau], _) = bouncing();
    let flown = TAU - tau;
    let y = v * flown - flown * flown / 2.0 + SHAKING * (flown * tau.cos() + tau.sin());
    let beside = [y, v - flown + SHAKING * (tau.cos() - 1.0) + 0.05];
    let two_sided = family("two-sided", &[]);
    let chain = family("three-mass-chain", &[]);
    let pair = family("colliding-pair", &[]);
    let force = |coordinate, amplitude, component, components: usize| {
        let given = SectionValues::from_slice(&vec![Some(0.0); components]).unwrap();
        Scheme::Sine(SineSetting {
            stop: Stop::A,
            convention: Convention::Force,
            coordinate,
            amplitude,
            alpha: 0.0,
            dead_band: 0.0,
            gamma: 1.0,
            phase: 0.0,
            component,
            target: Target { reference: 1.0, given, own: usize::from(components == 6) },
        })
    };
    let rested = |n: usize| vec![0.0; 2 * n];
    vec![
        ("feedback on the ball", job(&ball, &beside, feedback(Stop::A, 2, 0.4))),
        ("a pulse on the second stop", job(&two_sided, &rested(1), pulse(Stop::B, &[0.7, 4.0]))),
        (
            "pulses on the chain",
            job(&chain, &rested(3), pulse(Stop::A, &[-0.2, 0.05, -0.02, 0.1, 0.05, 2.0])),
        ),
        ("a force on the third mass", job(&chain, &rested(3), force(2, 0.2, 5, 6))),
        ("a force on the struck mass", job(&pair, &rested(2), force(1, 0.15, 0, 4))),
    ]
}

/// Control of masses that have a stop each.
fn on_stops_apart() -> Vec<(&'static str, ControlJob)> {
    vec![
        ("a pulse on a stop of its own", job(&apart(), &[0.0; 4], pulse(Stop::B, &[-0.3, 0.05, 0.1, 2.5]))),
        ("escapes", job(&apart(), &[0.0; 4], pulse(Stop::A, &[-0.4, 0.5, 0.1, 1.0]))),
    ]
}

/// What a dispatch is asked for is different each time: a software adapter that took it for a part of the kernel would compile it
/// anew. Hardware has a uniform for it, and its driver may have the kernel from before, so that the first says nothing.
#[test]
fn a_kernel_is_compiled_once_whatever_its_dispatches_are_asked_for() {
    let device = open();
    if !device.is_software() {
        return;
    }
    let (_, ball) = settling().swap_remove(0);
    let taken = |count| {
        let jobs = vec![ball.clone(); count];
        let begun = Instant::now();
        let outcomes = device.control(&jobs, &SETTLING, &Unwatched).unwrap();
        assert!(outcomes.len() == count && outcomes.iter().all(|outcome| outcome.period == 1));
        begun.elapsed()
    };
    let first = taken(1);
    let later: Duration = (2..10).map(taken).sum();
    println!("{first:?} with the compiler, {later:?} for eight without");
    assert!(later < first, "{later:?} where the first took {first:?}");
}

#[test]
fn the_gpu_controls_masses_on_stops_apart_as_the_cpu_does() {
    controlled_alike(on_stops_apart());
}

#[test]
fn the_gpu_controls_any_plant_at_any_stop_as_the_cpu_does() {
    controlled_alike(settling());
}

pub const SETTLING: ControlSchedule =
    ControlSchedule { from: 20, iterates: 300, fixed: true, max_period: ControlSchedule::MAX_PERIOD };

/// Holds the GPU to the CPU; both to control making a difference.
fn controlled_alike(jobs: Vec<(&str, ControlJob)>) {
    let mut periodic = 0;
    let count = jobs.len();
    for (name, job) in jobs {
        let [ours, theirs] = [
            follow_controlled::<f64>(&job, &SETTLING).unwrap(),
            gpu().control(std::slice::from_ref(&job), &SETTLING, &Unwatched).unwrap()[0],
        ];
        let context = format!("{name}: {ours:?} {theirs:?}");
        assert_eq!((ours.verdict.label(), ours.period), (theirs.verdict.label(), theirs.period), "{context}");
        assert_eq!((ours.escapes, ours.iterates), (theirs.escapes, theirs.iterates), "{context}");
        assert!((ours.effort - theirs.effort).abs() <= 1e-3 * (1.0 + ours.effort.abs()), "{context}");
        if ours.period > 0 {
            assert!(away(ours.section, theirs.section) < 2e-4, "{context}");
            periodic += 1;
        }
        // What another controller does on the same plant is something else.
        let other = ControlJob { controller: Controller::None(job.controller.stop()), ..job };
        let free = follow_controlled::<f64>(&other, &SETTLING).unwrap();
        let differs = free.verdict.label() != ours.verdict.label()
            || away(free.section, ours.section) > 1e-3
            || free.escapes != ours.escapes;
        assert!(differs, "{name}: control makes no difference");
    }
    assert!(periodic + 1 >= count, "{periodic} of {count} are periodic");
}
