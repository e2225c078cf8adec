//! `classify` and `map` agree: by their defaults, and cell by cell of a map that was computed before.

use std::fs::{self, File};
use std::path::Path;

use impact_atlas::plane::RegionMap;
use impact_atlas::store::read_map;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

use crate::run::{json, refuses, run, run_in, stderr, stdout};

/// A small map in a folder of its own.
fn mapped(out: &str, more: &[&str]) -> (TempDir, RegionMap) {
    let folder = tempdir().unwrap();
    let plane = ["map", "--x", "omega=1.2:3.6:6", "--y", "delta=0.08:0.3:5", "--backend", "cpu", "--json"];
    let all: Vec<&str> =
        plane.iter().chain(&["--size", "400x300", "--out", out]).chain(more).copied().collect();
    json(&run_in(folder.path(), &all));
    let map = read_map(File::open(folder.path().join("map.npz")).unwrap()).unwrap();
    (folder, map)
}

/// What `classify` says must be the cell's verdict to the bit.
#[track_caller]
fn assert_cell(map: &RegionMap, column: u32, row: u32, found: &Value) {
    let verdict = map.at(column, row);
    assert_eq!(found["label"], verdict.label(), "column {column}, row {row}");
    assert_eq!(found["state"], serde_json::to_value(verdict.state).unwrap());
    assert_eq!(found["periods"], verdict.periods);
    let exponent = found["lyapunov"].as_f64().map_or(f32::NAN, |exponent| exponent as f32);
    assert!(exponent == verdict.lyapunov || exponent.is_nan() && !verdict.lyapunov.is_finite());
}

