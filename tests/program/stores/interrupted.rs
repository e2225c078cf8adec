//! Runs that are killed, and what is left of them.

use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use impact_atlas::store::ZarrStore;
use tempfile::tempdir;

use super::{PLANE, SMALL, files, times_done};
use crate::run::{done, json, program, run_in, stderr, words};

fn begun(folder: &std::path::Path, command: &str) -> Child {
    let mut child = program();
    child.args(words(command)).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null());
    child.spawn().unwrap()
}

/// So many kills in one run; more are asked for by IMPACT_ATLAS_KILLS.
fn kills() -> u32 {
    std::env::var("IMPACT_ATLAS_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(6)
}

#[test]
fn what_is_killed_at_any_moment_ends_with_the_same_bits() {
    let folder = tempdir().unwrap();
    let began = Instant::now();
    done(folder.path(), &format!("{PLANE} --data whole.zarr"));
    let whole = began.elapsed();
    let command = format!("{PLANE} --data killed.zarr");
    // Moments that no one chose: the golden ratio spreads them over what one tile takes, and begins before the first.
    let kills = kills();
    let slice = whole.mul_f64(2.0 / f64::from(kills.max(4)));
    for kill in 0..kills {
        let mut child = begun(folder.path(), &command);
        thread::sleep(slice.mul_f64((f64::from(kill) * 0.618_033_988_749_895).fract()));
        let _ = child.kill();
        child.wait().unwrap();
        // What is there can be read, whatever was under way.
        if let Ok(store) = ZarrStore::open(&folder.path().join("killed.zarr")) {
            let there = store.tiles_there().unwrap();
            for tile in (0..store.tiling().count()).filter(|&tile| there[tile as usize]) {
                store.map_of(store.tiling().window(tile)).unwrap();
            }
        }
    }
    done(folder.path(), &command);
    let [whole, killed] = ["whole.zarr", "killed.zarr"].map(|name| files(&folder.path().join(name)));
    assert_eq!(whole.keys().collect::<Vec<_>>(), killed.keys().collect::<Vec<_>>());
    assert!(whole == killed, "the bits differ");
    // What was noted as done was not computed again; one that was killed between its last shard and its note is there too.
    let times = times_done(&folder.path().join("killed.zarr"));
    assert!(times.values().all(|&times| times == 1), "{times:?}");
    assert!(times.len() + kills as usize >= 30, "{times:?}");
}

#[test]
fn the_same_command_again_computes_nothing() {
    let folder = tempdir().unwrap();
    let command = format!("{SMALL} --data plane.zarr --json");
    let first = json(&run_in(folder.path(), &words(&command)));
    assert_eq!((&first["tiles_computed"], &first["tiles_there"]), (&1.into(), &0.into()));
    let before = files(&folder.path().join("plane.zarr"));
    let second = json(&run_in(folder.path(), &words(&command)));
    assert_eq!((&second["tiles_computed"], &second["tiles_there"]), (&0.into(), &1.into()));
    assert!(before == files(&folder.path().join("plane.zarr")));
    // With one shard gone its tile is computed again, and is the same.
    std::fs::remove_file(folder.path().join("plane.zarr/lyapunov/c/0/0")).unwrap();
    let third = json(&run_in(folder.path(), &words(&command)));
    assert_eq!(third["tiles_computed"], 1);
    assert!(before == files(&folder.path().join("plane.zarr")));
}

#[test]
fn ctrl_c_leaves_what_is_done() {
    let folder = tempdir().unwrap();
    let command =
        format!("{PLANE} --fixed-periods --transient 40000 --data plane.zarr").replace("--transient 60 ", "");
    let mut child = begun(folder.path(), &command);
    thread::sleep(Duration::from_millis(900));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let began = Instant::now();
    let status = child.wait().unwrap();
    assert_eq!(status.code(), Some(130));
    assert!(began.elapsed() < Duration::from_secs(20));
    let output = run_in(folder.path(), &["status", "plane.zarr", "--json"]);
    assert!(json(&output)["missing"].as_u64().unwrap() > 0, "{}", stderr(&output));
}

/// A file that may not grow stands for a disk that is full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_the_machines_matter_and_what_is_missing_is_computed_later() {
    let folder = tempdir().unwrap();
    let program = env!("CARGO_BIN_EXE_impact-atlas");
    let command = format!("{SMALL} --tile 4 --data plane.zarr");
    // Metadata have room, shards of the states have not.
    let limited = format!("ulimit -f 1; exec {program} {command} --tile 12").replace("--tile 4 ", "");
    done(folder.path(), &format!("{SMALL} --tile 12 --data other.zarr"));
    done(folder.path(), &format!("{SMALL} --tile 12 --data plane.zarr"));
    std::fs::remove_file(folder.path().join("plane.zarr/state/c/0/0/0")).unwrap();
    let output = Command::new("bash").args(["-c", &limited]).current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("state/c/0/0/0"), "{}", stderr(&output));
    done(folder.path(), &format!("{SMALL} --tile 12 --data plane.zarr"));
    let [one, other] = ["plane.zarr", "other.zarr"].map(|name| files(&folder.path().join(name)));
    assert!(one == other);
}
