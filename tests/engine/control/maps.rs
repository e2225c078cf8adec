//! Maps under control: the GPU's against the CPU's, held to what `validate` demands of a plain map.

use impact_atlas::analysis::{Regime, Schedule, Trace, Verdict};
use impact_atlas::backend::{
    Backend, BackendError, ControlJob, Cpu, CpuSingle, Job, Unwatched, Watch, follow_controlled,
};
use impact_atlas::control::methods::{Convention, PulseSetting, Sign};
use impact_atlas::control::{ControlSchedule, Controller, NEVER, Outcome, Scheme, SectionPoint, Surface};
use impact_atlas::dynamics::{Contact, Event, Stop};
use impact_atlas::model::{Flight, Parameters, State, System};
use impact_atlas::plane::{Control, Plane, RegionMap, Start};
use impact_atlas::sweep::sweep;
use impact_atlas::validate::{Agreement, Thresholds, compare};

use crate::common::adapter::open_exact;

use super::{FIXED_POINT, TARGET, away, delay, gpu, sine, system};

pub fn plane(scheme: Scheme, x: &str, y: &str) -> Plane<Control> {
    Plane {
        x: x.parse().unwrap(),
        y: y.parse().unwrap(),
        parameters: Parameters { omega: 2.83, ..Parameters::default() }.into(),
        start: Start::Rest,
        task: Control {
            scheme,
            schedule: ControlSchedule {
                from: 30,
                iterates: 330,
                fixed: false,
                max_period: ControlSchedule::MAX_PERIOD,
            },
        },
    }
}

/// (x1, x2, v1, v2) at forcing phase 0 beside the unstable 1-2-1 motion: on it, rounding would decide whether it is left.
fn beside_the_motion() -> [f64; 4] {
    beside(&system(), FIXED_POINT)
}

/// The same beside the motion through a point of the section.
pub fn beside(system: &System, point: [f64; 4]) -> [f64; 4] {
    let flight = Flight::<f64, 2>::new(system);
    let surface = Surface::new(system, &flight, Stop::A);
    let mut trajectory = SectionPoint::<f64, 2>::new(&point).trajectory(&flight, &surface, Contact::FREE);
    while trajectory.advance(&flight, &mut []).event != Event::Strobe {}
    let State { x: [x1, x2], v: [v1, v2] } = trajectory.point.state;
    [x1, x2 + 1e-3, v1, v2]
}

/// From a chaotic transient the smallest rounding error decides which motion captures a cell; from the neighbourhood of
/// one, the gain does.
fn feedback() -> Plane<Control> {
    let mut plane = plane(delay(0.5, Sign::Stabilising), "omega=2.81:2.85:11", "gain=0.14:0.5:10");
    plane.start = Start::State(beside_the_motion().into());
    plane.task.schedule =
        ControlSchedule { from: 2, iterates: 2000, fixed: false, max_period: ControlSchedule::MAX_PERIOD };
    plane
}

pub fn map(plane: &Plane<Control>, backend: &dyn Backend) -> RegionMap<Control> {
    sweep(plane, backend, &Unwatched).unwrap()
}

pub fn agreement(plane: &Plane<Control>, candidate: &dyn Backend) -> Agreement {
    compare(&map(plane, &Cpu), &map(plane, candidate))
}

/// With exact arithmetic an adapter and its twin on the CPU have the same bits, whatever the method.
#[test]
fn exact_control_has_the_bits_of_the_twin() {
    let exact = open_exact();
    let pulses =
        Scheme::Pulse(PulseSetting { stop: Stop::A, period: 1, target: TARGET, noise: 1e-4, seed: 1 });
    let planes = [
        plane(delay(0.5, Sign::Stabilising), "omega=2.6:3:6", "gain=0:1:4"),
        plane(sine(Convention::Kick, 0.3, 0.001, 0.01), "omega=2.6:3:6", "delta=0.08:0.12:4"),
        plane(pulses, "target_v1=-0.45:-0.25:6", "target_tau=1.4:2.2:4"),
    ];
    for plane in planes {
        let [there, here] = [&exact as &dyn Backend, &CpuSingle].map(|backend| map(&plane, backend));
        let told = |map: &RegionMap<Control>| {
            map.verdicts.iter().map(|told| format!("{told:?}")).collect::<Vec<_>>()
        };
        let (there, here) = (told(&there), told(&here));
        let differing = there.iter().zip(&here).filter(|(there, here)| there != here).count();
        assert_eq!(differing, 0, "{:?}", plane.task.scheme);
        let distinct: std::collections::HashSet<&String> = here.iter().collect();
        assert!(distinct.len() > here.len() / 2, "{} distinct outcomes", distinct.len());
    }
}

/// The reference with something done to its jobs or in its arithmetic.
#[derive(Debug)]
struct Altered(fn(&ControlJob, &ControlSchedule) -> Outcome);

