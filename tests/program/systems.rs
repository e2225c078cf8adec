//! Every command for systems other than the paper's, from outside: numbers that were published or follow by hand.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use npyz::NpyFile;
use serde_json::Value;
use tempfile::tempdir;
use zip::ZipArchive;

use crate::run::{json, refuses, run, run_in, stderr, stdout};

/// The impact oscillator of the COCO book: a stop at x = 1, force cos t.
const COCO: &str = r#"
name = "Impact oscillator"
[parameters]
c = 0.1
e = { default = 0.8, at_least = 0, at_most = 1 }
[system]
frequency = 1
mass = [["1"]]
damping = [["c"]]
stiffness = [["1"]]
force_cos = ["1"]
[[stop]]
name = "wall"
direction = ["1"]
gap = 1
restitution = "e"
"#;

/// Four stops on three masses, one of them between two masses; no mirror.
const FOUR_STOPS: &str = r#"
name = "Three masses among four stops"
label_order = ["low", "high", "left", "between"]
[parameters]
omega = { default = 1.75, symbol = "ω", about = "forcing frequency", above = 0 }
gap = { default = 0.3, about = "distance of the outer stops" }
[system]
frequency = "omega"
mass = [["1", "0", "0"], ["0", "0.8", "0"], ["0", "0", "1.3"]]
damping = [["0.3", "-0.1", "0"], ["-0.1", "0.3", "-0.1"], ["0", "-0.1", "0.3"]]
stiffness = [["2", "-1", "0"], ["-1", "2", "-1"], ["0", "-1", "2"]]
force_sin = ["1", "0.3", "0"]
force_cos = ["0", "0", "0.9"]
[[stop]]
name = "high"
direction = ["0", "1", "0"]
gap = "gap"
restitution = 0.8
[[stop]]
name = "low"
direction = ["0", "-1", "0"]
gap = "gap"
restitution = 0.7
[[stop]]
name = "between"
direction = ["1", "0", "-1"]
gap = 0.4
restitution = 0.9
[[stop]]
name = "left"
direction = ["-1", "0", "0"]
gap = 0.5
restitution = 0.6
"#;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance * (1.0 + b.abs()));
    assert!(found.len() == expected.len() && near, "{found:?} and not {expected:?}");
}

fn of_file(text: &str, command: &str) -> Value {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), text).unwrap();
    json(&run_in(folder.path(), &words(command)))
}

fn words(command: &str) -> Vec<&str> {
    command.split_whitespace().collect()
}

/// Velocity before impact, phase, trace and determinant of the return map.
fn return_map(e: f64) -> Vec<f64> {
    let found = of_file(COCO, &format!("motion --system own.toml --set e={e} --label 1-1 --json"));
    assert_eq!((&found["label"], &found["stable"]), (&"1-1".into(), &true.into()));
    assert_eq!((numbers(&found["impacts_per_stop"]), &found["section_stop"]), (vec![1.0], &"wall".into()));
    assert_eq!(found["section_names"].as_array().unwrap(), &["v1", "tau"]);
    let section = numbers(&found["section"]);
    let pairs: Vec<Vec<f64>> = found["multipliers"].as_array().unwrap().iter().map(numbers).collect();
    let [a, b] = [&pairs[0], &pairs[1]];
    vec![-section[0] / e, section[1], a[0] + b[0], a[0] * b[0] - a[1] * b[1]]
}

#[test]
fn the_published_impact_oscillator() {
    let published = [1.69573293759, 0.0759521649383, -1.16859062868, 0.341432378298];
    close(&return_map(0.8), &published, 1e-10);
    let other = return_map(0.8001);
    assert!(other.iter().zip(published).all(|(a, b)| (a - b).abs() > 1e-8), "the check can fail: {other:?}");
}

/// The same motion on either back end.
#[test]
fn the_published_impact_oscillator_is_followed_on_both_back_ends() {
    for backend in ["cpu", "gpu"] {
        let command = format!("classify --system own.toml --start rest --backend {backend} --json");
        let found = of_file(COCO, &command);
        assert_eq!((&found["label"], numbers(&found["impacts_per_stop"])), (&"1-1".into(), vec![1.0]));
        close(&[found["peak_impact_velocity"].as_f64().unwrap()], &[1.69573293759], 1e-5);
        let exponent = found["lyapunov"].as_f64().unwrap();
        close(&[exponent], &[0.5 * 0.341432378298_f64.ln()], 2e-3);
    }
}