fn cells(map: &RegionMap) -> impl Iterator<Item = (u32, u32)> {
    let (columns, rows) = (map.plane.x.count, map.plane.y.count);
    (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
}

/// The parameters of a cell, as they are set.
fn place(map: &RegionMap, (column, row): (u32, u32)) -> [String; 2] {
    [format!("omega={}", map.plane.x.value(column)), format!("delta={}", map.plane.y.value(row))]
}

#[test]
fn classify_begins_and_looks_as_map_does() {
    let (_folder, map) = mapped("map.png", &[]);
    for (column, row) in cells(&map) {
        let [omega, delta] = place(&map, (column, row));
        let found = json(&run(&["classify", "--set", &omega, "--set", &delta, "--backend", "cpu", "--json"]));
        assert_cell(&map, column, row, &found);
        assert_eq!(found["start"], "symmetric");
        assert_eq!(found["start_state"].as_array().unwrap().len(), 4);
    }
    // From rest it is another plane: the agreement above is not for want of difference.
    let from_rest = |(column, row): (u32, u32)| {
        let [omega, delta] = place(&map, (column, row));
        let set = ["classify", "--set", &omega, "--set", &delta, "--start", "rest"];
        let found = json(&run(&[&set[..], &["--backend", "cpu", "--json"]].concat()));
        found["state"] != serde_json::to_value(map.at(column, row).state).unwrap()
    };
    assert!(cells(&map).any(from_rest));
}

fn from(folder: &Path, file: &str, at: &str) -> Value {
    let found = json(&run_in(folder, &["classify", "--from", file, "--at", at, "--json"]));
    assert_eq!(found["backend"], "cpu", "the map's own");
    found
}

#[test]
fn classify_answers_for_exactly_the_cell_of_a_map() {
    let (folder, map) = mapped("map.png", &["--transient", "120", "--start", "rest", "--max-period", "8"]);
    for (column, row) in cells(&map).step_by(7) {
        // Anywhere in the cell: its middle or nearer to its edge.
        for share in [0.0, 0.4, -0.4] {
            let omega = map.plane.x.value(column) + share * 0.48;
            let delta = map.plane.y.value(row) - share * 0.055;
            for file in ["map.png", "map.npz"] {
                let found = from(folder.path(), file, &format!("omega={omega},delta={delta}"));
                assert_cell(&map, column, row, &found);
                assert_eq!((&found["cell"]["column"], &found["cell"]["row"]), (&column.into(), &row.into()));
                assert_eq!(found["start"], "rest");
            }
        }
    }
}

#[test]
fn the_cells_of_certified_maps_and_of_svg_pictures_are_read_too() {
    let (folder, map) = mapped("map.svg", &["--certify"]);
    assert!(map.multipliers.is_some());
    for (column, row) in cells(&map).step_by(4) {
        let at = format!("delta={},omega={}", map.plane.y.value(row), map.plane.x.value(column));
        assert_cell(&map, column, row, &from(folder.path(), "map.svg", &at));
    }
}

#[test]
fn other_commands_follow_the_cell_of_a_map_too() {
    let (folder, map) = mapped("map.png", &[]);
    let followed = |of: &[&str], more: &[&str]| run_in(folder.path(), &[of, more].concat());
    let (mut compared, mut moved) = (0, 0);
    for (column, row) in
        cells(&map).filter(|&(column, row)| map.at(column, row).regime.is_periodic()).step_by(3)
    {
        let [omega, delta] = place(&map, (column, row));
        let at = format!("{omega},{delta}");
        let cell = ["--from", "map.png", "--at", &at];
        let own = ["--set", &omega, "--set", &delta, "--start", "symmetric"];
        let motion = json(&followed(&["motion", "--json"], &cell));
        assert_eq!(motion["label"], map.at(column, row).label(), "{at}");
        let short = ["--transient", "40", "--observe", "32", "--json"];
        let measured = |of: &[&str]| json(&followed(&["lyapunov"], &[of, &short].concat()));
        assert_eq!(measured(&cell), measured(&own), "{at}");
        let impacts = |of: &[&str], file: &str| {
            let more = ["--transient", "3", "--periods", "4", "--impacts", file, "--force"];
            followed(&["orbit"], &[of, &more].concat());
            fs::read_to_string(folder.path().join(file)).unwrap()
        };
        let table = impacts(&cell, "cell.csv");
        assert_eq!(table, impacts(&own, "own.csv"), "{at}");
        moved += u32::from(table != impacts(&own[..4], "rest.csv"));
        compared += 1;
    }
    assert!(compared >= 4 && moved >= 1, "{compared}, of which {moved} begin elsewhere by themselves");
}

#[test]
fn the_start_is_printed() {
    let output = run(&["classify", "--backend", "cpu"]);
    assert!(stdout(&output).contains("start                       symmetric: x1 "), "{}", stdout(&output));
}

#[test]
fn certifying_is_told_in_the_summary() {
    let folder = tempdir().unwrap();
    let run = |more: &[&str]| {
        let plane = ["map", "--x", "omega=3:4:5", "--y", "delta=0.1:0.3:4", "--backend", "cpu"];
        run_in(folder.path(), &[&plane[..], &["--size", "400x300", "--force"], more].concat())
    };
    let told = run(&["--certify"]);
    assert!(stdout(&told).contains("certified: of "), "{} {}", stdout(&told), stderr(&told));
    let counts = json(&run(&["--certify", "--json"]));
    let certified = &counts["certified"];
    assert!(certified["periodic"].as_u64().unwrap() > 5);
    assert_eq!(certified["confirmed"], certified["periodic"]);
    let plain = json(&run(&["--json"]));
    assert!(plain["certified"].is_null());
}

#[test]
fn cells_that_cannot_be_read_are_refused() {
    let (folder, _) = mapped("map.png", &[]);
    fs::write(folder.path().join("notes.txt"), "omega").unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (map, notes, none) = (path("map.png"), path("notes.txt"), path("none.png"));
    let at = "omega=2,delta=0.1";
    refuses(&["classify", "--from", &map], &["--at"]);
    refuses(&["classify", "--at", at], &["--from"]);
    refuses(
        &["classify", "--from", &map, "--at", "omega=9,delta=0.1"],
        &["omega = 9", "outside", "omega=1.2:3.6:6"],
    );
    refuses(&["classify", "--from", &map, "--at", "omega=2,r=0.5"], &["omega and delta"]);
    refuses(&["classify", "--from", &map, "--at", "omega=2"], &["NAME=VALUE,NAME=VALUE"]);
    refuses(&["classify", "--from", &map, "--at", at, "--set", "r=0.5"], &["--from", "--set"]);
    refuses(&["classify", "--from", &map, "--at", at, "--transient", "5"], &["--from", "--transient"]);
    for command in ["orbit", "motion", "lyapunov"] {
        refuses(&[command, "--from", &map], &["--at"]);
        refuses(&[command, "--from", &map, "--at", at, "--start", "rest"], &["--from", "--start"]);
        refuses(&[command, "--from", &notes, "--at", at], &["notes.txt", "no configuration"]);
    }
    refuses(&["classify", "--from", &notes, "--at", at], &["notes.txt", "no configuration"]);
    refuses(&["classify", "--from", &none, "--at", at], &["none.png", "cannot read"]);
    let control =
        ["map", "--control", "delay", "--x", "omega=2.6:3:3", "--y", "gain=0:1:2", "--out", "c.png"];
    let more = ["--backend", "cpu", "--size", "400x300", "--json"];
    json(&run_in(folder.path(), &[&control[..], &more].concat()));
    refuses(&["classify", "--from", &path("c.png"), "--at", "omega=2.6,gain=1"], &["under control"]);
}

#[test]
fn exponents_that_were_not_measured_are_absent_from_maps_under_control() {
    let folder = tempdir().unwrap();
    let control =
        ["map", "--control", "pulse", "--x", "target_v1=-0.45:-0.25:4", "--y", "target_tau=1.4:2.2:3"];
    let more = ["--set", "omega=2.83", "--backend", "cpu", "--size", "400x300", "--out", "c.png", "--json"];
    json(&run_in(folder.path(), &[&control[..], &more].concat()));
    let mut zip = zip::ZipArchive::new(File::open(folder.path().join("c.npz")).unwrap()).unwrap();
    let array = npyz::NpyFile::new(zip.by_name("lyapunov.npy").unwrap()).unwrap();
    let exponents: Vec<f32> = array.into_vec().unwrap();
    assert_eq!(exponents.len(), 12);
    assert!(exponents.iter().any(|exponent| exponent.is_nan()), "{exponents:?}");
    assert!(exponents.iter().all(|exponent| *exponent != 0.0), "{exponents:?}");
}
