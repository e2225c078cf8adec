//! Any plant: numbers that were published or follow by hand, and random plants against the simulation.

use std::f64::consts::{PI, TAU};

use impact_atlas::dynamics::{Event, Stop, Trajectory};
use impact_atlas::model::{Flight, State, System};
use impact_atlas::system::{Family, Plant, PlantStop, builtin};
use impact_atlas::theory::{
    Label, NoReturn, Pattern, PeriodicMotion, Search, SectionVector, SettledMotion, Spectrum, StrobeMotion,
    impact_map, impact_map_at, labelled_motion, section_names, settled_motion, symmetric_motions,
};
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::assert_close;
use super::jacobians::differences;

fn vector(values: &[f64]) -> DVector<f64> {
    DVector::from_row_slice(values)
}

/// x″ + c x′ + k x = s sin t + cos t + l with one stop.
fn single(damping: f64, stiffness: f64, loads: [f64; 3], stop: (f64, f64, f64)) -> System {
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let [sin, cos, load] = loads.map(|load| vector(&[load]));
    let (direction, gap, restitution) = stop;
    System::of_plant(Plant {
        n: 1,
        mass: one(1.0),
        damping: one(damping),
        stiffness: one(stiffness),
        force_sin: sin,
        force_cos: cos,
        load,
        omega: 1.0,
        stops: vec![PlantStop { direction: vector(&[direction]), gap, restitution }],
    })
    .unwrap()
}

/// The impact oscillator of the COCO book.
fn coco(restitution: f64) -> System {
    single(0.1, 1.0, [0.0, 1.0, 0.0], (1.0, 1.0, restitution))
}

fn searched(n: usize) -> Search {
    Search { start: vec![0.0; 2 * n], transient: 100, observe: 300 }
}

/// Velocity before impact, its phase, and trace and determinant of the return map, as published.
#[test]
fn the_impact_oscillator_has_its_published_motion() {
    let published = [1.69573293759, 0.0759521649383, -1.16859062868, 0.341432378298];
    let measured = |system: &System| {
        let label = Label::read("1-1", 1).unwrap();
        let motion = labelled_motion(system, label, &searched(1)).unwrap();
        assert_eq!((motion.label().as_str(), motion.is_stable(system)), ("1-1", Some(true)));
        let [after, phase] = motion.section()[..] else { panic!("two components") };
        let jacobian = impact_map(system, motion.section()).unwrap().jacobian.unwrap();
        assert!((&jacobian - motion.jacobian(system).unwrap()).amax() < 1e-9);
        [-after / system.plant().stops[0].restitution, phase, jacobian.trace(), jacobian.determinant()]
    };
    assert_close(&measured(&coco(0.8)), &published, 2e-11);
    let other = measured(&coco(0.8001));
    assert!(other.iter().zip(published).all(|(a, b)| (a - b).abs() > 1e-8), "the check can fail: {other:?}");
    assert_eq!(section_names(&coco(0.8), Stop(0)), ["v1", "tau"]);
}

/// Relative to the table y″ = −1 + Γ sin t with a stop at y = 0.
fn ball(e: f64, gamma: f64) -> System {
    single(0.0, 0.0, [gamma, 0.0, -1.0], (-1.0, 0.0, e))
}