/// The ball on the table doubles its period where its 1-1 motion has a multiplier −1, and begins where it has +1.
#[test]
fn the_ball_doubles_its_period_where_it_should() {
    for (e, begins, doubles) in [(0.5_f64, std::f64::consts::FRAC_PI_3, 1.526824), (0.8, PI / 9.0, 1.070836)]
    {
        let exists = PI * (1.0 - e) / (1.0 + e);
        let doubling = exists.hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2));
        close(&[exists, doubling], &[begins, doubles], 1e-6);
        let leading = |gamma: f64| {
            let command =
                format!("motion --system bouncing-ball --set r={e} --set Gamma={gamma} --label 1-1 --json");
            let found = json(&run(&words(&command)));
            let speed = 2.0 * PI * e / (1.0 + e);
            close(&[numbers(&found["section"])[0]], &[speed], 1e-9);
            numbers(&found["multipliers"][0])
        };
        close(&leading(doubling), &[-1.0, 0.0], 1e-6);
        assert!(leading(doubling * 1.001)[0] < -1.0 && leading(doubling * 0.999)[0] > -1.0);
        let none = run(&words(&format!(
            "motion --system bouncing-ball --set r={e} --set Gamma={} --label 1-1",
            0.98 * exists
        )));
        assert_eq!(none.status.code(), Some(1), "{}", stderr(&none));
    }
}

/// 2n exponents, whose sum is the contraction of free flight and the impacts' share.
#[test]
fn exponents_add_up_for_every_family() {
    for (system, set, n, stops) in [
        ("shaw-holmes", "zeta=0.05", 1, 1),
        ("bouncing-ball", "r=0.9", 1, 1),
        ("impact-pair", "nu=1.2", 1, 2),
        ("two-sided", "omega=1.3", 1, 2),
        ("colliding-pair", "omega=1.7", 2, 1),
        ("impact-damper", "delta=2", 2, 2),
        ("three-mass-chain", "delta=0.2", 3, 2),
    ] {
        let command = format!("lyapunov --system {system} --set {set} --transient 200 --observe 800 --json");
        let found = json(&run(&words(&command)));
        let per_stop = numbers(&found["impacts_per_stop"]);
        assert_eq!((found["exponents_per_period"].as_array().unwrap().len(), per_stop.len()), (2 * n, stops));
        assert!(per_stop[0] > 100.0 && found["lost_directions"] == 0, "{system}: {found}");
        let [sum, identity] = ["sum_per_period", "sum_identity"].map(|key| found[key].as_f64().unwrap());
        assert!((sum - identity).abs() < 1e-8, "{system}: {sum} {identity}");
        assert!(identity.abs() > 1e-3, "the check can fail");
    }
    let found = of_file(FOUR_STOPS, "lyapunov --system own.toml --transient 100 --observe 320 --json");
    assert_eq!(
        (found["exponents_per_time"].as_array().unwrap().len(), numbers(&found["impacts_per_stop"]).len()),
        (6, 4)
    );
}

/// A free mass between two walls: symmetric motion with v+ and phase from half a period of flight.
#[test]
fn symmetric_motions_have_a_closed_form_where_there_is_a_mirror() {
    let (nu, r) = (1.5, 0.6);
    let found =
        json(&run(&words(&format!("symmetric --system impact-pair --set nu={nu} --set r={r} --json"))));
    let solutions = found["solutions"].as_array().unwrap();
    assert_eq!(solutions.len(), 2);
    for solution in solutions {
        // y(t) = nu + v t + cos(tau) t + sin(tau) − sin(tau + t), at t = π it is −nu, and v− = v + 2 cos(tau), v+ = −r v−
        // turned over.
        let [v, tau] = numbers(&solution["section"])[..] else { panic!("{solution}") };
        let arrives = nu + v * PI + PI * tau.cos() + 2.0 * tau.sin();
        close(&[arrives, -r * (v + 2.0 * tau.cos())], &[-nu, -v], 1e-10);
        assert_eq!(solution["section_names"].as_array().unwrap(), &["v1", "tau"]);
        assert_eq!(
            (&solution["label"], numbers(&solution["impacts_per_stop"])),
            (&"1-1-1".into(), vec![1.0, 1.0])
        );
        let product: f64 = solution["half_multipliers"]
            .as_array()
            .unwrap()
            .iter()
            .map(|pair| {
                let pair = numbers(pair);
                pair[0].hypot(pair[1])
            })
            .product();
        close(&[product], &[r * r], 1e-9);
    }
    for (command, n) in
        [("two-sided --set beta=1", 1), ("three-mass-chain", 3), ("impact-damper --set delta=1", 2)]
    {
        let found = json(&run(&words(&format!("symmetric --system {command} --json"))));
        for solution in found["solutions"].as_array().unwrap() {
            assert_eq!(solution["multipliers"].as_array().unwrap().len(), 2 * n, "{command}");
            assert!(solution["residual"].as_f64().unwrap() < 1e-9);
        }
        assert_eq!(found["solutions"].as_array().unwrap().len(), 2, "{command}: {found}");
    }
    for system in ["two-sided", "shaw-holmes", "bouncing-ball", "colliding-pair"] {
        refuses(&["symmetric", "--system", system], &["no mirror that exchanges two stops"]);
    }
}

