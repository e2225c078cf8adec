//! What impacts take and how long contacts hold: closed form, another way of measuring, and the twins.

use std::f64::consts::TAU;

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{self, Choice, Cpu, Job, Unwatched, follow};
use impact_atlas::dynamics::{Event, Trajectory};
use impact_atlas::model::{Flight, Setting, State, StateVector, System};
use impact_atlas::plane::{Axis, Plane, Start};
use impact_atlas::sweep::{certify, sweep};
use impact_atlas::system::{Family, Plant, PlantStop};
use nalgebra::{DMatrix, DVector};

const SCHEDULE: Schedule = Schedule { transient: 400, observe: 64, max_period: 16, fixed_periods: true };

fn job(settings: &[(&str, f64)], start: Start) -> Job {
    let setting = settings
        .iter()
        .fold(Setting::defaults(Family::paper()), |setting, (name, value)| setting.with_named(name, *value));
    let system = System::new(setting).unwrap();
    let start = start.state(&system);
    Job { system, start }
}

/// 1/(dᵀM⁻¹d) of a stop.
fn mass_at(job: &Job, stop: usize) -> f64 {
    let plant = job.system.plant();
    let direction = &plant.stops[stop].direction;
    let inverse = plant.mass.clone().try_inverse().unwrap();
    1.0 / (direction.transpose() * inverse * direction)[0]
}

/// The same of the first stop.
fn mass(job: &Job) -> f64 {
    mass_at(job, 0)
}

/// (d·v−)² − (d·v+)² of an impact, (d·v−)² of one that ends at rest.
fn squares_lost(event: &Event<f64>) -> f64 {
    match event {
        Event::Impact(impact) => impact.velocity_before.powi(2) - impact.velocity_after.powi(2),
        Event::Caught { impact, .. } => impact.velocity_before.powi(2),
        _ => 0.0,
    }
}

/// The power of a 1-1-1 symmetric motion: two equal impacts in each forcing period.
fn closed_form(job: &Job, verdict: &Verdict, r: f64) -> f64 {
    let speed = f64::from(verdict.peak_impact_velocity);
    (1.0 - r * r) * mass(job) * speed * speed / job.system.period()
}

#[test]
fn the_power_of_the_symmetric_motion_is_that_of_its_two_impacts() {
    for r in [0.8, 0.5, 1.0] {
        let job = job(&[("omega", 4.2), ("r", r), ("mu_m", 0.4)], Start::Symmetric);
        let verdict = follow::<f64>(&job, &SCHEDULE);
        let power = f64::from(verdict.measures.power);
        if r < 1.0 {
            assert_eq!((verdict.regime, verdict.label().as_str()), (Regime::Periodic, "1-1-1"), "r = {r}");
            let expected = closed_form(&job, &verdict, r);
            assert!((power - expected).abs() < 1e-5 * expected, "r = {r}: {power} and {expected}");
            // Another mass would be noticed.
            assert!((power - expected / mass(&job)).abs() > 1e-2 * expected || mass(&job) == 1.0);
            assert_eq!(verdict.measures.contact, 0.0);
        } else {
            assert!(verdict.impacts > 0 && power.abs() < 1e-12, "an elastic impact takes nothing: {power}");
        }
    }
}

/// Power and share of time in contact from every move of the trajectory.
fn measured(job: &Job) -> [f64; 2] {
    let flight = Flight::<f64, 2>::new(&job.system);
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&job.start));
    let (mut energy, mut rested, mut periods) = (0.0, 0.0, 0);
    while periods < SCHEDULE.transient + SCHEDULE.observe {
        let taken = trajectory.advance(&flight, &mut []);
        periods += u32::from(taken.event == Event::Strobe);
        if periods < SCHEDULE.transient || (periods == SCHEDULE.transient && taken.event == Event::Strobe) {
            continue;
        }
        if !taken.contact.is_free() {
            rested += taken.time;
        }
        if let Event::Caught { rebounds, .. } = taken.event {
            rested -= rebounds;
        }
        energy += squares_lost(&taken.event);
    }
    let time = f64::from(SCHEDULE.observe) * job.system.period();
    [0.5 * mass(job) * energy / time, rested / time]
}

#[test]
fn what_is_noted_of_events_is_what_every_move_adds_up_to() {
    let sticking = [("omega", 0.25), ("delta", 0.545)];
    let chaotic = [("omega", 2.83), ("delta", 0.1)];
    for (settings, sticks) in [(&sticking[..], true), (&chaotic[..], false)] {
        let job = job(settings, Start::Rest);
        let verdict = follow::<f64>(&job, &SCHEDULE);
        let [power, contact] = measured(&job);
        let measures = verdict.measures;
        assert!((f64::from(measures.power) - power).abs() < 1e-6 * power, "{measures:?}, {power}");
        assert!((f64::from(measures.contact) - contact).abs() < 1e-6, "{measures:?}, {contact}");
        assert_eq!(measures.contact > 0.05, sticks, "{measures:?}");
    }
}

