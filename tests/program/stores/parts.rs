//! Parts of a plane: alone, at once, and the same one twice.

use std::process::Stdio;

use tempfile::tempdir;

use super::{PLANE, files, times_done};
use crate::run::{done, json, program, run_in, words};

#[test]
fn parts_at_once_and_one_started_twice_make_the_whole() {
    let folder = tempdir().unwrap();
    done(folder.path(), &format!("{PLANE} --data whole.zarr"));
    let mut running: Vec<_> = ["1/3", "2/3", "2/3", "3/3"]
        .iter()
        .map(|part| {
            let command = format!("{PLANE} --data parts.zarr --part {part} --threads 1");
            let mut child = program();
            child
                .args(words(&command))
                .current_dir(folder.path())
                .stdout(Stdio::null())
                .stderr(Stdio::piped());
            child.spawn().unwrap()
        })
        .collect();
    for child in running.drain(..) {
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let [whole, parts] = ["whole.zarr", "parts.zarr"].map(|name| files(&folder.path().join(name)));
    assert!(whole == parts, "the bits differ");
    let times = times_done(&folder.path().join("parts.zarr"));
    assert_eq!(times.len(), 30);
    let status = json(&run_in(folder.path(), &["status", "parts.zarr", "--json"]));
    assert_eq!((&status["done"], &status["missing"]), (&30.into(), &0.into()));
    assert_eq!((&status["cells"], &status["cells_done"]), (&1920.into(), &1920.into()));
}

#[test]
fn a_part_computes_its_share_and_draws_nothing() {
    let folder = tempdir().unwrap();
    let of = |part: &str| {
        let command = format!("{PLANE} --data plane.zarr --part {part} --json");
        json(&run_in(folder.path(), &words(&command)))
    };
    let first = of("1/5");
    assert_eq!((&first["tiles_computed"], &first["tiles_missing"]), (&6.into(), &24.into()));
    let status = json(&run_in(folder.path(), &["status", "plane.zarr", "--json"]));
    assert_eq!(
        (&status["done"], &status["missing"], &status["processes"]),
        (&6.into(), &24.into(), &0.into())
    );
    assert!(status["cells_per_second"].is_null() && status["seconds_left"].is_null(), "it is at its end");
    // A process that was killed just now says nothing of it.
    let hidden = folder.path().join("plane.zarr").join(".impact-atlas");
    for log in std::fs::read_dir(&hidden).unwrap().map(|entry| entry.unwrap().path()) {
        let text = std::fs::read_to_string(&log).unwrap();
        let unended: String =
            text.lines().filter(|line| !line.contains("ended")).map(|line| format!("{line}\n")).collect();
        assert_ne!(unended, text);
        std::fs::write(&log, unended).unwrap();
    }
    let status = json(&run_in(folder.path(), &["status", "plane.zarr", "--json"]));
    assert_eq!(&status["processes"], &1);
    assert!(
        status["cells_per_second"].as_f64().unwrap() > 0.0 && status["seconds_left"].as_f64().unwrap() > 0.0
    );
    for part in ["2/5", "3/5", "4/5"] {
        of(part);
    }
    assert_eq!(of("5/5")["tiles_missing"], 0);
    assert_eq!(crate::run::names(folder.path()), ["plane.zarr"]);
    let empty = of("99/99");
    assert_eq!((&empty["tiles_computed"], &empty["tiles_there"]), (&0.into(), &0.into()));
}