/// Motions named by all their stops, found and solved; a trajectory that starts on one stays on it.
#[test]
fn motions_between_four_stops_are_solved() {
    let found = of_file(FOUR_STOPS, "motion --system own.toml --json");
    let label = found["label"].as_str().unwrap().to_owned();
    let per_stop = numbers(&found["impacts_per_stop"]);
    let counts: Vec<f64> = label.split('-').skip(1).map(|part| part.parse().unwrap()).collect();
    assert_eq!(counts, [1, 0, 3, 2].map(|stop: usize| per_stop[stop]), "{label}");
    assert_eq!((found["multipliers"].as_array().unwrap().len(), found["stable"].as_bool()), (6, Some(true)));
    let again = of_file(FOUR_STOPS, &format!("motion --system own.toml --label {label} --json"));
    // A stop that is struck twice has two sections: the motion is known by its state at phase 0.
    close(&numbers(&again["state"]), &numbers(&found["state"]), 1e-8);
    let state: Vec<String> = numbers(&found["state"]).iter().map(f64::to_string).collect();
    let state = state.join(",");
    let n = found["n"].as_u64().unwrap();
    let command = format!(
        "orbit --system own.toml --start={state} --transient 0 --periods {n} --samples 1 --trajectory -"
    );
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), FOUR_STOPS).unwrap();
    let table = stdout(&run_in(folder.path(), &words(&command)));
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("time,x1,x2,x3,v1,v2,v3"));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    close(&rows.last().unwrap()[1..], &rows[0][1..], 1e-8);
}

#[test]
fn labels_have_a_number_for_every_stop() {
    refuses(
        &["motion", "--system", "bouncing-ball", "--label", "1-1-1"],
        &["`1-1-1`", "N-p ", "at stop A, x1 = 0"],
    );
    refuses(&["motion", "--system", "impact-pair", "--label", "1-1"], &["N-p-q", "x1 = -nu"]);
    refuses(&["motion", "--system", "shaw-holmes", "--label", "1-0"], &["without impact"]);
    refuses(&["lyapunov", "--system", "shaw-holmes", "--start", "0,0,0,0"], &["4 components", "has 2"]);
}

fn array<T: npyz::Deserialize>(path: &Path, name: &str) -> (Vec<u64>, Vec<T>) {
    let mut zip = ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let array = NpyFile::new(zip.by_name(&format!("{name}.npy")).unwrap()).unwrap();
    (array.shape().to_vec(), array.into_vec::<T>().unwrap())
}

fn config(path: &Path) -> Value {
    let mut zip = ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let array = NpyFile::new(zip.by_name("config.npy").unwrap()).unwrap();
    serde_json::from_str(&array.into_vec::<String>().unwrap()[0]).unwrap()
}