/// Where a property of Γ that holds at `low` and not at `high` is lost.
fn border(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    assert!(holds(low) && !holds(high), "between {low} and {high}");
    while (high - low).abs() > 1e-9 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// v+ = 2πe/(1 + e) at the phase with Γ cos φ = π(1 − e)/(1 + e): the motion exists where there is such a phase, and
/// doubles its period at a multiplier −1.
#[test]
fn the_ball_on_the_table_bounces_and_doubles_its_period_where_it_should() {
    for (e, exists, doubles) in [(0.5, PI / 3.0, 1.526824), (0.8, 0.349066, 1.070836)] {
        let speed = TAU * e / (1.0 + e);
        let refined = |gamma: f64, guess: [f64; 2]| {
            let system = ball(e, gamma);
            let pattern = Pattern::new(&system, vec![Stop(0)], 2, false);
            let motion =
                PeriodicMotion::refine(&system, &pattern, &[SectionVector::from_row_slice(&guess)]).ok()?;
            Some((motion.is_stable(&system).unwrap(), motion))
        };
        // A guess somewhat off, so that Newton's method has something to do.
        let near = |gamma: f64| {
            let phase = (exists / gamma).min(1.0).acos();
            [phase, -phase].into_iter().filter_map(move |phase| refined(gamma, [1.01 * speed, phase + 0.01]))
        };
        let moves = |gamma: f64| near(gamma).next().is_some();
        assert!((border(exists * 1.05, exists * 0.95, moves) - exists).abs() < 2e-5);
        let stable = |gamma: f64| near(gamma).any(|(stable, _)| stable);
        assert!((border(exists * 1.02, doubles * 1.05, stable) - doubles).abs() < 1e-6);
        let (_, motion) = near(1.2 * exists).find(|(stable, _)| *stable).unwrap();
        let [found, phase] = motion.section()[..] else { panic!("two components") };
        assert!((found - speed).abs() < 1e-10, "{found} {speed}");
        assert!((1.2 * exists * phase.cos() - PI * (1.0 - e) / (1.0 + e)).abs() < 1e-10);
        let off = border(exists * 1.02, doubles * 1.05, |gamma| {
            near(gamma).any(|(_, motion)| motion.multipliers(&ball(e, gamma)).unwrap()[0].norm() < 0.99)
        });
        assert!((off - doubles).abs() > 1e-6, "the check can fail: {off}");
    }
}

/// The families that come with the program, at their defaults.
fn family(name: &str) -> System {
    let family = Family::parse(builtin(name).unwrap(), name).unwrap();
    System::of_plant(family.plant(&family.defaults()).unwrap()).unwrap()
}

/// A random plant with two-sided, single or relative stops; every matrix full, mass and stiffness definite.
fn random_plant(rng: &mut ChaCha8Rng, n: usize, directions: &[Vec<f64>]) -> System {
    let mut definite = |size: f64| {
        let root = DMatrix::from_fn(n, n, |_, _| rng.random_range(-1.0..1.0));
        (&root * root.transpose() * 0.4 + DMatrix::identity(n, n)) * size
    };
    let (mass, damping, stiffness) = (definite(0.8), definite(0.05), definite(1.5));
    let mut loads =
        [1.0, 0.5, 0.1].map(|size| DVector::from_fn(n, |_, _| size * rng.random_range(-1.0..1.0)));
    loads[0][0] += 1.0;
    let [force_sin, force_cos, load] = loads;
    let mut stop = |direction: &Vec<f64>| PlantStop {
        direction: vector(direction),
        gap: rng.random_range(0.05..0.3),
        restitution: rng.random_range(0.4..0.95),
    };
    let stops = directions.iter().map(&mut stop).collect();
    let omega = rng.random_range(0.8..3.0);
    System::of_plant(Plant { n, mass, damping, stiffness, force_sin, force_cos, load, omega, stops }).unwrap()
}

/// Stops of every sort by the number of coordinates.
fn directions(n: usize) -> Vec<Vec<Vec<f64>>> {
    let axis =
        |i: usize, value: f64| -> Vec<f64> { (0..n).map(|j| if i == j { value } else { 0.0 }).collect() };
    let mut all = vec![vec![axis(0, 1.0)], vec![axis(0, 1.0), axis(0, -2.0)], vec![axis(n - 1, -0.5)]];
    if n > 1 {
        let mut between = axis(0, 1.0);
        between[n - 1] = -1.0;
        let tilted: Vec<f64> = (0..n).map(|j| 0.3 + 0.2 * j as f64).collect();
        all.extend([
            vec![between.clone()],
            vec![axis(0, 1.0), between.iter().map(|d| -d).collect()],
            vec![axis(0, 1.0), axis(n - 1, 1.0)],
            vec![tilted],
        ]);
    }
    all
}

#[test]
fn jacobians_of_random_plants_are_the_derivatives_of_the_simulated_map() {
    let mut rng = ChaCha8Rng::seed_from_u64(14);
    let mut worst = 0.0f64;
    for n in 1..=4 {
        for directions in directions(n) {
            let mut compared = 0;
            for _ in 0..40 {
                let system = random_plant(&mut rng, n, &directions);
                // On the orbit from rest, so that it lies within the stops.
                let Some(section) = struck(&system, 20) else { continue };
                let Ok(back) = impact_map(&system, &section) else { continue };
                let Some(jacobian) = back.jacobian else { continue };
                let slowest = back.impacts.iter().map(|node| node.section[0].abs()).fold(9.0, f64::min);
                if slowest < 0.1 || back.impacts.len() > 6 {
                    continue;
                }
                let Some(simulated) = differences(&system, &section, 1e-5) else { continue };
                let off = (&jacobian - &simulated).amax() / jacobian.amax();
                assert!(off < 1e-5, "{off:.1e} at {section:?} of {:?}", system.plant());
                worst = worst.max(off);
                let changed = jacobian
                    .map_with_location(|i, j, value| if (i, j) == (0, 0) { value + 1e-3 } else { value });
                assert!((changed - simulated).amax() > 1e-5 * jacobian.amax() || jacobian.amax() > 50.0);
                compared += 1;
                if compared == 6 {
                    break;
                }
            }
            assert!(compared >= 3, "{n} {directions:?}: {compared}");
        }
    }
    println!("worst {worst:.1e}");
}

/// The section of an impact at the first stop on the orbit from rest, after so many forcing periods.
fn struck(system: &System, periods: u32) -> Option<Vec<f64>> {
    fn of<const N: usize>(system: &System, periods: u32) -> Option<(Vec<f64>, Vec<f64>, f64)> {
        let flight = Flight::<f64, N>::new(system);
        let mut trajectory = Trajectory::new(&flight, State::zero());
        let mut strobes = 0;
        while strobes < 2 * periods {
            match trajectory.advance(&flight, &mut []).event {
                Event::Strobe => strobes += 1,
                Event::Impact(impact) if impact.stop == Stop(0) && strobes >= periods => {
                    let State { x, v } = trajectory.point.state;
                    let elapsed = f64::from(trajectory.step) * flight.h + trajectory.offset;
                    return Some((x.to_vec(), v.to_vec(), flight.omega * elapsed));
                }
                _ => {}
            }
        }
        None
    }
    let (x, v, phase) = match system.plant().n {
        1 => of::<1>(system, periods),
        2 => of::<2>(system, periods),
        3 => of::<3>(system, periods),
        _ => of::<4>(system, periods),
    }?;
    let value = |name: &String| {
        let index = || name[1..].parse::<usize>().unwrap() - 1;
        match &name[..1] {
            "x" => x[index()],
            "v" => v[index()],
            _ => phase,
        }
    };
    Some(section_names(system, Stop(0)).iter().map(value).collect())
}

#[test]
fn sections_are_named_and_refused_where_they_are_none() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let system = random_plant(&mut rng, 3, &[vec![0.0, -1.0, 1.0], vec![0.0, 0.0, 2.0]]);
    assert_eq!(section_names(&system, Stop(0)), ["v2", "x1", "x3", "v1", "v3", "tau"]);
    assert_eq!(section_names(&system, Stop(1)), ["v3", "x1", "x2", "v1", "v2", "tau"]);
    let gap = system.plant().stops[1].gap / 2.0;
    let at = |x3: f64, v2: f64| impact_map(&system, [v2, 0.0, x3, 0.0, 0.0, 1.0]);
    assert_eq!(at(gap + 0.1, 0.5).unwrap_err(), NoReturn::NotOnSection, "beyond the other stop");
    assert_eq!(at(gap - 0.1, -0.5).unwrap_err(), NoReturn::NotOnSection, "outwards");
    assert_eq!(impact_map(&system, [0.5; 4]).unwrap_err(), NoReturn::NotOnSection, "too few");
    assert_ne!(at(gap - 0.1, 0.5), Err(NoReturn::NotOnSection));
    let names = section_names(&super::at(3.7, 0.1), Stop::B);
    assert_eq!(names, ["v1", "x2", "v2", "tau"], "the paper's");
}

