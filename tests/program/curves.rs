//! `curves` and `map --curves` from outside: tables, JSON, names, refusals.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;
use tempfile::tempdir;

use crate::run::program;

/// A part of the paper's plane that has all of its curves.
const PAPER: [&str; 8] =
    ["--backend", "cpu", "--x", "omega=1:3.8:80", "--y", "delta=0.06:0.7:50", "--transient", "150"];

/// A plane of two other parameters.
const OTHER: [&str; 10] = [
    "--backend",
    "cpu",
    "--x",
    "r=0.6:0.9:12",
    "--y",
    "zeta=0.05:0.25:10",
    "--set",
    "omega=2.4",
    "--set",
    "delta=0.2",
];

const COLUMNS: &str = "curve,kind,motion,x,y,criticality,point,symmetric,bounding";

fn run(folder: &Path, arguments: &[&str], threads: &str) -> Output {
    program().args(arguments).env("RAYON_NUM_THREADS", threads).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn succeeds(folder: &Path, arguments: &[&str]) -> Output {
    let output = run(folder, arguments, "2");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    output
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort_unstable();
    names
}

fn refuses(arguments: &[&str], part: &str) {
    let folder = tempdir().unwrap();
    let output = run(folder.path(), arguments, "2");
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(part), "{arguments:?}: no `{part}` in {message}");
    assert!(output.stdout.is_empty());
    assert_eq!(names(folder.path()), [""; 0], "{arguments:?}");
}

/// One row of the table.
struct Row {
    curve: String,
    kind: String,
    motion: String,
    x: f64,
    y: f64,
    criticality: String,
    point: String,
}

fn rows(table: &str) -> Vec<Row> {
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some(COLUMNS));
    lines
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            assert_eq!(fields.len(), 9, "{line}");
            assert!(fields[7..].iter().all(|field| ["true", "false"].contains(field)), "{line}");
            let owned = |i: usize| fields[i].to_owned();
            Row {
                curve: owned(0),
                kind: owned(1),
                motion: owned(2),
                x: fields[3].parse().unwrap(),
                y: fields[4].parse().unwrap(),
                criticality: owned(5),
                point: owned(6),
            }
        })
        .collect()
}