impl Backend for Altered {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        "altered".to_owned()
    }

    fn tile(&self) -> usize {
        50
    }

    fn run(&self, _: &[Job], _: &Schedule, _: &dyn Watch) -> Result<Vec<Verdict>, BackendError> {
        unreachable!("everything is controlled here")
    }

    fn trace(
        &self,
        _: &[Job],
        _: &Schedule,
        _: impact_atlas::analysis::Probe,
        _: u32,
        _: &dyn Watch,
    ) -> Result<Vec<Trace>, BackendError> {
        unreachable!("everything is controlled here")
    }

    fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &ControlSchedule,
        _: &dyn Watch,
    ) -> Result<Vec<Outcome>, BackendError> {
        Ok(jobs.iter().map(|job| (self.0)(job, schedule)).collect())
    }
}

fn single_precision(job: &ControlJob, schedule: &ControlSchedule) -> Outcome {
    follow_controlled::<f32>(job, schedule).unwrap()
}

fn restitution_a_little_low(job: &ControlJob, schedule: &ControlSchedule) -> Outcome {
    let parameters = job.job.system.parameters();
    let system = System::new(Parameters { r: parameters.r - 1e-3, ..parameters }).unwrap();
    follow_controlled::<f64>(
        &ControlJob { job: Job { system, start: job.job.start }, controller: job.controller },
        schedule,
    )
    .unwrap()
}

fn feedback_forgotten(job: &ControlJob, schedule: &ControlSchedule) -> Outcome {
    follow_controlled::<f64>(
        &ControlJob { job: job.job.clone(), controller: Controller::None(Stop::A) },
        schedule,
    )
    .unwrap()
}

#[test]
fn feedback_agrees_on_cpu_and_gpu() {
    let plane = feedback();
    let (ours, theirs) = (map(&plane, &Cpu), map(&plane, gpu()));
    let agreement = compare(&ours, &theirs);
    assert!(
        agreement.holds(&Thresholds::default()),
        "{:#?}\n{:?}",
        agreement.checks(&Thresholds::default()),
        agreement.worst
    );
    assert!(agreement.inside.cells > 40, "too few cells to compare: {:?}", agreement.inside);
    let both = ours.verdicts.iter().zip(&theirs.verdicts);
    let of = |label: &str| ours.verdicts.iter().filter(|o| o.verdict.label() == label).count();
    assert!(of("1-2-1") > 40 && of("2-4-2") > 15, "{} and {}", of("1-2-1"), of("2-4-2"));
    let times: Vec<f64> = both
        .filter(|(a, b)| [a, b].map(|o| o.verdict.label()) == ["1-2-1", "1-2-1"])
        .map(|(a, b)| f64::from(a.converged_at) - f64::from(b.converged_at))
        .collect();
    let alike = times.iter().filter(|difference| difference.abs() <= 1.0).count();
    assert!(alike as f64 > 0.95 * times.len() as f64, "{times:?}");
    assert!(theirs.verdicts.iter().all(|o| o.converged_at != NEVER || o.period == 0));
}

#[test]
fn what_is_wrong_does_not_agree() {
    let holds = |candidate: fn(&ControlJob, &ControlSchedule) -> Outcome| {
        agreement(&feedback(), &Altered(candidate)).holds(&Thresholds::default())
    };
    assert!(holds(single_precision));
    assert!(!holds(restitution_a_little_low));
    assert!(!holds(feedback_forgotten));
}

fn a_turn_ahead(job: &ControlJob, schedule: &ControlSchedule) -> Outcome {
    let mut outcome = follow_controlled::<f64>(job, schedule).unwrap();
    outcome.section[3] += std::f64::consts::TAU;
    outcome
}

fn half_a_turn_ahead(job: &ControlJob, schedule: &ControlSchedule) -> Outcome {
    let mut outcome = follow_controlled::<f64>(job, schedule).unwrap();
    outcome.section[3] += std::f64::consts::PI;
    outcome
}

#[test]
fn phases_are_compared_the_short_way_round() {
    let pulse = Scheme::Pulse(PulseSetting { stop: Stop::A, period: 1, target: TARGET, noise: 0.0, seed: 1 });
    let plane = plane(pulse, "target_v1=-0.45:-0.25:3", "target_tau=1.4:2.2:3");
    let largest = |candidate| agreement(&plane, &Altered(candidate)).end_state.unwrap().max;
    assert!(largest(a_turn_ahead) < 1e-12);
    assert!(largest(half_a_turn_ahead) > 3.0);
}

#[test]
fn pulses_kicks_and_forces_agree_cell_by_cell() {
    let pulse = Scheme::Pulse(PulseSetting { stop: Stop::A, period: 1, target: TARGET, noise: 0.0, seed: 1 });
    let planes = [
        (plane(pulse, "target_v1=-0.45:-0.25:6", "target_tau=1.4:2.2:4"), 1e-5),
        (plane(sine(Convention::Force, 0.0, 0.0, 0.0), "omega=2.8:2.86:4", "amplitude=-0.46:-0.41:3"), 1e-4),
    ];
    let gpu = gpu();
    for (plane, tolerance) in planes {
        let (ours, theirs) = (map(&plane, &Cpu), map(&plane, gpu));
        for (a, b) in ours.verdicts.iter().zip(&theirs.verdicts) {
            assert_eq!(a.verdict.label(), b.verdict.label(), "{plane:?}\n{a:?}\n{b:?}");
            assert_eq!(a.period, b.period);
            assert!(away(a.section, b.section) < tolerance, "{a:?}\n{b:?}");
            assert!((a.signal - b.signal).abs() < 1e-3 * a.signal.abs(), "{a:?}\n{b:?}");
        }
        let distinct = away(ours.verdicts[0].section, ours.verdicts.last().unwrap().section);
        assert!(distinct > 1e-2, "the plane is one point");
    }
}

