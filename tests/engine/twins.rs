//! The GPU with exact arithmetic and its twin on the CPU, bit for bit: labels, exponents, states, layers, sections, control.

use std::collections::HashMap;
use std::sync::LazyLock;

use impact_atlas::analysis::{Probe, Reading, Regime, Schedule, Section, Verdict};
use impact_atlas::backend::{
    Backend, BackendError, ControlJob, Cpu, CpuSingle, Gpu, Job, Unwatched, extents, follow,
};
use impact_atlas::control::{ControlSchedule, Controller};
use impact_atlas::dynamics::{Event, Stop, Trajectory};
use impact_atlas::model::{Flight, State};
use impact_atlas::validate::are_same;

use crate::common::adapter::{gpu, on_devices, open_exact};
use crate::common::drawn::{families, paper};

const SHORT: Schedule = Schedule { transient: 1, observe: 4, max_period: 2, fixed_periods: true };
const LOOK: Schedule = Schedule { transient: 100, observe: 48, max_period: 16, fixed_periods: false };
const CONTROL: ControlSchedule = ControlSchedule { from: 0, iterates: 20, fixed: true, max_period: 2 };
/// Long enough for chaos to be plain after half the observation.
const LONG: Schedule = Schedule { transient: 50, observe: 140, max_period: 16, fixed_periods: false };

/// The adapter with exact arithmetic, opened once.
fn exact() -> &'static Gpu {
    static GPU: LazyLock<Gpu> = LazyLock::new(open_exact);
    &GPU
}

/// How many verdicts of a back end are not those of the twin, bit for bit.
fn differ(backend: &dyn Backend, jobs: &[Job], schedule: &Schedule) -> usize {
    let there = backend.run(jobs, schedule, &Unwatched).unwrap();
    let here = CpuSingle.run(jobs, schedule, &Unwatched).unwrap();
    assert_eq!(there.len(), jobs.len());
    there.iter().zip(&here).filter(|(there, here)| !are_same(there, here)).count()
}

#[test]
fn verdicts_have_the_bits_of_the_twin_in_every_regime() {
    let jobs = paper(2000);
    for schedule in [SHORT, LOOK] {
        assert_eq!(differ(exact(), &jobs, &schedule), 0, "{schedule:?}");
    }
    let met = CpuSingle.run(&jobs, &LOOK, &Unwatched).unwrap();
    let met = |regime| met.iter().filter(|verdict| verdict.regime == regime).count();
    for regime in [
        Regime::Periodic,
        Regime::PeriodicSticking,
        Regime::QuasiPeriodic,
        Regime::Chaotic,
        Regime::NoImpact,
        Regime::AperiodicSticking,
        Regime::Unresolved,
    ] {
        println!("{regime:?}: {}", met(regime));
    }
    for regime in [Regime::Periodic, Regime::PeriodicSticking, Regime::Chaotic, Regime::NoImpact] {
        assert!(met(regime) > 20, "{regime:?}: {}", met(regime));
    }
}

#[test]
fn chaos_that_is_plain_is_observed_half_as_long_by_both() {
    let jobs = paper(300);
    assert_eq!(differ(exact(), &jobs, &LONG), 0);
    let run = |schedule: Schedule| CpuSingle.run(&jobs, &schedule, &Unwatched).unwrap();
    let observed = |met: &[Verdict], periods: u32| {
        let chaotic = met.iter().filter(|verdict| verdict.regime == Regime::Chaotic);
        chaotic.filter(|verdict| verdict.measures.observed == periods).count()
    };
    let (ended, fixed) = (run(LONG), run(Schedule { fixed_periods: true, ..LONG }));
    let (half, whole) = (observed(&ended, 70), observed(&ended, 140));
    println!("chaotic: {half} observed for half as long, {whole} for all of it");
    assert!(half > 20 && half > whole, "{half}, {whole}");
    // All of the observation says the same.
    let ended = ended.iter().zip(&fixed).filter(|(ended, _)| ended.measures.observed == 70);
    let other = ended.filter(|(ended, whole)| ended.regime != whole.regime).count();
    assert!(20 * other <= half, "{other} of {half} would have another regime");
    // Where the periods are fixed, none ends early; nor where half of it is too short to tell.
    assert_eq!(observed(&fixed, 70), 0);
    assert_eq!(observed(&run(Schedule { observe: 120, ..LONG }), 60), 0);
}

/// What is rare is among what was compared: every event, and every kind of contact that a move begins in.
#[test]
fn the_cells_that_are_compared_meet_every_event() {
    let mut met = HashMap::new();
    for job in paper(2000) {
        let flight = Flight::<f64, 2>::new(&job.system).round::<f32>();
        let start: Vec<f32> = job.start.iter().map(|&value| value as f32).collect();
        let mut trajectory = Trajectory::new(&flight, State::from_slice(&start));
        let mut periods = 0;
        while periods < SHORT.transient + SHORT.observe {
            let free = trajectory.contact.is_free();
            let name = match trajectory.advance(&flight, &mut []).event {
                Event::Flight => "an approach",
                Event::StepEnd => "the end of a step",
                Event::Impact(impact) if impact.velocity_before.abs() < 1e-3 => {
                    "an impact that hardly touches"
                }
                Event::Impact(_) => "an impact",
                Event::Caught { complete_chatter: true, .. } => "complete chatter",
                Event::Caught { .. } => "a mass caught",
                Event::Released(_) => "a release",
                Event::HalfPeriod => "phase pi",
                Event::Strobe => {
                    periods += 1;
                    "phase 0"
                }
            };
            *met.entry((name, free)).or_insert(0) += 1;
        }
    }
    println!("{met:#?}");
    for name in
        ["an approach", "the end of a step", "an impact", "an impact that hardly touches", "complete chatter"]
    {
        assert!(met.get(&(name, true)).is_some_and(|&times| times > 50), "{name}: {met:?}");
    }
    for name in ["a release", "phase pi", "phase 0", "the end of a step"] {
        assert!(met.get(&(name, false)).is_some_and(|&times| times > 50), "{name} in contact: {met:?}");
    }
}

