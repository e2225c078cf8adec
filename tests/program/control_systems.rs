//! `control`, `map --control` and `curves` for systems other than the paper's, from outside.

use std::f64::consts::{PI, TAU};
use std::fs;

use tempfile::tempdir;

use crate::run::{json, refuses, run, run_in, stderr, stdout};

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    serde_json::from_value(value.clone()).unwrap()
}

/// The ball at e = 0.5, beyond its period doubling at Γ = 1.526824.
const BALL: [&str; 4] = ["--system", "bouncing-ball", "--set", "Gamma=1.6"];
const THROWN: [&str; 6] = ["--start", "1.5,1.5", "--from", "200", "--iterates", "1200"];

#[test]
fn feedback_holds_the_ball_where_its_period_has_doubled() {
    let ask = |gain: &'static str| {
        json(&run(&[&["control", "delay"], &BALL[..], &THROWN, &["--gain", gain, "--json"]].concat()))
    };
    let held = ask("0.4");
    assert_eq!((&held["label_before"], &held["label_after"]), (&"2-2".into(), &"1-1".into()), "{held}");
    assert_eq!((&held["stop"], &held["section_names"]), (&"A".into(), &serde_json::json!(["v1+", "tau"])));
    let e = 0.5;
    let motion = [TAU * e / (1.0 + e), (PI * (1.0 - e) / (1.0 + e) / 1.6).acos()];
    for (found, known) in numbers(&held["fixed_point"]).iter().zip(motion) {
        assert!((found - known).abs() < 1e-7, "{held}");
    }
    assert_eq!(
        held["multipliers"].as_array().unwrap().len(),
        4,
        "feedback remembers two points of two components"
    );
    assert_ne!(ask("0.02")["label_after"], "1-1", "too little holds nothing");
}

#[test]
fn pictures_name_the_stop_and_the_components() {
    let folder = tempdir().unwrap();
    let chain = ["control", "pulse", "--system", "three-mass-chain", "--stop", "B", "--from", "50"];
    let target =
        ["--iterates", "300", "--target", "0.2,0.05,-0.02,0.1,0.05,2", "--out", "c.svg", "--data", "c.npz"];
    let output = run_in(folder.path(), &[&chain[..], &target].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(said.contains("fixed point     v2+ 0.2") && said.contains("x3 -0.02"), "{said}");
    let svg = fs::read_to_string(folder.path().join("c.svg")).unwrap();
    for words in ["third mass, displacement", "first mass, velocity", "at stop B"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(!svg.contains("second mass, velocity"), "it is the section's own: velocity after impact");
    let mut zip = zip::ZipArchive::new(fs::File::open(folder.path().join("c.npz")).unwrap()).unwrap();
    let section = npyz::NpyFile::new(zip.by_name("section.npy").unwrap()).unwrap();
    assert_eq!(section.shape()[1], 6);
}

#[test]
fn a_force_acts_on_the_coordinate_that_is_named() {
    let forced = |coordinate: &'static str| {
        let pair = [
            "control",
            "sine",
            "--system",
            "colliding-pair",
            "--convention",
            "force",
            "--alpha",
            "0",
            "--target=-0.3",
            "--component",
            "v1+",
        ];
        let rest = [
            "--amplitude",
            "0.15",
            "--coordinate",
            coordinate,
            "--from",
            "50",
            "--iterates",
            "900",
            "--json",
        ];
        json(&run(&[&pair[..], &rest].concat()))
    };
    let [first, second] = ["x1", "2"].map(forced);
    assert_ne!(first["fixed_point"], second["fixed_point"], "{first} {second}");
    let kick = ["control", "sine", "--system", "colliding-pair", "--coordinate", "x2"];
    refuses(&kick, &["--coordinate x2", "kick", "v1+"]);
    refuses(&[&kick[..5], &["x3", "--convention", "force"]].concat(), &["--coordinate `x3`", "x1, x2"]);
}

#[test]
fn maps_are_controlled_at_any_stop_on_both_back_ends() {
    let map = |backend: &'static str| {
        let axes = ["--x", "delta=0.28:0.32:4", "--y", "target_v1=0.5:0.9:3", "--start", "rest"];
        let more = ["--target", "0.7,4", "--stop", "B", "--from", "20", "--iterates", "200", "--json"];
        let asked = [&["map", "--control", "pulse", "--system", "two-sided"], &axes[..], &more];
        json(&run(&[&asked.concat()[..], &["--backend", backend]].concat()))
    };
    let [cpu, gpu] = ["cpu", "gpu"].map(map);
    assert_eq!((&cpu["cells"], &cpu["converged"]), (&12.into(), &12.into()), "{cpu}");
    assert_eq!((&cpu["regimes"], &cpu["escapes"]), (&gpu["regimes"], &gpu["escapes"]), "{cpu} {gpu}");
    let plane =
        ["validate", "--control", "pulse", "--system", "two-sided", "--stop", "B", "--target", "0.7,4"];
    let axes = ["--x", "delta=0.28:0.32:3", "--y", "zeta=0.04:0.06:3", "--start", "rest", "--from", "20"];
    let more = ["--iterates", "200", "--backend", "gpu", "--json"];
    let report = json(&run(&[&plane[..], &axes, &more].concat()));
    assert_eq!(report["holds"], true, "{report}");
}