#[test]
fn the_kick_agrees_on_where_the_motion_is_held() {
    let mut kicked =
        plane(sine(Convention::Kick, 0.0, 0.0, 0.0), "omega=2.826:2.836:4", "amplitude=0.02:0.3:6");
    kicked.start = Start::State(beside_the_motion().into());
    kicked.task.schedule =
        ControlSchedule { from: 1, iterates: 600, fixed: false, max_period: ControlSchedule::MAX_PERIOD };
    let (ours, theirs) = (map(&kicked, &Cpu), map(&kicked, gpu()));
    let held = |map: &RegionMap<Control>| -> Vec<bool> {
        map.verdicts.iter().map(|outcome| outcome.verdict.label() == "1-2-1").collect()
    };
    assert_eq!(held(&ours), held(&theirs));
    assert!(held(&ours).contains(&true) && held(&ours).contains(&false));
    for (a, b) in ours.verdicts.iter().zip(&theirs.verdicts).filter(|(a, _)| a.verdict.label() == "1-2-1") {
        assert!(away(a.section, b.section) < 1e-5, "{a:?}\n{b:?}");
    }
}

#[test]
fn forces_that_the_gpu_does_not_have_are_refused() {
    let local = plane(sine(Convention::ForceLocal, 0.1, 0.0, 0.0), "omega=2.8:2.86:2", "delta=0.1:0.2:2");
    let refused = sweep(&local, gpu(), &Unwatched).unwrap_err().to_string();
    assert!(refused.contains("--backend cpu"), "{refused}");
    assert_eq!(map(&local, &Cpu).verdicts.len(), 4);
}

#[test]
fn outcomes_do_not_depend_on_tiles_or_threads() {
    let plane = plane(delay(0.5, Sign::Stabilising), "omega=2.6:3:7", "gain=0:1:5");
    let whole = map(&plane, &Cpu);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let in_tiles = pool
        .install(|| map(&plane, &Altered(|job, schedule| follow_controlled::<f64>(job, schedule).unwrap())));
    // As text, in which NaN equals NaN: an exponent that was not measured.
    assert_eq!(format!("{:?}", whole.verdicts), format!("{:?}", in_tiles.verdicts));
}

/// At δ = 0 there is nothing to control: such cells are unresolved, and the others stay in their places.
#[test]
fn cells_without_anything_to_control_are_left_out() {
    let feedback = delay(0.5, Sign::Stabilising);
    let whole = map(&plane(feedback, "omega=2.6:3:5", "delta=0:0.2:3"), &Cpu);
    let without = map(&plane(feedback, "omega=2.6:3:5", "delta=0.1:0.2:2"), &Cpu);
    for column in 0..5 {
        let left_out = whole.at(column, 0);
        assert_eq!((left_out.verdict.regime, left_out.iterates), (Regime::Unresolved, 0));
        for row in 0..2 {
            let (there, alone) = (whole.at(column, row + 1), without.at(column, row));
            assert_eq!(format!("{there:?}"), format!("{alone:?}"), "column {column}, row {row}");
        }
    }
    assert!(without.verdicts.iter().any(|outcome| outcome.iterates > 0));
}

#[test]
fn planes_that_cannot_be_controlled_are_refused() {
    let refused = |plane: Plane<Control>| sweep(&plane, &Cpu, &Unwatched).unwrap_err().to_string();
    let feedback = delay(0.5, Sign::Stabilising);
    let pulse = Scheme::Pulse(PulseSetting { stop: Stop::A, period: 1, target: TARGET, noise: 0.0, seed: 1 });
    assert!(refused(plane(feedback, "gain=0.1:1.5:4", "omega=2.8:3:2")).contains("gain = 1.5"));
    assert!(
        refused(plane(feedback, "alpha=0.1:0.5:4", "omega=2.8:3:2")).contains("delay has no setting alpha")
    );
    assert!(refused(plane(pulse, "period=0:3:4", "omega=2.8:3:2")).contains("period = 0"));
    assert!(refused(plane(feedback, "gain=0.1:0.5:4", "gain=0.1:0.5:4")).contains("both axes"));
    let mut nowhere = plane(pulse, "zeta=0.1:0.2:2", "r=0.7:0.8:2");
    nowhere.task.scheme = Scheme::Pulse(PulseSetting {
        stop: Stop::A,
        period: 1,
        target: impact_atlas::control::Target { reference: 0.3, ..TARGET },
        noise: 0.0,
        seed: 1,
    });
    assert!(refused(nowhere).contains("reference"));
    assert!("period=1:2:3".parse::<impact_atlas::plane::Axis>().unwrap_err().to_string().contains("whole"));
}