/// Σ λ = −T tr(M⁻¹C) + 2 ln r for each impact at a stop of that r.
/// Rebounds on the floor that hardly lose height never come back to the ceiling, and there are ever more of them.
#[test]
fn rebounds_elsewhere_that_do_not_end_are_no_return() {
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let stop =
        |side: f64, gap: f64| PlantStop { direction: DVector::from_element(1, side), gap, restitution: 1.0 };
    let system = System::of_plant(Plant {
        n: 1,
        mass: one(1.0),
        damping: one(0.01),
        stiffness: one(0.0),
        force_sin: DVector::zeros(1),
        force_cos: DVector::zeros(1),
        load: DVector::from_element(1, -1.0),
        omega: 0.01,
        stops: vec![stop(1.0, 1.0), stop(-1.0, 0.0)],
    })
    .unwrap();
    assert_eq!(impact_map_at(&system, Stop(0), [-0.1, 0.0]).unwrap_err(), NoReturn::NoHeadway(Stop(0)));
    let next = impact_map_at(&system, Stop(1), [0.5, 0.0]).unwrap();
    assert_eq!(next.impacts.len(), 1, "on the floor it returns at once");
}

#[test]
fn exponents_of_random_plants_sum_to_the_contraction_of_volume() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    for n in 1..=4 {
        let mut compared = 0;
        for directions in directions(n).into_iter().cycle().take(40) {
            let system = random_plant(&mut rng, n, &directions);
            let Ok(spectrum) = Spectrum::of(&system, vec![0.0; 2 * n], 50, 32) else { continue };
            assert_eq!(spectrum.per_period.len(), 2 * n);
            if spectrum.lost > 0 || spectrum.impacts < 16 {
                continue;
            }
            let sum: f64 = spectrum.per_period.iter().sum();
            let trace =
                (system.plant().mass.clone().try_inverse().unwrap() * &system.plant().damping).trace();
            let struck: f64 = spectrum
                .impacts_per_stop
                .iter()
                .zip(&system.plant().stops)
                .map(|(&count, stop)| {
                    2.0 * stop.restitution.ln() * count as f64 / f64::from(spectrum.periods)
                })
                .sum();
            let expected = struck - system.period() * trace;
            assert!((sum - expected).abs() < 1e-6 * expected.abs(), "{sum} {expected}: {:?}", system.plant());
            assert!((spectrum.sum_identity(&system) - expected).abs() < 1e-9 * expected.abs());
            assert!((sum - expected * 1.00001).abs() > 1e-6 * expected.abs(), "the check can fail");
            compared += 1;
            if compared == 4 {
                break;
            }
        }
        assert!(compared == 4, "{n}: {compared}");
    }
}

