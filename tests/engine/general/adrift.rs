//! Systems that nothing ties to the ground: what is said of them is what is said of their relative motion.

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Cpu, Job, Unwatched, confirmed_by};
use impact_atlas::dynamics::record;
use impact_atlas::model::{StateVector, System};
use impact_atlas::system::Plant;
use impact_atlas::theory::{SettledMotion, Spectrum};
use nalgebra::{Complex, DMatrix};

use crate::common::general::Follower;
use crate::common::general::conditioning::deviation;
use crate::general::subject::{follow, masses, stop};

const FIRST: f64 = 1.0;
const SECOND: f64 = 0.6;
const LOADS: [f64; 2] = [0.3, 0.1];
const GAPS: [f64; 2] = [0.1, 0.4];

/// Two masses on a spring, beside a damper, that hit each other at either end of a clearance: one of them forced, both loaded.
fn pair(omega: f64, restitution: f64) -> Plant {
    dragged(omega, restitution, 0.0)
}

/// The same with a damper to the ground at each mass, in proportion to it.
fn dragged(omega: f64, restitution: f64, drag: f64) -> Plant {
    let joint = |k: f64| DMatrix::from_row_slice(2, 2, &[k, -k, -k, k]);
    let mut plant = masses(&[FIRST, SECOND], omega);
    (plant.stiffness, plant.damping) = (joint(1.0), joint(0.2) + &plant.mass * drag);
    plant.force_sin[0] = 1.0;
    plant.load.copy_from_slice(&LOADS);
    plant.stops = vec![stop(&[1.0, -1.0], GAPS[0], restitution), stop(&[-1.0, 1.0], GAPS[1], restitution)];
    plant
}

/// x1 − x2 of that: one mass, m1 m2/(m1 + m2), between stops of the ground.
fn relative(omega: f64, restitution: f64, drag: f64) -> Plant {
    let mass = FIRST * SECOND / (FIRST + SECOND);
    let mut plant = masses(&[mass], omega);
    (plant.stiffness[(0, 0)], plant.damping[(0, 0)]) = (1.0, 0.2 + mass * drag);
    plant.force_sin[0] = mass / FIRST;
    plant.load[0] = mass * (LOADS[0] / FIRST - LOADS[1] / SECOND);
    plant.stops = vec![stop(&[1.0], GAPS[0], restitution), stop(&[-1.0], GAPS[1], restitution)];
    plant
}

/// The pair, and a third mass that springs tie to a fourth alone: two independent rigid-body motions.
fn two_pairs() -> Plant {
    let pair = pair(1.3, 0.7);
    let mut plant = masses(&[FIRST, 0.8, SECOND, 1.3], 1.3);
    for (of, to) in [(&pair.stiffness, &mut plant.stiffness), (&pair.damping, &mut plant.damping)] {
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            to[(2 * i, 2 * j)] = of[(i, j)];
            to[(2 * i + 1, 2 * j + 1)] = 0.7 * of[(i, j)];
        }
    }
    plant.force_sin[0] = 1.0;
    plant.force_cos[3] = 0.4;
    plant.load.copy_from_slice(&[0.3, -0.2, 0.1, 0.0]);
    plant.stops = vec![stop(&[1.0, 0.0, -1.0, 0.0], 0.1, 0.7), stop(&[0.0, 1.0, 0.0, -1.0], 0.2, 0.6)];
    plant
}

/// x1 − x2 and v1 − v2, or those of both pairs.
fn differences(state: &[f64]) -> Vec<f64> {
    let pairs = if state.len() == 4 { vec![(0, 1), (2, 3)] } else { vec![(0, 2), (1, 3), (4, 6), (5, 7)] };
    pairs.into_iter().map(|(i, j)| state[i] - state[j]).collect()
}

#[test]
fn what_moves_as_a_whole_bears_on_nothing_else() {
    let mut uneven = pair(1.3, 0.7);
    uneven.damping[(0, 0)] += 0.1;
    for (plant, held) in [(pair(1.3, 0.7), 2), (two_pairs(), 4), (dragged(1.3, 0.7, 0.1), 1), (uneven, 1)] {
        let system = System::of_plant(plant.clone()).unwrap().moored().unwrap();
        assert_eq!(system.moorings().len(), held);
        let start: Vec<f64> =
            (0..2 * plant.n).map(|i| if i < plant.n { 0.0 } else { 0.9 - 0.3 * i as f64 }).collect();
        let recording = record(&system, &start[..], 0, 20, 1);
        let adrift = follow::<f64>(&plant, &start, 20);
        let mut oracle = Follower::new(plant.clone(), &start);
        let mut impacts = 0;
        for (sample, period) in recording.samples[1..].iter().zip(&adrift) {
            let truth = oracle.next_period();
            let off = deviation(&differences(&sample.state), &differences(&truth.strobe));
            assert!(off < 1e-9, "off by {off:e}: {plant:?}");
            let drifting = deviation(&period.strobe, &truth.strobe);
            assert!(drifting < 1e-9, "off by {drifting:e} where it may drift: {plant:?}");
            impacts += truth.impacts.iter().sum::<u32>();
        }
        assert!(impacts > 20 && recording.impacts.len() == impacts as usize, "{impacts}");
        let ends = [&adrift[19].strobe[..], &recording.samples[20].state[..]].map(|state| state[0].abs());
        assert!(ends[0] > 50.0 && ends[1] < 10.0, "it drifts, unless it is held: {ends:?}");
    }
}

