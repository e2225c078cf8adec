//! What impacts take and how long contacts hold: closed form, another way of measuring, and the twins.

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{self, Choice, Job, Unwatched, follow};
use impact_atlas::dynamics::{Event, Trajectory};
use impact_atlas::model::{Flight, Setting, State, System};
use impact_atlas::plane::Start;
use impact_atlas::system::Family;

const SCHEDULE: Schedule = Schedule { transient: 400, observe: 64, max_period: 16, fixed_periods: true };

fn job(settings: &[(&str, f64)], start: Start) -> Job {
    let setting = settings
        .iter()
        .fold(Setting::defaults(Family::paper()), |setting, (name, value)| setting.with_named(name, *value));
    let system = System::new(setting).unwrap();
    let start = start.state(&system);
    Job { system, start }
}

/// 1/(dᵀM⁻¹d) of the first stop.
fn mass(job: &Job) -> f64 {
    let plant = job.system.plant();
    let direction = &plant.stops[0].direction;
    let inverse = plant.mass.clone().try_inverse().unwrap();
    1.0 / (direction.transpose() * inverse * direction)[0]
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
        let before = trajectory.contact;
        let taken = trajectory.advance(&flight, &mut []);
        periods += u32::from(taken.event == Event::Strobe);
        if periods < SCHEDULE.transient || (periods == SCHEDULE.transient && taken.event == Event::Strobe) {
            continue;
        }
        if !before.is_free() {
            rested += taken.time;
        }
        energy += match taken.event {
            Event::Impact(impact) => impact.velocity_before.powi(2) - impact.velocity_after.powi(2),
            Event::Caught { impact, .. } => impact.velocity_before.powi(2),
            _ => 0.0,
        };
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