/// A ball that sticks to a table that shakes gently loses both its directions, one that bounces none; an impact with
/// r = 0 loses one.
#[test]
fn lost_directions_are_counted() {
    let bouncing = Spectrum::of(&coco(0.8), [0.0, 0.0], 100, 32).unwrap();
    let resting = Spectrum::of(&ball(0.5, 0.9), [0.0, 0.0], 20, 32).unwrap();
    assert_eq!((resting.lost, resting.per_period), (2, vec![f64::NEG_INFINITY; 2]));
    assert!(bouncing.impacts > 0 && bouncing.lost == 0, "{bouncing:?}");
    let chain = family("three-mass-chain");
    let mut plant = chain.plant().clone();
    plant.stops.iter_mut().for_each(|stop| stop.restitution = 0.0);
    let plastic = Spectrum::of(&System::of_plant(plant).unwrap(), [0.0; 6], 50, 32).unwrap();
    assert!(plastic.impacts > 0 && plastic.lost >= 1, "{plastic:?}");
    let kept = 6 - plastic.lost as usize;
    assert!(plastic.per_period[..kept].iter().all(|exponent| exponent.is_finite()), "{plastic:?}");
}

/// The closed form is what the system does: half a period later it is its own mirror image.
#[test]
fn symmetric_motions_are_those_of_the_mirror() {
    let mut physical = 0;
    for (system, frequencies) in
        [(family("three-mass-chain"), 40), (family("impact-pair"), 40), (two_walls(), 40)]
    {
        for k in 0..frequencies {
            let omega = 0.3 + 0.1 * f64::from(k);
            let plant = Plant { omega, ..system.plant().clone() };
            let system = System::of_plant(plant).unwrap();
            let Ok(solutions) = symmetric_motions(&system) else { continue };
            for solution in solutions.iter().filter(|solution| solution.at_phase_zero.is_ok()) {
                let motion = &solution.motion;
                assert!(motion.is_symmetric() && motion.residual < 1e-9, "{motion:?}");
                let start = solution.at_phase_zero.clone().unwrap();
                assert_close(&motion.at_phase_zero(&system), &start, 1e-8);
                let whole = StrobeMotion::refine(&system, &start, 1).unwrap();
                assert!(whole.symmetric && whole.residual < 1e-9);
                assert_close(&whole.state, &start, 1e-7);
                assert_eq!(whole.label(), motion.label());
                let (a, b) = (whole.multipliers(), motion.multipliers(&system));
                let scale = 1.0 + b.as_ref().unwrap()[0].norm();
                for (a, b) in a.unwrap().iter().zip(b.unwrap()) {
                    assert!((a.norm() - b.norm()).abs() < 1e-5 * scale, "{a} {b}");
                }
                let image = motion.mirror_image(&system).unwrap();
                assert!((&image.sections[0] - &motion.sections[0]).amax() < 1e-8, "it is its own image");
                let elsewhere = Plant { omega: omega * 1.0001, ..system.plant().clone() };
                let off = impact_map(&System::of_plant(elsewhere).unwrap(), motion.section()).unwrap();
                assert!((off.section[0] - motion.section()[0]).abs() > 1e-9, "the check can fail");
                physical += 1;
            }
        }
    }
    assert!(physical > 10, "{physical}");
    let single_sided = symmetric_motions(&family("shaw-holmes")).unwrap_err();
    assert!(single_sided.to_string().contains("no mirror"), "{single_sided}");
}