/// Sections of any stop and readings of any component, the same on both back ends, with 2n exponents.
#[test]
fn diagrams_are_read_at_any_stop() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), FOUR_STOPS).unwrap();
    let read = |backend: &str, probe: &str, more: &str| {
        let command = format!(
            "bifurcation --system own.toml --x omega=1.72:1.78:5 --backend {backend} {probe} {more} --transient 300 \
             --observe 24 --out d.svg --force"
        );
        let output = run_in(folder.path(), &words(&command));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let path = folder.path().join("d.npz");
        (array::<f64>(&path, "readings").1, array::<u8>(&path, "regime").1)
    };
    for probe in [
        "--section between --record v_before",
        "--section left --record v3",
        "--section low --record gap.high",
        "--section high --record speed.between",
        "--section strobe --record x3",
    ] {
        let (ours, regimes) = read("cpu", probe, "");
        let (theirs, _) = read("gpu", probe, "");
        assert!(regimes.iter().all(|&regime| regime == 2), "{regimes:?}");
        assert!(!ours.is_empty(), "{probe}");
        close(&theirs, &ours, 1e-4);
        let (others, _) = read("cpu", probe, "--set gap=0.31");
        assert!(
            others.len() != ours.len() || others.iter().zip(&ours).any(|(a, b)| (a - b).abs() > 1e-3),
            "{probe}"
        );
    }
    read("cpu", "--section between", "--spectrum");
    let path = folder.path().join("d.npz");
    assert_eq!(array::<f64>(&path, "spectrum").0, [1, 5, 6]);
    assert_eq!(array::<f64>(&path, "state").0, [1, 5, 6]);
    assert_eq!(array::<u16>(&path, "impacts_per_stop").0, [1, 5, 4]);
    let config = config(&path);
    assert_eq!(
        (&config["probe"]["section"], &config["system"]["text"]),
        (&"between".into(), &FOUR_STOPS.into())
    );
    let picture = fs::read_to_string(folder.path().join("d.svg")).unwrap();
    assert!(picture.contains("forcing frequency") && picture.contains("impacts at"), "{picture}");
    let bad = |probe: &[&str], parts: &[&str]| {
        refuses(
            &[&["bifurcation", "--system", "three-mass-chain", "--x", "omega=1:2:3"], probe].concat(),
            parts,
        );
    };
    bad(&["--section", "C"], &["`C`", "A (impacts at x2 = +delta)", "B (impacts at x2 = -delta)", "strobe"]);
    bad(&["--record", "x4"], &["`x4`", "x3", "gap.B"]);
    bad(&["--section", "strobe", "--record", "tau"], &["tau", "strobe section"]);
}

/// The single-sided oscillator, its tables and its figure: every impact is at the stop, and turned back by r.
#[test]
fn orbits_of_every_family_are_recorded_and_drawn() {
    for (system, header) in [
        ("shaw-holmes", "time,stop,velocity_before,velocity_after,phase"),
        ("bouncing-ball", "time,stop,velocity_before,velocity_after,phase"),
        ("impact-damper", "time,stop,velocity_before,velocity_after,x1,x2,v1,v2,phase"),
        ("three-mass-chain", "time,stop,velocity_before,velocity_after,x1,x3,v1,v3,phase"),
    ] {
        let folder = tempdir().unwrap();
        let command = format!(
            "orbit --system {system} --transient 100 --periods 20 --impacts i.csv --out o.svg --panel portrait --panel time \
             --panel section:tau,v_after --panel strobe --panel time:gap.A --panel portrait:gap.A,speed.A"
        );
        let output = run_in(folder.path(), &words(&command));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let place = stdout(&output);
        assert!(place.contains("at stop A ("), "{place}");
        let table = fs::read_to_string(folder.path().join("i.csv")).unwrap();
        let mut lines = table.lines();
        assert_eq!(lines.next(), Some(header));
        let r = if system == "bouncing-ball" { 0.5 } else { 0.8 };
        let mut count = 0;
        for line in lines {
            let fields: Vec<&str> = line.split(',').collect();
            let [before, after] = [2, 3].map(|i| fields[i].parse::<f64>().unwrap());
            assert!((after + r * before).abs() < 1e-12, "{line}");
            if system == "impact-damper" {
                let [x1, x2] = [4, 5].map(|i| fields[i].parse::<f64>().unwrap());
                let sign = if fields[1] == "A" { 1.0 } else { -1.0 };
                assert!((sign * (x2 - x1) - 3.0).abs() < 1e-12, "{line}");
            }
            count += 1;
        }
        assert!(count > 5, "{system}: {count}");
        let picture = fs::read_to_string(folder.path().join("o.svg")).unwrap();
        assert!(picture.contains("distance left to stop A") && picture.contains("velocity towards stop A"));
        let config = picture.split("impact-atlas orbit ").nth(1).unwrap();
        assert!(config.starts_with(&format!("--system {system}")), "{config}");
    }
}

