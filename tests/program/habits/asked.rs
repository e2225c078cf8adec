//! What can be asked for, and what the help says of it.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use crate::habits::SMALL;
use crate::run::{done, json, names, refuses, run, run_in, stderr, stdout, words};

#[test]
fn numbers_are_as_people_write_them() {
    refuses(&words("classify --set mu_m=-1e-100"), &["mu_m = -1e-100 "]);
    refuses(&words("map --x delta=2e-100:2e-100:5"), &["delta=2e-100:2e-100 "]);
    refuses(&words("classify --start 1e-7,0,0,0 --set delta=1e-100"), &["x1 = 1e-7,", "gap is 1e-100"]);
    let folder = tempdir().unwrap();
    let counted = done(
        folder.path(),
        "map --backend cpu --x omega=2.8:3.8:6e0 --y delta=0.1:0.3:4 --transient 2e1 --observe 1e1 --size 4e2x3e2 --json",
    );
    assert_eq!(json(&counted)["cells"], 24);
    refuses(&words("classify --transient 1.5"), &["1.5", "whole number"]);
    refuses(&words("classify --transient 1e3.5"), &["1e3.5", "whole number"]);
    refuses(&words("classify --transient -1"), &["-1"]);
    refuses(&words("curves --cells 1e-3"), &["1e-3"]);
}

#[test]
fn shells_and_manuals_know_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = stdout(&run(&["completions", shell]));
        for word in ["bifurcation", "reproduce", "force", "dead-band"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    let page = stdout(&run(&["man"]));
    assert!(page.contains(".TH impact-atlas 1") && page.contains("bifurcation"), "{page}");
    let page = stdout(&run(&["man", "map"]));
    assert!(page.contains(".TH impact-atlas-map 1") && page.contains(r"\-\-force"), "{page}");
    refuses(&["man", "maps"], &["maps", "bifurcation, "]);
    refuses(&["completions", "tcsh"], &["tcsh", "bash"]);
}

#[test]
fn the_default_back_end_is_what_its_help_says() {
    let help = stdout(&run(&["map", "--help"]));
    let flat = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains("A hardware GPU, otherwise the CPU"), "{help}");
    assert!(!flat.contains("faster"), "{help}");
    let adapters = json(&run(&["adapters", "--json"]));
    let hardware = adapters.as_array().unwrap().iter().any(|adapter| adapter["kind"] == "hardware");
    let found = json(&run(&words("classify --backend auto --json")));
    assert_eq!(found["backend"], if hardware { "gpu" } else { "cpu" });
}

#[test]
fn the_reference_is_not_held_against_itself() {
    refuses(&words("validate --backend cpu --cells 30"), &["--backend cpu", "itself"]);
    refuses(&words("validate --control pulse --backend cpu --cells 4"), &["--backend cpu", "itself"]);
}

/// The command for a worst cell holds the back ends against each other there, and writes nothing.
#[test]
fn the_command_for_a_worst_cell_shows_the_difference() {
    let planes = [
        "validate --x omega=2.4:4.4:5 --y delta=0.05:0.3:4 --transient 1e2 --observe 50 --set mu_c=0.4",
        "validate --control pulse --x target_v1=-0.45:-0.25:3 --y target_tau=1.4:2.2:2 --set omega=2.83 --from 30 \
         --iterates 330",
    ];
    for plane in planes {
        let whole: Value =
            serde_json::from_str(&stdout(&run(&[&words(plane)[..], &["--json"]].concat()))).unwrap();
        let worst = &whole["worst"][0];
        let command = worst["command"].as_str().expect("single precision differs somewhere");
        let folder = tempdir().unwrap();
        let alone = run_in(folder.path(), &[&words(command)[1..], &["--json"]].concat());
        assert!(matches!(alone.status.code(), Some(0 | 1)), "{command}: {}", stderr(&alone));
        assert_eq!(names(folder.path()), [""; 0]);
        let alone: Value = serde_json::from_str(&stdout(&alone)).unwrap();
        assert_eq!(alone["cells"], 1);
        for key in ["x", "y", "reference", "candidate", "difference", "reference_state", "candidate_state"] {
            assert_eq!(alone["worst"][0][key], worst[key], "{command}: {key}");
        }
        assert_ne!(worst["reference_state"], worst["candidate_state"]);
    }
}

#[test]
fn settings_of_a_method_can_be_set_like_parameters() {
    let control =
        |more: &str| format!("control delay --set omega=2.83 --from 200 --iterates 600 --json {more}");
    let option = json(&run(&words(&control("--gain 0.4"))));
    assert_eq!(json(&run(&words(&control("--set gain=0.4")))), option);
    assert_ne!(json(&run(&words(&control("--set gain=0.1")))), option);
    refuses(&words(&control("--set gain=0.4 --gain 0.4")), &["--gain", "--set gain=0.4"]);
    refuses(&words(&control("--set gain=0.4 --set gain=0.3")), &["gain is set twice"]);
    refuses(&words(&control("--set alpha=0.4")), &["--set alpha=0.4", "delay"]);
    refuses(&words(&control("--set delay=1.5")), &["delay=1.5", "whole number"]);
    refuses(&words(&control("--set gain=1.5")), &["gain = 1.5"]);
    refuses(&words("classify --set gain=0.4"), &["gain", "omega, delta"]);
    refuses(&words("map --set gain=0.4"), &["--set gain=0.4", "control"]);
    refuses(
        &words("map --control delay --y gain=0:1:3 --set gain=0.4"),
        &["--set gain=0.4", "--y gain=0:1:3"],
    );
}

/// With a gain of 0 control changes nothing: what returns after 3 forcing periods with 6 impacts at A returns after 6
/// iterates, and not for one who looks for 5.
#[test]
fn the_periods_looked_for_under_control_can_be_chosen() {
    let found = |most: &str| {
        let command =
            "control delay --gain 0 --from 900 --iterates 1500 --json --set omega=0.5 --set delta=0.3";
        json(&run(&words(&format!("{command} --max-period {most}"))))
    };
    let period = found("32")["period"].as_u64().expect("the motion is periodic");
    assert!(period > 1, "{period}");
    assert_eq!(found(&period.to_string())["period"], period);
    assert!(found(&(period - 1).to_string())["period"].is_null());
    refuses(&words("control delay --max-period 0"), &["--max-period", "1 to 32"]);
    refuses(&words("control delay --max-period 33"), &["--max-period", "1 to 32"]);
    refuses(&words("map --control delay --max-period 33"), &["33", "1 to 32"]);
    let device = "map --control delay --x omega=2.8:2.9:2 --y gain=0:1:2 --max-period 9 --backend gpu";
    refuses(&words(device), &["--max-period", "--backend cpu"]);
    let help = stdout(&run(&["map", "--help"])).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("under control, most iterates in one period [default: 8]"), "{help}");
}

/// N = 0 stands in a picture only with what it means.
#[test]
fn a_motion_of_no_forcing_period_is_explained() {
    let folder = tempdir().unwrap();
    let plane = "map --control pulse --backend cpu --set omega=2.83 --x target_v1=-0.45:-0.1:8 --y target_tau=0.1:6.2:8 \
                 --from 30 --iterates 330 --out m.svg";
    done(folder.path(), plane);
    let svg = fs::read_to_string(folder.path().join("m.svg")).unwrap();
    assert!(svg.contains("jump in phase"), "no motion of N = 0, or no word about it");
    done(folder.path(), &format!("{SMALL} --out free.svg"));
    assert!(!fs::read_to_string(folder.path().join("free.svg")).unwrap().contains("jump in phase"));
}
