//! Masses that rebound at several stops by turns, each impact taking them off the contact before: the rebounds accumulate at an instant,
//! at which all contacts hold. No sequence at a single stop ends them, and rounding alone kept them going for ever.

use impact_atlas::analysis::{INFINITELY_MANY, Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, CpuSingle, Job, Unwatched, decide, follow};
use impact_atlas::model::{StateVector, System};
use impact_atlas::system::{Family, Setting};

use crate::common::adapter::open;

/// Two masses, a stop between them without restitution, and an oblique one.
const OBLIQUE: &str = r#"
name = "two masses on two stops"
[parameters]
r = 0
[system]
frequency = 0.7715470754114093
mass = [["1.3836148477311467", "0.1269404287399897"], ["0.1269404287399897", "0.31735107184997424"]]
damping = [["0.0706917705184186", "0"], ["0", "0.2835065641120557"]]
stiffness = [["0.8264323434022862", "0"], ["0", "0"]]
force_sin = ["0", "0.8509088116182113"]
force_cos = ["0", "0.12943252371685077"]
load = ["0.28627505500456785", "0.5794117417254355"]
[[stop]]
name = "A"
direction = ["-1", "1"]
gap = "0.009735618314633213"
restitution = "r"
[[stop]]
name = "B"
direction = ["0.36", "0.86"]
gap = "0.2197276010300272"
restitution = 0.8
"#;

/// Two masses with two stops between them, and a wall.
const WALL: &str = r#"
name = "two masses and a wall"
[parameters]
r = 1
[system]
frequency = 0.44964318918555474
mass = [["0.3137214109166715", "0"], ["0", "0.5976885883050378"]]
damping = [["3.1394966454470183", "-2.6310487812657644"], ["-2.6310487812657644", "2.6310487812657644"]]
stiffness = [["1.250820470360673", "-0.808120340343211"], ["-0.808120340343211", "0.808120340343211"]]
force_sin = ["0.4358377444077206", "0.4139196565221148"]
force_cos = ["0.5294729373461848", "0"]
[[stop]]
name = "A"
direction = ["1", "-1"]
gap = 0.11128916161290117
restitution = 0.6633940009850214
[[stop]]
name = "B"
direction = ["-1", "1"]
gap = 0.15476006591614747
restitution = 0.7809974205244797
[[stop]]
name = "C"
direction = ["1", "0"]
gap = 0.25758132919030463
restitution = "r"
"#;

/// Three masses, two stops that face each other and one beside them without restitution.
const THREE: &str = r#"
name = "three masses on three stops"
[parameters]
r = 0
[system]
frequency = 0.5933391682908363
mass = [["0.41436618990289986", "0", "0"], ["0", "0.3559923178140173", "0"], ["0", "0", "2.617638013405369"]]
damping = [["4.124518567852591", "-1.758936708604044", "0"], ["-1.758936708604044", "3.2227233733398695", "-0.4594304800304937"],
  ["0", "-0.4594304800304937", "0.9580457212066299"]]
stiffness = [["4.323038152984047", "-3.5162266573576035", "0"], ["-3.5162266573576035", "7.977519712877791", "-3.505615453092652"],
  ["0", "-3.505615453092652", "4.278493048666968"]]
force_sin = ["-0.4329583203613794", "-0.06286489150457442", "-0.3472523028367078"]
force_cos = ["0", "0.006651362723872012", "0.6134832436078526"]
load = ["0.07762364721544657", "-0.04860909684053927", "0.10915121567412311"]
[[stop]]
name = "A"
direction = ["0", "1", "0"]
gap = 0.19663166225242323
restitution = "r"
[[stop]]
name = "B"
direction = ["-0.27", "-0.62", "0.5"]
gap = 0
restitution = 0.3161345580679224
[[stop]]
name = "C"
direction = ["0.27", "0.62", "-0.5"]
gap = 0.0013462523573110978
restitution = 0.8
"#;

const LOOK: Schedule = Schedule { transient: 100, observe: 60, max_period: 16, fixed_periods: false };

/// A system from rest, its r as given.
fn job(text: &str, r: f64) -> Job {
    let mut setting = Setting::defaults(Family::kept(text, "joint.toml").unwrap());
    setting = setting.with_named("r", r);
    let system = System::new(setting).unwrap();
    let start = StateVector::zeros(system.coordinates());
    Job { system, start }
}

/// What a back end decides on it.
fn decided(backend: &dyn Backend, text: &str, r: f64) -> Verdict {
    decide(backend, &[job(text, r)], &LOOK, &Unwatched).unwrap().remove(0)
}

/// What it is called.
fn label(verdict: &Verdict) -> (Regime, u16, Vec<u16>) {
    (verdict.regime, verdict.n, verdict.counts.to_vec())
}

#[test]
fn rebounds_at_several_stops_by_turns_end_at_rest_on_all_of_them() {
    for (text, r, beside, n) in [(OBLIQUE, 0.0, 0.1, 3), (WALL, 1.0, 0.999, 1), (THREE, 0.0, 1e-3, 1)] {
        let found = decided(&Cpu, text, r);
        let (regime, own_n, counts) = label(&found);
        assert_eq!((regime, own_n), (Regime::PeriodicSticking, n), "{}", found.label());
        assert!(counts.contains(&INFINITELY_MANY), "{}", found.label());
        // The motion is that of restitutions near by, where single stops end the rebounds.
        let near = decided(&Cpu, text, beside);
        assert_eq!(label(&near), label(&found), "{} beside {}", near.label(), found.label());
        let single = decided(&CpuSingle, text, r);
        assert_eq!(label(&single), label(&found), "{} in single precision", single.label());
    }
}

#[test]
fn the_kernel_brings_them_to_rest() {
    let gpu = open();
    for (text, r) in [(OBLIQUE, 0.0), (WALL, 1.0)] {
        let [here, there] = [&Cpu as &dyn Backend, &gpu].map(|backend| decided(backend, text, r));
        assert_eq!(label(&here), label(&there), "{} and {}", here.label(), there.label());
    }
}

#[test]
fn they_end_where_an_outside_simulation_of_every_rebound_does() {
    let schedule = Schedule { transient: 2, observe: 1, max_period: 1, fixed_periods: true };
    let known = [-0.681607, -0.792888, 1.284471, 1.284473];
    let found = follow::<f64>(&job(WALL, 1.0), &schedule).state;
    let away = |state: &StateVector| {
        state.iter().zip(known).map(|(found, known)| (found - known).abs()).fold(0.0, f64::max)
    };
    assert!(away(&found) < 2e-5, "{found:?}");
    let other = WALL.replace("0.44964318918555474", "0.45");
    assert!(away(&follow::<f64>(&job(&other, 1.0), &schedule).state) > 1e-4, "the check can fail");
}
