//! A mass between another and a wall: the two squeeze it, and all speed is lost in an instant.

use impact_atlas::analysis::{INFINITELY_MANY, Regime, Schedule};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, decide};
use impact_atlas::dynamics::{Event, Tangent, Trajectory};
use impact_atlas::model::{Flight, State, StateVector, System};
use impact_atlas::system::{Family, Setting};
use impact_atlas::theory::{SettledMotion, Spectrum};
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::common::adapter::open;

const FAMILY: &str = r#"
name = "two masses, and a wall"
[parameters]
omega = { default = 1, above = 0 }
mu = 1
c = 0.1
gr = 0
gw = 0.5
rr = 0.5
rw = 0.5
L = 0
f2 = 0
[system]
frequency = "omega"
mass = [["1", "0"], ["0", "mu"]]
damping = [["2*c", "-c"], ["-c", "2*c"]]
stiffness = [["1.7", "-0.7"], ["-0.7", "1.5"]]
force_sin = ["1", "0"]
force_cos = ["0", "f2"]
load = ["L", "-L"]
[[stop]]
name = "between"
direction = ["1", "-1"]
gap = "gr"
restitution = "rr"
[[stop]]
name = "wall"
direction = ["0", "1"]
gap = "gw"
restitution = "rw"
"#;

const NAMES: [&str; 9] = ["omega", "mu", "c", "gr", "gw", "rr", "rw", "L", "f2"];

/// Places at which an outside simulation found that impacts at both stops accumulate at one instant.
const PLACES: [[f64; 9]; 3] = [
    [
        1.5827828653759721,
        0.29423160040909163,
        0.10205459333115141,
        -0.17767788897867615,
        0.6495461355254983,
        0.6884299843865441,
        0.0,
        0.06381470718119908,
        0.527401990262979,
    ],
    [
        0.5746793582163917,
        0.45824314203549354,
        0.19875253383831754,
        0.2937951211702165,
        0.3834093865458905,
        0.1716023145617111,
        0.381506653395682,
        0.13453671127307545,
        -0.23279799929087752,
    ],
    [
        1.350155358426818,
        0.9834209178039935,
        0.2928715277189926,
        0.3504760237294187,
        0.12918211049254139,
        0.13004080216940345,
        0.12111454667445173,
        0.1267168679463901,
        -0.31148520728231466,
    ],
];

fn system(place: &[f64; 9]) -> System {
    let setting = Setting::defaults(Family::kept(FAMILY, "squeezed.toml").unwrap());
    let set =
        NAMES.iter().zip(place).fold(setting, |setting, (name, &value)| setting.with_named(name, value));
    System::new(set).unwrap()
}

/// (x, v) at phase 0 so many forcing periods later.
fn turned(system: &System, state: &[f64], periods: u32) -> Vec<f64> {
    let flight = Flight::<f64, 2>::new(system);
    let mut trajectory = Trajectory::new(&flight, State::from_slice(state));
    for _ in 0..periods {
        while trajectory.advance(&flight, &mut []).event != Event::Strobe {}
    }
    (0..4).map(|i| trajectory.point.state.get(i)).collect()
}

/// The largest modulus of a multiplier, from differences of trajectories.
fn largest(system: &System, state: &[f64], periods: u32) -> f64 {
    let h = 1e-6;
    let moved = |j: usize, by: f64| {
        let mut state = state.to_vec();
        state[j] += by;
        DVector::from_vec(turned(system, &state, periods))
    };
    let columns: Vec<_> = (0..4).map(|j| (moved(j, h) - moved(j, -h)) / (2.0 * h)).collect();
    let map = DMatrix::from_columns(&columns);
    map.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max)
}

#[test]
fn multipliers_of_squeezed_masses_are_those_of_differences() {
    let schedule = Schedule { transient: 300, observe: 150, max_period: 16, fixed_periods: false };
    for (place, expected) in PLACES.iter().zip([0.210358, 0.082899, 0.116983]) {
        let system = system(place);
        let job = Job { system: system.clone(), start: StateVector::zeros(2) };
        let jobs = std::slice::from_ref(&job);
        let verdict = decide(&Cpu, jobs, &schedule, &Unwatched).unwrap().remove(0);
        assert_eq!(verdict.counts[0..2], [INFINITELY_MANY; 2], "{verdict:?}");
        let Ok(SettledMotion::Strobe(motion)) = SettledMotion::of(&system, &verdict) else {
            panic!("no motion of {verdict:?}")
        };
        let found = motion.multipliers().unwrap()[0].norm();
        let differences = largest(&system, &motion.state, motion.n);
        // Those of an outside simulation.
        assert!((differences - expected).abs() < 1e-4, "{differences}, not {expected}");
        assert!((found - differences).abs() < 1e-5, "{found}, not {differences}");
        let exponent = found.ln() / f64::from(motion.n);
        let spectrum = Spectrum::of(&system, &motion.state, 10, 64).unwrap();
        assert!(
            (spectrum.per_period[0] - exponent).abs() < 1e-4,
            "{:?}, not {exponent}",
            spectrum.per_period
        );
        assert_eq!(
            (spectrum.lost, spectrum.per_period[1]),
            (3, f64::NEG_INFINITY),
            "a shift in time is left"
        );
        let own = f64::from(verdict.lyapunov);
        assert!((own - exponent).abs() < 0.02, "{own}, not {exponent}");
        let theirs = open().run(jobs, &schedule, &Unwatched).unwrap()[0];
        assert_eq!(theirs.label(), verdict.label(), "{theirs:?}");
        assert!((f64::from(theirs.lyapunov) - exponent).abs() < 0.05, "{theirs:?}, not {exponent}");
    }
}