#[test]
fn certified_maps_have_2n_multipliers() {
    for (plane, n) in [
        ("--system shaw-holmes --set zeta=0.1 --x omega=2.5:3:4 --y sigma=0:0.1:3", 1),
        ("--system two-sided --x omega=1:2:4 --y delta=0.2:0.4:3", 1),
        ("--system three-mass-chain --x omega=1:2:4 --y delta=0.2:0.4:3", 3),
    ] {
        let folder = tempdir().unwrap();
        let command = format!("map --certify --backend cpu {plane} --out m.png");
        let output = run_in(folder.path(), &words(&command));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let path = folder.path().join("m.npz");
        let (shape, multipliers) = array::<f64>(&path, "multipliers");
        assert_eq!(shape, [3, 4, 2 * n, 2]);
        let regimes = array::<u8>(&path, "regime").1;
        let exponents = array::<f32>(&path, "lyapunov").1;
        let periods = array::<u16>(&path, "n").1;
        let mut periodic = 0;
        for (cell, pairs) in multipliers.chunks(4 * n as usize).enumerate() {
            assert_eq!(pairs[0].is_nan(), !matches!(regimes[cell], 2 | 3), "{plane}, cell {cell}");
            if !pairs[0].is_nan() {
                let exponent = pairs[0].hypot(pairs[1]).ln() / f64::from(periods[cell]);
                close(&[f64::from(exponents[cell])], &[exponent], 1e-5);
                periodic += 1;
            }
        }
        assert!(periodic > 2, "{plane}: {periodic}");
        let config = config(&path);
        assert_eq!(config["certified"], true);
        assert!(config["system"]["hash"].as_str().unwrap().len() == 64);
    }
}

#[test]
fn help_names_what_the_system_has() {
    let help = |arguments: &[&str]| stdout(&run(arguments));
    for command in ["motion", "lyapunov", "symmetric", "orbit", "bifurcation", "classify", "map"] {
        let text = help(&[command, "--system", "two-sided", "--help"]);
        for part in ["beta = 2", "stop B: x1 = -beta*delta", "labels: N-p-q, impacts at A, B", "x1,v1"] {
            assert!(text.contains(part), "{command}: no `{part}` in {text}");
        }
        assert!(!help(&[command, "--help"]).contains("beta = 2"));
    }
    assert!(help(&["motion", "--system=luo-ma-lv", "-h"]).contains("impacts at B, A"));
}

/// Without a mirror there is no symmetric motion to begin on, and what begins at rest says so.
#[test]
fn systems_without_a_mirror_begin_at_rest_and_say_so() {
    let text = stdout(&run(&words("classify --system bouncing-ball")));
    assert!(text.contains("1-∞") && text.contains("start                       rest: x1 0.0"), "{text}");
    assert!(text.contains("minus infinity: every deviation is forgotten"), "{text}");
    let found = json(&run(&words("classify --system bouncing-ball --json")));
    assert!(found["lyapunov"].is_null(), "{found}");
    let mirrored = stdout(&run(&words("classify --system impact-pair")));
    assert!(mirrored.contains("start                       symmetric: "), "{mirrored}");
    let plane = "--x Gamma=1.2:1.7:20 --y r=0.4:0.6:15 --transient 100 --observe 40 --backend cpu";
    let curves = |more: &str| run(&words(&format!("curves --system bouncing-ball {plane} {more}")));
    let [rest, thrown] = ["", "--start 0,2"].map(curves);
    assert!(stderr(&rest).contains("motions to which rest does not lead have no curve"), "{}", stderr(&rest));
    assert!(!stderr(&thrown).contains("begins at rest"), "{}", stderr(&thrown));
    assert!(stdout(&thrown).contains("period doubling of 1-1 "), "{}", stdout(&thrown));
}

/// p and q are the first two counts of the label, for every command that has them.
#[test]
fn counts_named_p_and_q_are_those_of_the_label() {
    let motion = json(&run(&words("motion --system bouncing-ball --set Gamma=1.6 --label 1-1 --json")));
    assert_eq!((&motion["p"], &motion["q"]), (&1.into(), &0.into()), "{motion}");
    let classified = json(&run(&words("classify --system bouncing-ball --json")));
    let stuck = json(&run(&words("motion --system bouncing-ball --json")));
    for found in [classified, stuck] {
        assert_eq!((&found["p"], &found["q"]), (&65535.into(), &0.into()), "{found}");
    }
    let paper = json(&run(&words("motion --set omega=2.83 --label 1-2-1 --json")));
    assert_eq!((&paper["p"], &paper["q"]), (&2.into(), &1.into()), "{paper}");
}