fn verdicts(plant: impl Fn(f64, f64) -> Plant) -> Vec<(System, Verdict)> {
    let cells = (0..48).map(|i| (0.5 + 0.05 * f64::from(i % 24), if i < 24 { 0.7 } else { 0.0 }));
    let jobs: Vec<Job> = cells
        .map(|(omega, restitution)| {
            let system = System::of_plant(plant(omega, restitution)).unwrap().moored().unwrap();
            let start = StateVector::from_slice(&vec![0.0; 2 * system.coordinates()]).unwrap();
            Job { system, start }
        })
        .collect();
    let schedule = Schedule { transient: 4000, observe: 200, max_period: 16, fixed_periods: false };
    let found = confirmed_by(&Cpu, &jobs, &schedule, &Unwatched).unwrap();
    jobs.into_iter().map(|job| job.system).zip(found).collect()
}

/// Everything that is said of the pair: what is said of x1 − x2, and of the velocity of both where it is damped, which the rest does
/// not touch.
fn is_known_by_its_relative_motion(drag: f64) {
    let (mut compared, mut sticking, mut unresolved) = (0, 0, 0);
    let cells = verdicts(|omega, restitution| dragged(omega, restitution, drag));
    let reduced = verdicts(|omega, restitution| relative(omega, restitution, drag));
    for ((system, verdict), (reduced, expected)) in cells.into_iter().zip(reduced) {
        let what = format!("{verdict:?} for {expected:?}");
        assert_eq!((verdict.regime, verdict.symmetric), (expected.regime, expected.symmetric), "{what}");
        unresolved += u32::from(expected.regime == Regime::Unresolved);
        if !expected.regime.is_periodic() {
            continue;
        }
        assert_eq!(verdict.label(), expected.label(), "{what}");
        let peak = verdict.peak_impact_velocity - expected.peak_impact_velocity;
        assert!(peak.abs() < 1e-4, "{what}");
        let slowing = (drag > 0.0).then_some(-drag * system.period());
        let largest = slowing.map_or(expected.lyapunov, |slowing| expected.lyapunov.max(slowing as f32));
        let off = (verdict.lyapunov - largest).abs();
        assert!(off < 1e-3 || verdict.lyapunov == largest, "{what}");

        let [own, mut others] = [(&system, &verdict), (&reduced, &expected)].map(|(system, verdict)| {
            SettledMotion::of(system, verdict).unwrap().multipliers(system).unwrap()
        });
        let turns = f64::from(verdict.n);
        others.extend(slowing.map(|slowing| Complex::from((slowing * turns).exp())));
        others.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
        assert_eq!(own.len(), others.len());
        for (own, other) in own.iter().zip(&others) {
            assert!((own - other).norm() < 1e-7, "{own} for {other}: {what}");
        }

        let [own, mut others] = [(&system, &verdict), (&reduced, &expected)]
            .map(|(system, verdict)| Spectrum::of(system, &verdict.state[..], 20, 160).unwrap());
        // How many rebounds are followed before complete chatter is closed says nothing.
        let counted = own.endless.contains(&true) || own.impacts == others.impacts;
        assert!(counted && own.lost == others.lost && own.endless == others.endless, "{what}");
        others.per_period.extend(slowing);
        others.per_period.sort_by(|a, b| b.total_cmp(a));
        for (exponent, other) in own.per_period.iter().zip(&others.per_period) {
            assert!((exponent - other).abs() < 0.1 || exponent == other, "{own:?} for {others:?}");
        }
        if own.lost == 0 {
            let sum: f64 = own.per_period.iter().sum();
            assert!((sum - own.sum_identity(&system)).abs() < 1e-9, "{sum}: {own:?}");
        }
        compared += 1;
        sticking += u32::from(own.lost > 0);
    }
    assert!(
        compared > 30 && sticking > 5 && unresolved == 0,
        "{compared} compared, {sticking} of them sticking, {unresolved} unresolved"
    );
}

#[test]
fn what_is_said_of_masses_adrift_is_what_is_said_of_their_relative_motion() {
    is_known_by_its_relative_motion(0.0);
}

#[test]
fn it_is_where_they_are_dragged_as_well() {
    is_known_by_its_relative_motion(0.03);
}
