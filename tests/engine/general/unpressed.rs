//! Masses that rest on stops with nothing that presses them on: not for a moment, but for as long as others move as they do.

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Backend, Cpu, CpuSingle, Job, Unwatched};
use impact_atlas::model::{Real, StateVector, System};
use impact_atlas::system::Plant;
use nalgebra::{DMatrix, DVector};

use crate::common::adapter::open;
use crate::common::general::Follower;
use crate::common::general::conditioning::deviation;
use crate::general::subject::{Period, follow, masses, stop};

/// sin φ pushes the first mass on its stop for half a period; the second is on a stop of its own, and the spring between them is
/// as long as that needs: κ (x1 − x2) on it is balanced by what holds it elsewhere.
fn pushed(preload: f64) -> Plant {
    let mut plant = masses(&[1.0, 1.0], 1.7);
    plant.damping = DMatrix::from_diagonal_element(2, 2, 0.1);
    plant.stiffness = DMatrix::from_row_slice(2, 2, &[2.0, -0.3, -0.3, 1.0]);
    plant.force_sin = DVector::from_row_slice(&[1.0, 0.0]);
    // x2 = 0.3 x1 is where nothing presses on the second stop.
    plant.stops = vec![stop(&[1.0, 0.0], preload, 0.7), stop(&[0.0, 1.0], 0.3 * preload, 0.7)];
    plant
}

/// The same with a third mass on the second one, which nothing moves while that rests.
fn pushed_with_a_tail() -> Plant {
    let mut plant = masses(&[1.0, 1.0, 1.0], 1.7);
    plant.damping = DMatrix::from_diagonal_element(3, 3, 0.1);
    plant.stiffness = DMatrix::from_row_slice(3, 3, &[2.0, -0.5, 0.0, -0.5, 1.5, -0.5, 0.0, -0.5, 1.0]);
    plant.force_sin = DVector::from_row_slice(&[1.0, 0.0, 0.0]);
    plant.stops = vec![stop(&[1.0, 0.0, 0.0], 0.0, 0.7), stop(&[0.0, 1.0, 0.0], 0.0, 0.7)];
    plant
}

/// A mass between two that swing against each other: what they pull it by is nothing but rounding.
fn between_two(scale: f64) -> Plant {
    let mut plant = masses(&[1.0, 1.0, 1.0], 1.7);
    plant.damping = DMatrix::from_diagonal_element(3, 3, 0.1);
    plant.stiffness =
        scale * DMatrix::from_row_slice(3, 3, &[2.0, -0.5, 0.0, -0.5, 1.0, -0.5, 0.0, -0.5, 2.0]);
    plant.force_sin = DVector::from_row_slice(&[1.0, 0.0, -1.0]);
    plant.stops = vec![stop(&[0.0, 1.0, 0.0], 0.0, 0.7)];
    plant
}

/// As it moves from its start, and from one that is as good as that.
fn both<T: Real>(plant: &Plant, start: &[f64], beside: f64, periods: usize) -> [Vec<Period>; 2] {
    let mut near = start.to_vec();
    near[1] -= beside;
    [start, &near].map(|start| follow::<T>(plant, start, periods))
}

/// Both follow their motion for all these periods, and come to the same.
fn moves_like_its_neighbour<T: Real>(plant: &Plant, start: &[f64], beside: f64) {
    let [own, near] = both::<T>(plant, start, beside, 8);
    assert_eq!((own.len(), near.len()), (8, 8), "{plant:?} does not get on");
    for (own, near) in own.iter().zip(&near) {
        let off = deviation(&own.strobe, &near.strobe);
        assert!(off < 1e3 * beside, "off by {off:e}: {own:?}\n{near:?}");
        assert_eq!(own.impacts[0], near.impacts[0]);
    }
    assert!(own[7].impacts[0] > 0, "masses that are pulled off come back: {:?}", own[7]);
}

#[test]
fn a_mass_that_nothing_presses_on_its_stop_is_let_go_with_the_one_that_keeps_it_there() {
    for preload in [0.0, -0.1, -0.3, -0.07] {
        let start = [preload, 0.3 * preload, 0.0, 0.0];
        moves_like_its_neighbour::<f64>(&pushed(preload), &start, 1e-9);
        moves_like_its_neighbour::<f32>(&pushed(preload), &start, 1e-6);
    }
    moves_like_its_neighbour::<f64>(&pushed_with_a_tail(), &[0.0; 6], 1e-9);
    moves_like_its_neighbour::<f32>(&pushed_with_a_tail(), &[0.0; 6], 1e-6);
}

/// The first contact opens when the force changes its sign, and the second soon after, when the first mass has moved.
#[test]
fn both_contacts_open_when_the_force_changes_its_sign() {
    let period = follow::<f64>(&pushed(0.0), &[0.0; 4], 1).remove(0);
    let half = std::f64::consts::PI / 1.7;
    let times: Vec<f64> = [0, 1]
        .iter()
        .map(|&stop| period.releases.iter().find(|&&(released, _)| released == stop).unwrap().1)
        .collect();
    assert!((times[0] - half).abs() < 1e-7 && (times[1] - half).abs() < 1e-4, "{times:?} for {half}");
    // A force that presses the second mass, however little, keeps it for longer.
    let mut pressed = pushed(0.0);
    pressed.load[1] = 1e-3;
    let period = follow::<f64>(&pressed, &[0.0; 4], 1).remove(0);
    let (_, second) = period.releases.iter().find(|&&(stop, _)| stop == 1).unwrap();
    assert!(second - half > 0.1, "{second} after {half}");
}

