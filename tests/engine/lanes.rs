//! Trajectories side by side have the bits that they have one by one, at every width and number of threads.

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Job, Precision, Unwatched, follow, follow_all, follow_counted};
use impact_atlas::model::{Flows, Parameters, System, Width};
use impact_atlas::validate::are_same;

use crate::common::drawn::{families, paper, rows_of_four};

const SETTLING: Schedule = Schedule { transient: 60, observe: 40, max_period: 16, fixed_periods: false };
/// A long transient, most strobes of which are passed unseen in lanes.
const TRANSIENT: Schedule = Schedule { transient: 100, observe: 1, max_period: 16, fixed_periods: true };
/// Chaos that is plain is observed for half of it.
const LONG: Schedule = Schedule { transient: 30, observe: 140, max_period: 8, fixed_periods: false };
const FIXED: Schedule = Schedule { transient: 3, observe: 30, max_period: 8, fixed_periods: true };
/// Observed from the start.
const OBSERVED: Schedule = Schedule { transient: 0, observe: 40, max_period: 8, fixed_periods: true };

/// The verdicts that are not bit for bit the same at every width, in either precision.
fn differ(jobs: &[Job], schedule: &Schedule, altered: fn(&Job) -> Job) -> usize {
    differ_in::<f64>(jobs, schedule, altered) + differ_in::<f32>(jobs, schedule, altered)
}

fn differ_in<T: Precision>(jobs: &[Job], schedule: &Schedule, altered: fn(&Job) -> Job) -> usize {
    let alone: Vec<Verdict> = jobs.iter().map(|job| follow::<T>(job, schedule)).collect();
    let given: Vec<Job> = jobs.iter().map(altered).collect();
    let mut wrong = 0;
    for width in Width::available() {
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let abreast = pool.install(|| follow_all::<T>(&given, schedule, &Unwatched, width)).unwrap();
            assert_eq!(abreast.len(), alone.len());
            wrong += alone.iter().zip(&abreast).filter(|(alone, abreast)| !are_same(alone, abreast)).count();
        }
    }
    wrong
}

#[test]
fn the_papers_oscillator_has_the_same_bits_at_every_width() {
    let jobs = paper(300);
    for schedule in [SETTLING, LONG, FIXED, TRANSIENT, OBSERVED] {
        assert_eq!(differ(&jobs, &schedule, Job::clone), 0, "{schedule:?}");
    }
    let ended =
        jobs.iter().filter(|job| follow::<f64>(job, &LONG).measures.observed == LONG.observe / 2).count();
    assert!(ended > 10, "{ended} observed for half as long");
}

/// About as many as there are lanes: some stay empty, and no more begin at once or soon.
#[test]
fn a_few_have_the_same_bits_at_every_width() {
    let jobs = paper(33);
    for count in [1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33] {
        for schedule in [SETTLING, OBSERVED] {
            assert_eq!(differ(&jobs[..count], &schedule, Job::clone), 0, "{count} by {schedule:?}");
        }
    }
}

/// Lanes take such cells one after the other, and keep what they have in common.
#[test]
fn cells_that_differ_in_their_stops_alone_have_the_same_bits_at_every_width() {
    let flows = Flows::default();
    let jobs: Vec<Job> = (0..180)
        .map(|i| {
            let (omega, delta) = ([1.5, 2.4, 3.7][i % 3], 0.05 + 0.01 * (i % 41) as f64);
            let cell = Parameters { omega, delta, r: 0.5 + 0.05 * (i % 10) as f64, ..Parameters::default() };
            Job { system: flows.system(cell.into()).unwrap(), start: [0.0; 4].into() }
        })
        .collect();
    for schedule in [SETTLING, FIXED, OBSERVED] {
        assert_eq!(differ(&jobs, &schedule, Job::clone), 0, "{schedule:?}");
    }
}

#[test]
fn every_family_has_the_same_bits_at_every_width() {
    let families = families(60);
    let cells: usize = families.iter().map(Vec::len).sum();
    assert!(families.len() >= 8 && cells > 300, "{cells} cells of {} families", families.len());
    for jobs in &families {
        for schedule in [SETTLING, FIXED] {
            assert_eq!(differ(jobs, &schedule, Job::clone), 0, "{:?}", jobs[0].system.plant());
        }
    }
}

