//! Files that describe no system, from outside: every command refuses them by file, line, key and remedy, and writes nothing.

use std::fs;

use tempfile::tempdir;

use crate::run::{names, run_in, stderr, stdout};

const SOUND: &str = r#"name = "Oscillator before a wall"
[parameters]
omega = { default = 1.3, above = 0 }
c = 0.1
e = { default = 0.8, at_least = 0, at_most = 1 }
wall = 0.4
[system]
frequency = "omega"
mass = [["1"]]
damping = [["c"]]
stiffness = [["1"]]
force_cos = ["1"]
[[stop]]
name = "wall"
direction = ["1"]
gap = "wall"
restitution = "e"
[[stop]]
name = "back"
direction = ["-1"]
gap = "2"
restitution = "e"
[plane]
x = "omega=1:3:3"
y = "wall=0:1:3"
"#;

/// Every command that takes a system.
const COMMANDS: [&str; 11] = [
    "map",
    "classify",
    "orbit",
    "bifurcation --x omega=1:3:3",
    "curves",
    "motion",
    "lyapunov",
    "symmetric",
    "control delay",
    "map --control delay --x omega=1:3:3 --y gain=0:0.5:3",
    "validate",
];

/// Those that go through many systems, one of them at omega = 2 and wall = 0.5.
const PLANES: [&str; 5] = [
    "map",
    "bifurcation --x omega=1:3:3 --set wall=0.5",
    "curves --x omega=1:3:3 --y wall=0:1:3",
    "validate --x omega=1:3:3 --y wall=0:1:3",
    "map --control delay --x omega=1:3:3 --y gain=0:0.5:3 --set wall=0.5",
];

/// Runs a command on the file in which a piece is replaced; what it said, if it did nothing else.
fn refused(text: &str, command: &str) -> String {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), text).unwrap();
    let mut arguments: Vec<&str> = command.split_whitespace().collect();
    arguments.extend(["--system", "own.toml"]);
    let output = run_in(folder.path(), &arguments);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{command}: {said}");
    assert!(!said.contains("panicked") && stdout(&output).is_empty(), "{command}: {said}");
    assert_eq!(names(folder.path()), ["own.toml"], "{command}: {said}");
    said
}

fn broken(piece: &str, by: &str) -> String {
    assert_eq!(SOUND.matches(piece).count(), 1, "{piece}");
    SOUND.replace(piece, by)
}

#[test]
fn every_command_refuses_what_is_no_system() {
    let cases: [(&str, &str, &str, &[&str]); 14] = [
        ("gap = \"wall\"", "gap = \"wal\"", "own.toml:16: stop[1].gap:", &["`wal`", "not a parameter"]),
        ("damping = [[\"c\"]]", "damping = [[\"c\", 0]]", "own.toml:10: system.damping[1]:", &["2 entries"]),
        (
            "mass = [[\"1\"]]",
            "mass = [[\"0\"]]",
            "own.toml:9: system.mass:",
            &["singular", "mass of its own"],
        ),
        (
            "[[\"1\"]]\nforce",
            "[[\"1/(e-e)\"]]\nforce",
            "own.toml:11: system.stiffness[1][1]:",
            &["divides by zero"],
        ),
        ("c = 0.1", "c = nan", "own.toml:4: parameters.c:", &["not a finite number"]),
        ("gap = \"wall\"", "gap = \"sqrt(-wall)\"", "own.toml:16: stop[1].gap:", &["NaN", "wall = 0.4"]),
        ("gap = \"2\"", "gap = \"-wall-0.5\"", "own.toml:21: stop[2].gap:", &["overlap by 0.5"]),
        ("c = 0.1", "c = 0.1\nspare = 1", "own.toml:5: parameters.spare:", &["no expression uses"]),
        ("[system]\n", "", "own.toml:1: system:", &["missing: write"]),
        ("restitution = \"e\"\n[[", "[[", "stop[1].restitution:", &["missing: write restitution"]),
        (
            "mass = [[\"1\"]]",
            "mass = [[1,0,0,0,0],[0,1,0,0,0],[0,0,1,0,0],[0,0,0,1,0],[0,0,0,0,1]]",
            "own.toml:9: system.mass:",
            &["5 coordinates", "1 to 4"],
        ),
        ("[parameters]", "\u{1}PNG", "own.toml:2:", &["not TOML"]),
        (
            "restitution = \"e\"\n[plane]",
            "restitution = 1.5\n[plane]",
            "own.toml:22: stop[2].restitution:",
            &["1.5"],
        ),
        ("x = \"omega=1:3:3\"", "x = \"omga=1:3:3\"", "own.toml:24: plane.x:", &["omga", "omega"]),
    ];
    for (piece, by, place, parts) in cases {
        // The section that is missing takes its keys with it.
        let text = if piece == "[system]\n" {
            let [from, to] = ["[system]", "[[stop]]"].map(|section| SOUND.find(section).unwrap());
            format!("{}{}", &SOUND[..from], &SOUND[to..])
        } else {
            broken(piece, by)
        };
        for command in COMMANDS {
            let said = refused(&text, command);
            for part in parts.iter().chain([&place]) {
                assert!(said.contains(part), "{command}: no `{part}` in {said}");
            }
        }
    }
}

/// What the defaults make is sound, and one cell is not: nothing is computed before that is known.
#[test]
fn every_plane_refuses_a_cell_that_is_no_system() {
    let cases: [(&str, &str, &str, &[&str]); 4] = [
        (
            "[[\"1\"]]\nforce",
            "[[\"1/(omega-2)\"]]\nforce",
            "own.toml:11: system.stiffness[1][1]:",
            &["omega = 2"],
        ),
        (
            "mass = [[\"1\"]]",
            "mass = [[\"(omega-2)^2\"]]",
            "own.toml:9: system.mass:",
            &["singular", "omega = 2"],
        ),
        (
            "damping = [[\"c\"]]",
            "damping = [[\"c*sqrt(1.5-omega)\"]]",
            "own.toml:10: system.damping[1][1]:",
            &["NaN", "omega = "],
        ),
        ("gap = \"2\"", "gap = \"1.45-omega\"", "own.toml:21: stop[2].gap:", &["overlap by", "omega = "]),
    ];
    for (piece, by, place, parts) in cases {
        let text = broken(piece, by);
        for command in PLANES {
            let said = refused(&text, command);
            for part in parts.iter().chain([&place]) {
                assert!(said.contains(part), "{command}: no `{part}` in {said}");
            }
        }
    }
}

/// The file that the others are made of is sound.
#[test]
fn the_sound_file_is_followed() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), SOUND).unwrap();
    for command in ["classify", "motion", "lyapunov --observe 50"] {
        let mut arguments: Vec<&str> = command.split_whitespace().collect();
        arguments.extend(["--system", "own.toml"]);
        let output = run_in(folder.path(), &arguments);
        assert!(matches!(output.status.code(), Some(0 | 1)), "{command}: {}", stderr(&output));
    }
    for name in ["nowhere.toml", "."] {
        let output = run_in(folder.path(), &["classify", "--system", name]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(stderr(&output).contains(name), "{}", stderr(&output));
    }
}