/// A mass on a shaking floor: y'' = F sin t − 1 above it, and rebounds with r.
fn on_a_floor(force: f64, r: f64) -> System {
    let one = DMatrix::from_element(1, 1, 1.0);
    let vector = |value: f64| DVector::from_element(1, value);
    System::of_plant(Plant {
        n: 1,
        damping: &one * 0.0,
        stiffness: &one * 0.0,
        mass: one,
        force_sin: vector(force),
        force_cos: vector(0.0),
        load: vector(-1.0),
        omega: 1.0,
        stops: vec![PlantStop { direction: vector(-1.0), gap: 0.0, restitution: r }],
    })
    .unwrap()
}

/// The share of the time for which that mass rests, from its flights in closed form: it parts where F sin t = 1, and rebounds until
/// it rests again.
fn resting_on_a_floor(force: f64, r: f64) -> f64 {
    let parts = (1.0 / force).asin();
    let (mut at, mut speed) = (parts, 0.0);
    loop {
        let fall = |s: f64| {
            let (begun, now) = (at, at + s);
            let height = (speed + force * begun.cos()) * s - force * (now.sin() - begun.sin()) - 0.5 * s * s;
            (height, speed - force * (now.cos() - begun.cos()) - s)
        };
        // Past the only zero after the beginning: rebounds are short, the first flight is shorter than a turn.
        let pull = 1.0 - force * at.sin();
        let mut below = if speed > 0.0 { 0.5 * speed / pull.max(0.05) } else { 0.1 };
        while fall(below).0 <= 0.0 {
            below *= 0.5;
        }
        let mut above = below;
        while fall(above).0 > 0.0 {
            above *= 1.1;
        }
        for _ in 0..80 {
            let middle = 0.5 * (below + above);
            if fall(middle).0 > 0.0 { below = middle } else { above = middle }
        }
        (at, speed) = (at + above, -r * fall(above).1);
        if speed < 1e-9 {
            return 1.0 - (at - parts) / TAU;
        }
    }
}

#[test]
fn contact_begins_after_the_last_rebound_and_ends_where_it_opens() {
    let (mut farthest, mut compared) = (0.0f64, 0);
    for r in [0.0, 0.05, 0.3, 0.5] {
        for force in [1.05, 1.1, 1.2, 1.4, 1.45, 1.6] {
            let system = on_a_floor(force, r);
            let job = Job { system, start: StateVector::from_slice(&[0.0; 2]).unwrap() };
            let expected = resting_on_a_floor(force, r);
            if force * (TAU * (1.0 - expected) + (1.0 / force).asin()).sin() > 0.9 {
                // It parts again before it has come to rest for good.
                continue;
            }
            for verdict in [follow::<f64>(&job, &SCHEDULE), follow::<f32>(&job, &SCHEDULE)] {
                assert_eq!(verdict.regime, Regime::PeriodicSticking, "F = {force}, r = {r}");
                let away = (f64::from(verdict.measures.contact) - expected).abs();
                assert!(away < 1e-4, "F = {force}, r = {r}: {} for {expected}", verdict.measures.contact);
                farthest = farthest.max(away);
                compared += 1;
            }
        }
    }
    assert!(compared >= 30, "{compared} were compared");
    println!("at most {farthest:.1e} of the period off");
}

#[test]
fn both_back_ends_measure_the_same() {
    let jobs: Vec<Job> = [(4.2, 0.1), (0.25, 0.545), (3.7, 0.3), (1.65, 0.2), (2.0, 5.0)]
        .map(|(omega, delta)| job(&[("omega", omega), ("delta", delta)], Start::Symmetric))
        .into();
    let Ok(gpu) = backend::open(Choice::Gpu, None) else { panic!("these tests need an adapter") };
    let theirs = gpu.run(&jobs, &SCHEDULE, &Unwatched).unwrap();
    let mut periodic = 0;
    for (job, theirs) in jobs.iter().zip(&theirs) {
        let twin = follow::<f32>(job, &SCHEDULE);
        let reference = follow::<f64>(job, &SCHEDULE);
        for other in [&twin, &reference] {
            assert_eq!(theirs.label(), other.label());
            let (a, b) = (theirs.measures, other.measures);
            assert_eq!(a.observed, b.observed);
            if !theirs.regime.is_periodic() {
                // What does not repeat is measured on another stretch of it.
                assert!((a.power - b.power).abs() <= 0.05 * a.power, "{a:?} and {b:?}");
                continue;
            }
            periodic += 1;
            let power = (a.power - b.power).abs() <= 2e-3 * a.power.abs() + 1e-6;
            // Rebounds are closed, and counted as contact from there on, as soon as rounding hides them: earlier in f32.
            let contact = (a.contact - b.contact).abs() <= 5e-3;
            assert!(power && contact, "{a:?} and {b:?}");
        }
    }
    assert!(periodic >= 4, "too few cells were held against each other");
}