#[test]
fn what_the_system_does_not_have_is_refused() {
    let ball = |more: &[&'static str]| [&["control", "delay"], &BALL[..], more].concat();
    refuses(&ball(&["--stop", "B"]), &["--stop `B`", "has A"]);
    refuses(&ball(&["--gains", "0.1,0.2,0.3,0.4"]), &["--gains has 4 numbers", "two", "v1+ and tau"]);
    let pulse = [&["control", "pulse"], &BALL[..]].concat();
    refuses(&pulse, &["give the target itself", "v1+, tau"]);
    refuses(&[&pulse[..], &["--target=-0.3,1"]].concat(), &["v1+ = -0.3"]);
    let sine = [&["control", "sine"], &BALL[..], &["--target", "1", "--component", "x2"]].concat();
    refuses(&sine, &["--component `x2`", "stop A", "v1+ and tau"]);
    let map = ["map", "--control", "pulse", "--system", "bouncing-ball", "--target", "-1,1"];
    refuses(&[&map[..], &["--y", "target_x1=0:1:3"]].concat(), &["pulse has no setting target_x1"]);
}

/// The table of `curves` for the ball, held to the formulas of its motion.
#[test]
fn curves_of_the_ball_are_written_down() {
    let folder = tempdir().unwrap();
    let axes = ["curves", "--system", "bouncing-ball", "--x", "r=0.4:0.9:16", "--y", "Gamma=0.2:2.2:20"];
    let more = ["--start", "0,2", "--backend", "cpu", "--out", "c.csv"];
    let output = run_in(folder.path(), &[&axes[..], &more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let table = fs::read_to_string(folder.path().join("c.csv")).unwrap();
    let (mut folds, mut doublings) = (0, 0);
    for row in table.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>()) {
        let [e, gamma] = [row[3], row[4]].map(|value| value.parse::<f64>().unwrap());
        let birth = PI * (1.0 - e) / (1.0 + e);
        match (row[1], row[2]) {
            ("fold", "1-1") => {
                assert!((gamma - birth).abs() < 1e-6, "{row:?}");
                folds += 1;
            }
            ("period doubling", "1-1") => {
                let doubling = birth.hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2));
                assert!((gamma - doubling).abs() < 1e-6, "{row:?}");
                doublings += 1;
            }
            _ => {}
        }
        assert!(row[0].parse::<usize>().is_ok(), "names are the paper's: {row:?}");
    }
    assert!(folds > 50 && doublings > 50, "{folds} {doublings}");
    let map = [
        "map",
        "--system",
        "bouncing-ball",
        "--x",
        "r=0.4:0.9:16",
        "--y",
        "Gamma=0.2:2.2:20",
        "--start",
        "0,2",
    ];
    let drawn = ["--curves", "--backend", "cpu", "--out", "m.svg", "--size", "900x700"];
    let output = run_in(folder.path(), &[&map[..], &drawn].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let svg = fs::read_to_string(folder.path().join("m.svg")).unwrap();
    assert!(svg.contains("\"F 1-1\"") && svg.contains("\"PD 1-1\""));
}