#[test]
fn the_papers_curves_have_its_names_and_are_the_same_every_time() {
    let folder = tempdir().unwrap();
    let all = |more: &[&'static str]| [&["curves"][..], &PAPER, more].concat();
    let output = succeeds(folder.path(), &all(&["--out", "curves.csv", "--json"]));
    assert_eq!(run(folder.path(), &all(&["--out", "again.csv"]), "1").status.code(), Some(0));
    assert_eq!(names(folder.path()), ["again.csv", "curves.csv"]);
    let table = fs::read_to_string(folder.path().join("curves.csv")).unwrap();
    assert!(
        table == fs::read_to_string(folder.path().join("again.csv")).unwrap(),
        "threads change the curves"
    );
    let told = text(&output.stderr);
    assert!(told.contains("computing on cpu"));
    let beyond = told
        .lines()
        .find(|line| line.starts_with("no curve, N above the largest that was asked for: "))
        .unwrap();
    assert!(beyond.contains(" cells)"), "{beyond}");

    let rows = rows(&table);
    let mut of: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in &rows {
        of.entry(&row.curve).or_default().push(row);
    }
    for (name, kind, motion) in [
        ("L1", "Neimark-Sacker", "1-1-1"),
        ("L2", "Neimark-Sacker", "1-1-1"),
        ("L3", "pitchfork", "1-1-1"),
        ("L4", "Neimark-Sacker", "1-1-1"),
        ("L5", "fold", "1-2-2"),
        ("L6", "pitchfork", "1-2-2"),
        ("L7", "period doubling", "1-2-2"),
    ] {
        let curve = of.get(name).unwrap_or_else(|| panic!("no {name}"));
        assert!(curve.iter().all(|row| row.kind == kind && row.motion == motion), "{name}");
    }
    // At a degenerate end there is none.
    let only = |name: &str, kind: &str| {
        let known = of[name].iter().filter(|row| !row.criticality.is_empty());
        known.clone().count() > 2 && known.clone().all(|row| row.criticality == kind)
    };
    assert!(only("L1", "supercritical") && only("L2", "subcritical"));
    assert!(of["L5"].iter().all(|row| row.criticality.is_empty()), "folds are neither");
    // The paper's pitchfork at δ = 0.1.
    let crossing = of["L3"].windows(2).find(|pair| (pair[0].y - 0.1) * (pair[1].y - 0.1) <= 0.0).unwrap();
    let share = (0.1 - crossing[0].y) / (crossing[1].y - crossing[0].y);
    let omega = crossing[0].x + share * (crossing[1].x - crossing[0].x);
    assert!((omega - 3.6907).abs() < 2e-4, "{omega}");

    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let list = json.as_array().unwrap();
    let points: u64 = list.iter().map(|curve| curve["points"].as_u64().unwrap()).sum();
    assert_eq!(points, rows.len() as u64);
    for curve in list {
        let mut keys: Vec<&str> = curve.as_object().unwrap().keys().map(String::as_str).collect();
        keys.sort_unstable();
        let expected = [
            "bounding",
            "criticality",
            "ends",
            "kind",
            "motion",
            "name",
            "number",
            "points",
            "special_points",
            "symmetric",
        ];
        assert_eq!(keys, expected);
        assert_eq!(curve["ends"].as_array().unwrap().len(), 2);
    }
    let named: Vec<&str> = list.iter().filter_map(|curve| curve["name"].as_str()).collect();
    assert!(named.contains(&"L1/L2") && named.contains(&"L3") && named.contains(&"L7"), "{named:?}");
    let torus = list.iter().find(|curve| curve["name"] == "L1/L2").unwrap();
    let shares = ["supercritical", "subcritical"].map(|side| torus["criticality"][side].as_f64().unwrap());
    assert!(
        shares[0] > 0.5 && shares[1] > 0.1 && (0.95..=1.0).contains(&(shares[0] + shares[1])),
        "{shares:?}"
    );
    let special = |row: &&Row| row.point != "ordinary" && ["L1", "L2"].contains(&&*row.curve);
    let in_table: Vec<(&str, f64)> =
        rows.iter().filter(special).map(|row| (row.point.as_str(), row.x)).collect();
    let in_json = torus["special_points"].as_array().unwrap();
    let in_json: Vec<(&str, f64)> = in_json
        .iter()
        .map(|point| (point["point"].as_str().unwrap(), point["x"].as_f64().unwrap()))
        .collect();
    assert_eq!(in_table, in_json);
    assert!(in_table.iter().any(|(point, _)| *point == "Chenciner"));
}

#[test]
fn curves_of_other_parameters_have_numbers() {
    let folder = tempdir().unwrap();
    let output = succeeds(folder.path(), &[&["curves"][..], &OTHER, &["--out", "c.csv", "--json"]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(json.as_array().unwrap().iter().all(|curve| curve["name"].is_null()));
    let rows = rows(&fs::read_to_string(folder.path().join("c.csv")).unwrap());
    let pitchfork: Vec<&Row> =
        rows.iter().filter(|row| row.kind == "pitchfork" && row.motion == "1-1-1").collect();
    assert!(pitchfork.len() > 10);
    assert!(pitchfork.iter().all(|row| row.curve.parse::<usize>().is_ok()));
    assert!(rows.iter().all(|row| (0.6..=0.9).contains(&row.x) && (0.05..=0.25).contains(&row.y)));
    let words = text(&succeeds(folder.path(), &[&["curves"][..], &OTHER].concat()).stdout);
    assert!(words.contains("pitchfork of 1-1-1 symmetric"), "{words}");
}

#[test]
fn a_plane_without_bifurcations_has_an_empty_table() {
    let folder = tempdir().unwrap();
    let quiet = ["--backend", "cpu", "--x", "omega=20:21:6", "--y", "delta=5:6:5", "--transient", "20"];
    let output = succeeds(folder.path(), &[&["curves"][..], &quiet, &["--out", "c.csv", "--json"]].concat());
    assert_eq!(text(&output.stdout).trim(), "[]");
    assert!(text(&output.stderr).contains("bifurcates"), "{}", text(&output.stderr));
    assert_eq!(fs::read_to_string(folder.path().join("c.csv")).unwrap(), format!("{COLUMNS}\n"));
}

/// The pitchfork of the symmetric 1-1-1 motion crosses δ = 0.1 at ω = 3.6907, as printed, on whatever axes it is followed.
#[test]
fn curves_do_not_depend_on_how_axes_run() {
    let folder = tempdir().unwrap();
    for (x, y) in [
        ("omega=3:4:24", "delta=0.05:0.2:24"),
        ("omega=4:3:24", "delta=0.05:0.2:24:log"),
        ("omega=3:4:24:log", "delta=0.2:0.05:24"),
    ] {
        let axes = ["curves", "--backend", "cpu", "--x", x, "--y", y];
        succeeds(folder.path(), &[&axes[..], &["--max-period", "1", "--out", "c.csv"]].concat());
        let rows = rows(&fs::read_to_string(folder.path().join("c.csv")).unwrap());
        let pitchfork: Vec<&Row> = rows.iter().filter(|row| row.curve == "L3").collect();
        let crossing = |pair: &[&Row]| {
            let share = (0.1 - pair[0].y) / (pair[1].y - pair[0].y);
            (0.0..1.0).contains(&share).then(|| pair[0].x + share * (pair[1].x - pair[0].x))
        };
        let crossings: Vec<f64> = pitchfork.windows(2).filter_map(crossing).collect();
        assert!(matches!(crossings[..], [omega] if (omega - 3.6907).abs() < 1e-3), "{x} {y}: {crossings:?}");
        fs::remove_file(folder.path().join("c.csv")).unwrap();
    }
}

#[test]
fn planes_that_cannot_have_curves_are_refused() {
    for command in [&["curves", "--out", "c.csv"][..], &["map", "--curves", "--curves-out", "c.csv"]] {
        refuses(&[command, &["--x", "x1=-0.01:0.01:5"]].concat(), "x1");
        refuses(&[command, &["--x", "omega=3:3:1"]].concat(), "range of omega");
        refuses(&[command, &["--y", "delta=0.3:0.3:5"]].concat(), "empty");
    }
    refuses(&["curves", "--max-period", "0"], "--max-period");
    refuses(&["curves", "--cells", "1"], "--cells");
    refuses(&["curves", "--out", "no/such/c.csv"], "no/such");
    refuses(&["map", "--curves-out", "c.csv"], "--curves");
    refuses(&["map", "--curves-max-period", "3"], "--curves");
    refuses(&["map", "--curves=some"], "some");
    refuses(&["map", "--curves", "--curves-out", "map.png"], "name it with .csv");
}

#[test]
fn a_map_can_have_its_curves_drawn_and_listed() {
    let folder = tempdir().unwrap();
    let plane = [&OTHER[..], &["--size", "640x480"]].concat();
    succeeds(folder.path(), &[&["map"][..], &plane, &["--out", "bare.png"]].concat());
    succeeds(folder.path(), &[&["map"][..], &plane, &["--curves", "--curves-out", "c.csv"]].concat());
    succeeds(folder.path(), &[&["curves"][..], &OTHER, &["--out", "alone.csv"]].concat());
    assert_eq!(names(folder.path()), ["alone.csv", "bare.npz", "bare.png", "c.csv", "map.npz", "map.png"]);
    let file = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert!(file("c.csv") == file("alone.csv"), "the same plane has the same curves");
    assert_ne!(file("map.png"), file("bare.png"));
    assert!(file("map.npz") == file("bare.npz"), "curves change no cell");
}