/// The negative controls: the arithmetic of the driver has other bits, and so has a start that is moved by one rounding.
#[test]
fn other_arithmetic_and_another_start_are_noticed() {
    let jobs = paper(500);
    assert!(differ(gpu(), &jobs, &SHORT) > 100);
    let moved: Vec<Job> = jobs
        .iter()
        .map(|job| {
            let mut start = job.start;
            start[2] = f64::from(f32::EPSILON);
            Job { system: job.system.clone(), start }
        })
        .collect();
    let there = exact().run(&moved, &SHORT, &Unwatched).unwrap();
    let here = CpuSingle.run(&jobs, &SHORT, &Unwatched).unwrap();
    assert!(there.iter().zip(&here).filter(|(there, here)| !are_same(there, here)).count() > 250);
}

#[test]
fn extents_and_sections_have_the_bits_of_the_twin() {
    let jobs = paper(200);
    let verdicts = CpuSingle.run(&jobs, &LOOK, &Unwatched).unwrap();
    let there = extents(exact(), &jobs, &verdicts, &LOOK, &Unwatched).unwrap();
    let here = extents(&CpuSingle, &jobs, &verdicts, &LOOK, &Unwatched).unwrap();
    assert_eq!(format!("{there:?}"), format!("{here:?}"));
    for reading in [Reading::VBefore, Reading::Tau] {
        let probe = Probe::new(Section::A, reading).unwrap();
        let there = exact().trace(&jobs, &SHORT, probe, 64, &Unwatched).unwrap();
        let here = CpuSingle.trace(&jobs, &SHORT, probe, 64, &Unwatched).unwrap();
        let differing = there.iter().zip(&here).filter(|(a, b)| a.readings != b.readings).count();
        assert_eq!(differing, 0, "{reading:?}");
        assert!(here.iter().map(|trace| trace.readings.len()).sum::<usize>() > 400);
    }
}

#[test]
fn a_schedule_that_cannot_be_followed_is_refused() {
    let jobs = paper(4);
    let probe = Probe::new(Section::A, Reading::Tau).unwrap();
    let backends: [&dyn Backend; 3] = [&Cpu, &CpuSingle, gpu()];
    for backend in backends {
        for refused in [Schedule { observe: 0, ..SHORT }, Schedule { max_period: 0, ..SHORT }] {
            let run = backend.run(&jobs, &refused, &Unwatched);
            assert!(matches!(run, Err(BackendError::Schedule(_))), "{run:?}");
            let traced = backend.trace(&jobs, &refused, probe, 8, &Unwatched);
            assert!(matches!(traced, Err(BackendError::Schedule(_))), "{traced:?}");
        }
        assert_eq!(backend.run(&jobs, &SHORT, &Unwatched).unwrap().len(), jobs.len());
        let control = |schedule: ControlSchedule| {
            let job = ControlJob { job: jobs[0].clone(), controller: Controller::None(Stop::A) };
            backend.control(&[job], &schedule, &Unwatched)
        };
        for refused in
            [ControlSchedule { iterates: 3, ..CONTROL }, ControlSchedule { max_period: 0, ..CONTROL }]
        {
            let controlled = control(refused);
            assert!(matches!(controlled, Err(BackendError::ControlSchedule(_))), "{controlled:?}");
        }
        assert_eq!(control(CONTROL).unwrap().len(), 1);
    }
}

/// Some cells of a family.
fn few(jobs: &[Job]) -> &[Job] {
    &jobs[..jobs.len().min(16)]
}

#[test]
fn systems_of_one_to_three_coordinates_have_the_bits_of_the_twin() {
    let families = families(60);
    assert!(families.len() >= 8);
    let settles = |job: &Job| follow::<f32>(job, &LOOK).periods < LOOK.transient;
    let settled = families.iter().flat_map(|jobs| few(jobs)).filter(|job| settles(job)).count();
    assert!(settled > 20, "{settled} cells settle early");
    let second = open_exact();
    on_devices([exact(), &second], &families, |device, jobs: &Vec<Job>| {
        let started = std::time::Instant::now();
        assert_eq!(differ(device, jobs, &SHORT), 0, "{:?}", jobs[0].system.plant());
        // Motions that settle, and leaps to them.
        assert_eq!(differ(device, few(jobs), &LOOK), 0, "{:?}", jobs[0].system.plant());
        println!("{} cells of {} normals in {:?}", jobs.len(), jobs[0].system.normals(), started.elapsed());
    });
}