/// The published impact oscillator as the relative motion of two masses that nothing ties to the ground, and that fall together.
fn adrift() -> String {
    let joint = |of: &str| format!("[[\"{of}\", \"-{of}\"], [\"-{of}\", \"{of}\"]]");
    COCO.replace("[[\"1\"]]\ndamping", "[[2, 0], [0, 2]]\ndamping")
        .replace("[[\"c\"]]", &joint("c"))
        .replace("[[\"1\"]]", &joint("1"))
        .replace("force_cos = [\"1\"]", "force_cos = [2, 0]\nload = [0.5, 0.5]")
        .replace("direction = [\"1\"]", "direction = [1, -1]")
}

#[test]
fn masses_that_drift_together_are_known_by_their_relative_motion() {
    let text = adrift();
    let found = of_file(&text, "motion --system own.toml --label 1-1 --json");
    assert_eq!((&found["label"], &found["stable"]), (&"1-1".into(), &true.into()));
    let pairs: Vec<Vec<f64>> = found["multipliers"].as_array().unwrap().iter().map(numbers).collect();
    let [a, b] = &pairs[..] else { panic!("{pairs:?}") };
    let [trace, determinant] = [a[0] + b[0], a[0] * b[0] - a[1] * b[1]];
    close(&[trace, determinant], &[-1.16859062868, 0.341432378298], 1e-10);
    for backend in ["cpu", "gpu"] {
        let found =
            of_file(&text, &format!("classify --system own.toml --start rest --backend {backend} --json"));
        assert_eq!(found["label"], "1-1", "{backend}");
        close(&[found["peak_impact_velocity"].as_f64().unwrap()], &[1.69573293759], 1e-5);
        close(&[found["lyapunov"].as_f64().unwrap()], &[0.5 * 0.341432378298_f64.ln()], 2e-3);
    }
    let spectrum = of_file(&text, "lyapunov --system own.toml --start rest --json");
    let exponents = numbers(&spectrum["exponents_per_period"]);
    let identity = spectrum["sum_identity"].as_f64().unwrap();
    close(&[exponents.len() as f64, exponents.iter().sum()], &[2.0, identity], 1e-6);

    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), &text).unwrap();
    let command = "orbit --system own.toml --start rest --transient 0 --periods 100 --trajectory t.csv";
    stdout(&run_in(folder.path(), &words(command)));
    let table = fs::read_to_string(folder.path().join("t.csv")).unwrap();
    let last: Vec<f64> = table.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    // The masses as a whole fall for 100 periods with an acceleration of ¼; what forces one of them is back where it began.
    let fallen = 0.5 * 0.25 * (200.0 * PI).powi(2);
    close(&[0.5 * (last[1] + last[2])], &[fallen], 1e-9);
    assert!((last[1] - last[2]).abs() < 2.0, "{last:?}");

    // What is left out of arrays that have room for it, and read again.
    let plane =
        "--x e=0.78:0.82:3 --y c=0.09:0.11:2 --start rest --backend cpu --certify --data m.npz --out m.png";
    stdout(&run_in(folder.path(), &words(&format!("map --system own.toml {plane}"))));
    let (shape, multipliers) = array::<f64>(&folder.path().join("m.npz"), "multipliers");
    assert_eq!(shape, [2, 3, 4, 2]);
    for (i, value) in multipliers.iter().enumerate() {
        assert_eq!(value.is_nan(), i / 4 % 2 == 1, "{multipliers:?}");
    }
    stdout(&run_in(folder.path(), &words("render m.npz --out again.png")));
    let diagram = "--x c=0.09:0.11:2 --backend cpu --spectrum --data d.npz --out d.svg";
    stdout(&run_in(folder.path(), &words(&format!("bifurcation --system own.toml {diagram}"))));
    let (shape, exponents) = array::<f64>(&folder.path().join("d.npz"), "spectrum");
    assert_eq!(shape.last(), Some(&4));
    for (i, value) in exponents.iter().enumerate() {
        assert_eq!(value.is_nan(), i % 4 > 1, "{exponents:?}");
    }
}