/// As many coordinates as there can be, one contact normal and two: nearly every contact is found in lanes there, too.
#[test]
fn four_coordinates_have_the_same_bits_at_every_width() {
    let widest = Width::widest();
    for jobs in rows_of_four(60) {
        for schedule in [SETTLING, FIXED, OBSERVED] {
            assert_eq!(differ(&jobs, &schedule, Job::clone), 0, "{} normals", jobs[0].system.normals());
        }
        let usage = follow_counted::<f64>(&jobs, &FIXED, &Unwatched, widest).unwrap().1;
        let found = usage.contacts > 500 && usage.share_of_fallbacks() < 0.05;
        assert!(widest == Width::One || found, "{} normals: {usage:?}", jobs[0].system.normals());
    }
}

/// Rebounds that hardly lose velocity under a slow force: thousands in every period, which other lanes do not wait for.
#[test]
fn rebounds_by_the_thousand_have_the_same_bits_at_every_width() {
    let slow = |(omega, r)| Parameters { omega, r, delta: 0.1, ..Parameters::default() };
    let cells = [(0.03, 1.0), (0.035, 1.0), (0.04, 0.9999), (0.3, 0.9), (0.05, 1.0), (0.02, 0.995)];
    let job = |cell| Job { system: System::new(slow(cell)).unwrap(), start: [0.0; 4].into() };
    let jobs: Vec<Job> = cells.map(job).into();
    let most = jobs.iter().map(|job| follow::<f64>(job, &FIXED)).map(|told| told.impacts_total).max();
    assert!(most > Some(5_000 * (FIXED.transient + FIXED.observe)), "{most:?} impacts");
    for schedule in [FIXED, Schedule { fixed_periods: false, ..FIXED }] {
        assert_eq!(differ(&jobs, &schedule, Job::clone), 0, "{schedule:?}");
    }
}

/// The negative control: a start moved a little is seen wherever the motion remembers it.
#[test]
fn a_start_moved_a_little_is_noticed() {
    let jobs = paper(300);
    let moved = |job: &Job| {
        let mut start = job.start;
        start[2] = 1e-6;
        Job { system: job.system.clone(), start }
    };
    let runs = 2 * 2 * Width::available().count();
    let noticed = differ(&jobs, &FIXED, moved);
    assert!(2 * noticed > runs * jobs.len(), "{noticed} of {}", runs * jobs.len());
}

/// What lanes are made for: a contact that is not certain is followed by itself. Rebounds and sticking have many of them, the
/// planes that researchers ask for have few.
#[test]
fn nearly_every_contact_is_found_directly() {
    let Some(width) = Width::available().find(|width| *width != Width::One) else { return };
    let schedule = Schedule { transient: 0, observe: 100, max_period: 8, fixed_periods: true };
    let share = |omega: [f64; 2], delta: [f64; 2]| {
        let place = |[first, last]: [f64; 2], i: u32| first + (last - first) * f64::from(i) / 15.0;
        let cells = (0..256).map(|i| (place(omega, i % 16), place(delta, i / 16)));
        let jobs: Vec<Job> = cells
            .map(|(omega, delta)| Parameters { omega, delta, ..Parameters::default() })
            .map(|cell| Job { system: System::new(cell).unwrap(), start: [0.0; 4].into() })
            .collect();
        let usage = follow_counted::<f64>(&jobs, &schedule, &Unwatched, width).unwrap().1;
        assert!(usage.contacts > 10_000, "{usage:?}");
        usage.share_of_fallbacks()
    };
    let regular = share([1.0, 5.0], [0.1, 0.6]);
    let chaos = share([1.37, 1.65], [0.207, 0.232]);
    let rebounds = share([0.2, 0.6], [0.1, 0.6]);
    assert!(0.0 < regular && regular < 5e-4, "{regular}");
    assert!(0.0 < chaos && chaos < 2e-3, "{chaos}");
    assert!(rebounds > 0.005, "the check can fail: {rebounds}");
}