/// Rebounds that are closed together sway the other mass, more or less of them where a deviation changes the first.
#[test]
fn multipliers_of_chatter_are_those_of_differences() {
    let schedule = Schedule { transient: 300, observe: 150, max_period: 4, fixed_periods: false };
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let (mut compared, mut worst): (u32, f64) = (0, 0.0);
    for _ in 0..150 {
        let mut of = |low: f64, high: f64| random.random_range(low..high);
        let system = system(&[
            of(0.4, 1.6),
            of(0.3, 1.5),
            of(0.05, 0.2),
            of(0.0, 0.5),
            of(0.1, 0.8),
            of(0.3, 0.8),
            of(0.3, 0.8),
            of(-0.1, 0.2),
            of(-0.5, 0.5),
        ]);
        let job = Job { system: system.clone(), start: StateVector::zeros(2) };
        let verdict = decide(&Cpu, &[job], &schedule, &Unwatched).unwrap().remove(0);
        if verdict.regime != Regime::PeriodicSticking {
            continue;
        }
        let Ok(SettledMotion::Strobe(motion)) = SettledMotion::of(&system, &verdict) else { continue };
        let found = motion.multipliers().unwrap()[0].norm();
        let differences = largest(&system, &motion.state, motion.n);
        let away = (found - differences).abs() / (1e-2 + differences);
        worst = worst.max(away);
        compared += 1;
        assert!(away < 2e-5, "{found}, not {differences}: {verdict:?} {:?}", system.setting());
    }
    println!("{compared} motions, at most {worst:.1e} away");
    assert!(compared > 40 && worst > 0.0, "{compared}");
}

/// Without restitution at either stop too, whichever of them seems to end it.
#[test]
fn what_is_squeezed_without_restitution_is_squeezed_for_ever() {
    let schedule = Schedule { transient: 300, observe: 150, max_period: 8, fixed_periods: false };
    for (mu, rr, rw) in
        [(1.0, 0.0, 0.0), (0.3, 0.0, 0.0), (1.0, 0.02, 0.02), (1.0, 0.0, 0.02), (3.4, 0.1, 0.0)]
    {
        let mut plant = system(&[1.0, mu, 0.1, 0.0, 0.5, rr, rw, 0.3, 0.0]).plant().clone();
        plant.load[1] = 0.6;
        let system = System::of_plant(plant).unwrap();
        let job = Job { system: system.clone(), start: StateVector::zeros(2) };
        let verdict = decide(&Cpu, &[job], &schedule, &Unwatched).unwrap().remove(0);
        assert_eq!(verdict.counts[0..2], [INFINITELY_MANY; 2], "{mu}, {rr}, {rw}: {verdict:?}");
    }
}

/// What a deviation becomes through the squeeze, by itself.
#[test]
fn a_deviation_passes_a_squeeze_by_its_shift_alone() {
    let system = system(&[1.0, 1.0, 0.1, 0.0, 0.5, 0.1, 0.05, 0.2, 0.0]);
    let flight = Flight::<f64, 2>::new(&system);
    // The second mass rests near the wall, and the first drives it there.
    let start = State { x: [0.2, 0.45], v: [1.5, 0.0] };
    let until = |state: State<f64, 2>, tangents: &mut [Tangent<f64, 2>]| {
        let mut trajectory = Trajectory::new(&flight, state);
        let mut complete = false;
        while let taken = trajectory.advance(&flight, tangents)
            && taken.event != Event::HalfPeriod
        {
            complete |= matches!(taken.event, Event::Caught { complete_chatter: true, beside, .. } if !beside.is_free());
        }
        trajectory.bring_back(&flight, tangents);
        (trajectory.point.state, complete)
    };
    for j in 0..4 {
        let mut along = State::zero();
        if j < 2 {
            along.x[j] = 1.0
        } else {
            along.v[j - 2] = 1.0
        }
        let mut tangents = [Tangent(along)];
        let (_, complete) = until(start, &mut tangents);
        assert!(complete, "the masses are squeezed");
        let h = 1e-6;
        let [after, before] = [h, -h].map(|h| until(start.plus(h, &along), &mut []).0);
        for i in 0..4 {
            let difference = (after.get(i) - before.get(i)) / (2.0 * h);
            let own = tangents[0].0.get(i);
            assert!(
                (own - difference).abs() < 1e-4 * (1.0 + difference.abs()),
                "{i}, {j}: {own}, not {difference}"
            );
        }
    }
}
