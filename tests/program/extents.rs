//! How far motions go, in files and pictures.

use std::fs::File;

use impact_atlas::plane::Window;
use impact_atlas::store::{ZarrStore, read_map};
use tempfile::tempdir;

use crate::run::{run_in, stderr};

#[test]
fn they_are_measured_where_they_are_asked_for() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let run = |command: &str| run_in(folder.path(), &command.split_whitespace().collect::<Vec<_>>());
    let small = "map --backend cpu --x omega=2.6:3.9:12 --y delta=0.05:0.3:9 --transient 40 --observe 40";
    for (more, file) in
        [("", "plain"), ("--extents", "asked"), ("--layer peak.x2", "drawn"), ("--certify --extents", "both")]
    {
        let output = run(&format!("{small} --out {file}.png {more}"));
        assert_eq!(output.status.code(), Some(0), "{more}: {}", stderr(&output));
    }
    let read = |file: &str| read_map(File::open(at(&format!("{file}.npz"))).unwrap()).unwrap();
    let [plain, asked, drawn, both] = ["plain", "asked", "drawn", "both"].map(read);
    assert!(plain.extents.is_none() && both.multipliers.is_some() && both.extents.is_some());
    assert!(asked.extents.is_some() && asked.extents == drawn.extents);
    assert!(plain.verdicts.iter().zip(&asked.verdicts).all(|(a, b)| a.state == b.state && a.n == b.n));
    // A store has the same, whatever its tiles, and goes on with them.
    for (more, file) in [("--extents --tile 5", "store"), ("--certify --extents --tile 4", "certified")] {
        let output = run(&format!("{small} --data {file}.zarr {more}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    let stored = |file: &str| {
        let store = ZarrStore::open(&at(file)).unwrap();
        store.map_of(Window::whole(&plain.plane)).unwrap()
    };
    assert_eq!(stored("store.zarr").extents, asked.extents);
    let certified = stored("certified.zarr");
    assert!(certified.extents == both.extents && certified.multipliers == both.multipliers);
    assert_eq!(run(&format!("{small} --data store.zarr")).status.code(), Some(2), "another configuration");
    let again = run("map --from store.zarr --out again.png");
    assert_eq!(again.status.code(), Some(0), "{}", stderr(&again));
    assert_eq!(read("again").extents, asked.extents);
    for command in
        ["render asked.npz --layer rms.x1 --out r.png", "render store.zarr --layer peak.x1 --out p.svg"]
    {
        let output = run(command);
        assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
    }
    let output = run("render plain.npz --layer rms.x1 --out never.png");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("rms.x1") && stderr(&output).contains("--extents"),
        "{}",
        stderr(&output)
    );
    assert!(!at("never.png").exists());
    let output = run(&format!("{small} --layer rms.x3 --out never.png"));
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("peak.x2"), "{}", stderr(&output));
}