/// Two equal masses, each with a wall of its own, pushed against each other: the mirror exchanges them.
fn two_walls() -> System {
    let matrix = |own: f64, other: f64| DMatrix::from_row_slice(2, 2, &[own, other, other, own]);
    let stop = |direction: &[f64]| PlantStop { direction: vector(direction), gap: 0.25, restitution: 0.7 };
    System::of_plant(Plant {
        n: 2,
        mass: matrix(1.0, 0.1),
        damping: matrix(0.2, -0.05),
        stiffness: matrix(2.0, -0.5),
        force_sin: vector(&[1.0, -1.0]),
        force_cos: vector(&[0.2, -0.2]),
        load: vector(&[0.05, 0.05]),
        omega: 1.3,
        stops: vec![stop(&[1.0, 0.0]), stop(&[0.0, 1.0])],
    })
    .unwrap()
}

/// What random plants settle on, solved both ways: as a sequence of impacts and as a fixed point of the strobe map.
#[test]
fn settled_motions_of_random_plants_are_solved_both_ways() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    let (mut solved, mut kinds) = (0, std::collections::BTreeSet::new());
    for n in 1..=3 {
        for directions in directions(n).into_iter().cycle().take(30) {
            let system = random_plant(&mut rng, n, &directions);
            let Some(state) = settled(&system, 400) else { continue };
            let Ok(impacts) = settled_motion(&system, &state, 1) else { continue };
            if impacts.is_stable(&system) != Some(true) {
                continue;
            }
            let strobe = StrobeMotion::refine(&system, &state, 1).unwrap();
            assert_close(&strobe.state, &impacts.at_phase_zero(&system), 1e-7);
            assert_eq!((strobe.label(), strobe.is_stable()), (impacts.label(), Some(true)));
            let multipliers =
                strobe.multipliers().unwrap().into_iter().zip(impacts.multipliers(&system).unwrap());
            for (a, b) in multipliers {
                assert!((a.norm() - b.norm()).abs() < 1e-5, "{a} {b}");
            }
            let either = SettledMotion::near(&system, &state, 1, true).unwrap();
            assert_eq!(either.label(), impacts.label());
            let stop = impacts.pattern.stops[0];
            let back = impact_map_at(&system, stop, impacts.section()).unwrap();
            if impacts.pattern.counts()[stop.index()] == 1 {
                let [.., turned] = back.section[..] else { panic!("not empty") };
                assert!((turned - impacts.section()[2 * n - 1] - TAU).abs() < 1e-8);
            }
            let label = Label::read(&impacts.label(), directions.len()).unwrap();
            let search = Search { start: state, transient: 0, observe: 20 };
            assert_eq!(labelled_motion(&system, label, &search).unwrap().label(), impacts.label());
            kinds.insert(impacts.label());
            solved += 1;
        }
    }
    println!("{solved} solved: {kinds:?}");
    assert!(solved > 20 && kinds.len() > 4, "{solved} {kinds:?}");
}

/// The state at phase 0 on what the orbit from rest has settled on, if it repeats after one forcing period.
fn settled(system: &System, periods: u32) -> Option<Vec<f64>> {
    fn of<const N: usize>(system: &System, periods: u32) -> Option<Vec<f64>> {
        let flight = Flight::<f64, N>::new(system);
        let mut trajectory = Trajectory::new(&flight, State::zero());
        let mut before = State::zero();
        for _ in 0..periods {
            before = trajectory.point.state;
            while trajectory.advance(&flight, &mut []).event != Event::Strobe {}
        }
        let after = trajectory.point.state;
        let close = after.values().zip(before.values()).all(|(a, b)| (a - b).abs() < 1e-6);
        close.then(|| after.values().collect())
    }
    match system.plant().n {
        1 => of::<1>(system, periods),
        2 => of::<2>(system, periods),
        _ => of::<3>(system, periods),
    }
}

/// Labels are in the order that the system states.
#[test]
fn labels_are_in_their_order() {
    let mut plant = two_walls().plant().clone();
    plant.stops[1].gap = 50.0;
    let system = System::of_plant(plant).unwrap();
    let label = |system: &System| {
        let start = settled(system, 600).expect("it repeats after one period");
        let motion = settled_motion(system, start, 1).unwrap();
        (motion.label(), motion.pattern.counts())
    };
    let (own, counts) = label(&system);
    assert!(counts[0] > 0 && counts[1] == 0, "{counts:?}");
    assert_eq!(own, format!("1-{}-0", counts[0]));
    assert_eq!(label(&system.labelled(vec![1, 0])), (format!("1-0-{}", counts[0]), counts));
}