/// What is pressed a little is let go soon after: as in a simulation that shares no code with the engine.
#[test]
fn contacts_that_open_one_soon_after_the_other_open_in_time() {
    let mut both = 0;
    for load in [1e-1, 1e-2, 1e-3, 1e-4, 1e-6] {
        let mut plant = pushed(0.0);
        plant.load[1] = load;
        let mut oracle = Follower::new(plant.clone(), &[0.0; 4]);
        for period in follow::<f64>(&plant, &[0.0; 4], 8) {
            let exact = oracle.next_period();
            let off = deviation(&period.strobe, &exact.strobe);
            assert!(off < 1e-9 && period.held == exact.held, "off by {off:e}: {load}: {period:?}\n{exact:?}");
            both += usize::from(period.releases.len() > 1);
        }
    }
    assert!(both >= 5, "{both} periods in which both contacts open");
}

fn stays<T: Real>(scale: f64) {
    let plant = between_two(scale);
    let mut start = [0.0; 6];
    // A swing of their own, which goes on beside what the force makes.
    (start[0], start[2], start[3], start[5]) = (0.3, -0.3, 0.1, -0.1);
    let periods = follow::<T>(&plant, &start, 40);
    assert_eq!(periods.len(), 40, "it does not get on");
    for period in &periods {
        let [x1, x2, x3] = [0, 1, 2].map(|i| period.strobe[i]);
        assert!(x2.abs() < 1e2 * T::EPSILON && (x1 + x3).abs() < 1e2 * T::EPSILON, "{period:?}");
    }
    assert!(periods[39].strobe[3].abs() > 1e-2 / scale, "the others swing");
    // One of the others swings farther: the mass between them is pulled off.
    start[0] += 0.01;
    let pulled = follow::<T>(&plant, &start, 4);
    assert!(pulled.iter().any(|period| period.strobe[1] < -1e-4), "{pulled:?}");
}

#[test]
fn a_mass_that_two_others_pull_alike_stays_where_it_is() {
    for scale in [1.0, 40.0] {
        stays::<f64>(scale);
        stays::<f32>(scale);
    }
}

/// Masses whose equilibrium is on a stop, but for rounding, which says in turn that they press and that they are pulled.
#[test]
fn a_mass_that_rounding_alone_pulls_off_its_stop_stays_there() {
    // The second stop is where the first mass is at rest with the second one on its own stop.
    let mut balanced = masses(&[2.0, 2.0], 100.0);
    balanced.damping = DMatrix::from_row_slice(2, 2, &[20.0, 0.0, 0.0, 50.0]);
    balanced.stiffness = DMatrix::from_row_slice(2, 2, &[1e4, -5e3, -5e3, 2.5e4]);
    balanced.force_sin = DVector::from_row_slice(&[0.0, -1e4]);
    let [near, far] = [0.022_222_222_222_222_223, 0.044_444_444_444_444_446];
    balanced.stops = vec![stop(&[0.0, -1.0], -far, 0.7), stop(&[-1.0, 0.0], -near, 0.7)];
    // The second mass falls on the first one, which nothing else holds on its stop.
    let mut struck = masses(&[1.0, 2.0], 1.0);
    struck.damping = DMatrix::from_row_slice(2, 2, &[0.5, 0.0, 0.0, 0.2]);
    struck.stiffness = DMatrix::from_row_slice(2, 2, &[2.0, 0.0, 0.0, 0.5]);
    struck.force_sin = DVector::from_row_slice(&[0.0, 0.5]);
    struck.load = DVector::from_row_slice(&[0.0, -0.3]);
    struck.stops = vec![stop(&[1.0, 0.0], 0.0, 0.0), stop(&[-1.0, 1.0], 0.0, 0.5)];
    for (plant, start) in [(balanced, [near, far, 0.0, 0.0]), (struck, [0.0; 4])] {
        assert_eq!(follow::<f64>(&plant, &start, 200).len(), 200, "{plant:?} does not get on");
        assert_eq!(follow::<f32>(&plant, &start, 200).len(), 200, "{plant:?} does not get on in f32");
    }
}

/// What they are labelled, and where they are at the last strobe: on the CPU in either precision, and on an adapter.
#[test]
fn they_are_labelled_alike_everywhere() {
    let gpu = open();
    let schedule = Schedule { transient: 60, observe: 40, max_period: 8, fixed_periods: false };
    for plant in [pushed(0.0), pushed(-0.1), between_two(1.0)] {
        let start = StateVector::from_slice(&vec![0.0; 2 * plant.n]).unwrap();
        let jobs = [Job { system: System::of_plant(plant).unwrap(), start }];
        let on = |backend: &dyn Backend| backend.run(&jobs, &schedule, &Unwatched).unwrap()[0];
        let [double, single, adapter] = [on(&Cpu), on(&CpuSingle), on(&gpu)];
        for verdict in [&single, &adapter] {
            assert_eq!((verdict.regime, verdict.n, verdict.counts), (double.regime, double.n, double.counts));
            let off = deviation(&verdict.state, &double.state);
            assert!(off < 1e-4, "off by {off:e}: {verdict:?}\n{double:?}");
        }
    }
}