/// What is measured of a periodic motion is the mean over whole turns of it, however late it was reached.
#[test]
fn periodic_motions_are_measured_over_whole_turns() {
    let family = Family::builtin("shaw-holmes");
    let axes = family.plane.as_ref().unwrap();
    let axis = |text: &str, count: u32| {
        let (ends, _) = text.rsplit_once(':').unwrap();
        Axis::of_family(&format!("{ends}:{count}"), family).unwrap()
    };
    let task = Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false };
    let plane = Plane {
        x: axis(&axes.x, 80),
        y: axis(&axes.y, 60),
        parameters: Setting::defaults(family),
        start: Start::Rest,
        task,
    };
    let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let mut exact = map.clone();
    certify(&mut exact, &Cpu, &Unwatched).unwrap();
    let (mut compared, mut many) = (0, 0);
    let pairs = map.verdicts.iter().zip(&exact.verdicts);
    for (verdict, exact) in pairs.filter(|(verdict, _)| verdict.regime == Regime::Periodic) {
        let turns = f64::from(verdict.measures.observed) / f64::from(verdict.n);
        let in_a_turn: u32 = verdict.counts.iter().map(|&count| u32::from(count)).sum();
        assert_eq!(f64::from(verdict.impacts), (turns * f64::from(in_a_turn)).round(), "{verdict:?}");
        assert_eq!(verdict.impacts_per_period(), in_a_turn as f32 / f32::from(verdict.n));
        if verdict.label() == exact.label() {
            let [power, expected] = [verdict, exact].map(|verdict| verdict.measures.power);
            assert!((power - expected).abs() <= 1e-3 * expected, "{power} for {expected}: {verdict:?}");
        }
        compared += 1;
        many += u32::from(verdict.n > 6);
    }
    assert!(compared > 2000 && many > 10, "{compared} motions, {many} of long periods");
}

/// Two masses on springs without dampers or forces, the first of which has no room to move; the second strikes it, and rests on it in
/// the end.
fn beside_a_clamp(r: f64) -> System {
    let vector = |values: [f64; 2]| DVector::from_row_slice(&values);
    let stop = |direction, gap| PlantStop { direction: vector(direction), gap, restitution: r };
    System::of_plant(Plant {
        n: 2,
        mass: DMatrix::from_row_slice(2, 2, &[1.0, 0.1, 0.1, 0.7]),
        damping: DMatrix::zeros(2, 2),
        stiffness: DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]),
        force_sin: vector([0.0; 2]),
        force_cos: vector([0.0; 2]),
        load: vector([0.0, -0.3]),
        omega: 1.0,
        stops: vec![stop([1.0, 0.0], 0.0), stop([-1.0, 0.0], 0.0), stop([1.0, -1.0], 0.05)],
    })
    .unwrap()
}

/// ½ vᵀMv + ½ xᵀKx − gᵀx.
fn energy(system: &System, state: &[f64]) -> f64 {
    let plant = system.plant();
    let [x, v] = [&state[..2], &state[2..]].map(DVector::from_row_slice);
    0.5 * (v.dot(&(&plant.mass * &v)) + x.dot(&(&plant.stiffness * &x))) - plant.load.dot(&x)
}

#[test]
fn what_impacts_and_clamps_take_is_what_is_missing() {
    let Ok(gpu) = backend::open(Choice::Gpu, None) else { panic!("these tests need an adapter") };
    let schedule = Schedule { transient: 0, observe: 9, max_period: 4, fixed_periods: true };
    let jobs: Vec<Job> = [0.9, 0.6, 0.2, 0.0]
        .map(|r| Job { system: beside_a_clamp(r), start: [0.0, 0.2, 0.0, 0.5].into() })
        .into();
    let on_gpu = gpu.run(&jobs, &schedule, &Unwatched).unwrap();
    for (job, on_gpu) in jobs.iter().zip(on_gpu) {
        let time = f64::from(schedule.observe) * job.system.period();
        let r = job.system.plant().stops[0].restitution;
        let of_cpu = [follow::<f64>(job, &schedule), follow::<f32>(job, &schedule)];
        for (verdict, within) in of_cpu.into_iter().chain([on_gpu]).zip([1e-6, 1e-4, 1e-4]) {
            let missing = energy(&job.system, &job.start) - energy(&job.system, &verdict.state);
            let taken = f64::from(verdict.measures.power) * time;
            assert!(
                missing > 0.05 && verdict.impacts >= if r > 0.0 { 3 } else { 1 },
                "r = {r}: {missing} is missing, {verdict:?}"
            );
            assert!((taken - missing).abs() < within * missing, "r = {r}: {taken} of {missing}");
        }
        let alone = taken_by_impacts(job, schedule.observe);
        let missing = energy(&job.system, &job.start) - energy(&job.system, &on_gpu.state);
        assert!(alone < 0.95 * missing, "r = {r}: of {missing} impacts take {alone}, clamps hardly anything");
    }
}

/// What the impacts at the last stop take by themselves.
fn taken_by_impacts(job: &Job, periods: u32) -> f64 {
    let flight = Flight::<f64, 2>::new(&job.system);
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&job.start));
    let (mut energy, mut over) = (0.0, 0);
    while over < periods {
        let taken = trajectory.advance(&flight, &mut []);
        over += u32::from(taken.event == Event::Strobe);
        energy += squares_lost(&taken.event);
    }
    0.5 * mass_at(job, 2) * energy
}
