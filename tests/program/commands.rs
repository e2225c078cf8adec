//! The command line from outside: results, refusals, exit codes, what is and is not written.

use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use impact_atlas::plane::Start;
use impact_atlas::store::read_map;
use serde_json::Value;
use tempfile::tempdir;

use crate::run::{json, keys, names, program, refuses, run, run_in, stderr, stdout};

/// A map that takes a moment only.
const SMALL: [&str; 8] =
    ["--x", "omega=2.8:3.8:6", "--y", "delta=0.1:0.3:4", "--transient", "100", "--observe", "100"];

fn small_map(more: &[&str]) -> Vec<&'static str> {
    let all = ["map", "--backend", "cpu"].iter().chain(&SMALL).chain(more);
    all.map(|text| &*text.to_string().leak()).collect()
}

#[test]
fn unknown_parameters_are_refused() {
    refuses(&["map", "--x", "omgea=1:2:3"], &["omgea", "omega, delta, zeta, r, mu_m, mu_k, mu_c, f20"]);
    refuses(&["classify", "--set", "gamma=1"], &["gamma", "omega, delta"]);
    refuses(&["orbit", "--set", "x1=0.01"], &["x1", "--start"]);
}

#[test]
fn unusable_axes_are_refused() {
    refuses(&["map", "--x", "omega=3:3:10"], &["omega=3:3", "empty"]);
    refuses(&["map", "--x", "x2=-1:2:10:log"], &["x2=-1:2", "above 0"]);
    refuses(&["map", "--y", "delta=0.1:0.1:10"], &["empty"]);
    refuses(&["map", "--x", "omega"], &["NAME=FIRST:LAST:COUNT"]);
    refuses(&["map", "--x", "omega=1:2"], &["NAME=FIRST:LAST:COUNT"]);
    refuses(&["map", "--x", "omega=1:2:0"], &["COUNT of 0", "1 to 65536"]);
    refuses(&["map", "--x", "omega=1:2:1000000000"], &["COUNT of 1000000000", "1 to 65536"]);
    refuses(&["map", "--x", "omega=1:2:99999999999999999999"], &["omega=1:2:99999999999999999999"]);
    refuses(&["map", "--x", "omega=1:2:60000", "--y", "delta=0.1:0.2:60000"], &["60000 × 60000", "at most"]);
    refuses(&["map", "--x", "omega=NaN:2:10"], &["NaN", "finite"]);
    refuses(&["map", "--x", "omega=1:inf:10"], &["inf", "finite"]);
    refuses(&["map", "--x", "r=0.5:1.5:10"], &["r = 1.5", "between 0 and 1"]);
    refuses(&["map", "--x", "mu_m=0:0.5:10"], &["mu_m = 0", "excluded"]);
    refuses(&["map", "--y", "delta=-0.1:0.5:10"], &["delta = -0.1"]);
    refuses(&["map", "--x", "omega=0:5:10"], &["omega = 0"]);
    refuses(&["map", "--x", "r=0.5:0.9:10", "--y", "r=0.5:0.9:10"], &["both axes are r"]);
    refuses(&["validate", "--x", "omega=3:3:10"], &["empty"]);
}

#[test]
fn values_out_of_range_are_refused() {
    for (set, parts) in [
        ("r=1.01", ["r = 1.01", "between 0 and 1"]),
        ("r=-0.1", ["r = -0.1", "between 0 and 1"]),
        ("mu_m=1", ["mu_m = 1", "excluded"]),
        ("mu_k=0", ["mu_k = 0", "excluded"]),
        ("mu_c=1.5", ["mu_c = 1.5", "excluded"]),
        ("f20=2", ["f20 = 2", "included"]),
        ("delta=-0.1", ["delta = -0.1", "0 or greater"]),
        ("zeta=-1", ["zeta = -1", "0 or greater"]),
        ("omega=0", ["omega = 0", "between 0 and 1000000"]),
        ("omega=-3", ["omega = -3", "between 0 and 1000000"]),
        ("omega=nan", ["omega = NaN", "between 0 and 1000000"]),
        ("zeta=inf", ["zeta = inf", "0 or greater"]),
        ("omega=fast", ["omega=fast", "NAME=VALUE"]),
        ("omega", ["omega", "NAME=VALUE"]),
    ] {
        refuses(&["classify", "--set", set], &parts);
    }
    refuses(&["map", "--set", "r=7"], &["r = 7"]);
    refuses(&["orbit", "--set", "r=7"], &["r = 7"]);
    refuses(&["classify", "--set", "omega=1e-9"], &["omega", "raise omega"]);
}

#[test]
fn contradictions_are_refused() {
    refuses(&["map", "--set", "omega=3"], &["--set omega=3", "--x omega=0.2:5:800", "drop one"]);
    refuses(
        &["map", "--x", "r=0.5:0.9:5", "--y", "zeta=0:0.1:5", "--set", "zeta=0.1"],
        &["--y zeta=0:0.1:5"],
    );
    refuses(&["classify", "--set", "r=0.5", "--set", "r=0.6"], &["r=0.5", "r=0.6", "twice"]);
    refuses(&["classify", "--backend", "cpu", "--adapter", "llvmpipe"], &["llvmpipe", "--backend cpu"]);
    refuses(
        &["map", "--start", "symmetric", "--x", "x1=-0.01:0.01:5", "--y", "v1=-1:1:5"],
        &["--start rest"],
    );
}

#[test]
fn starts_outside_the_stops_are_refused() {
    refuses(&["classify", "--start", "0.2,0,0,0"], &["x1 = 0.2", "gap is 0.1"]);
    refuses(&["orbit", "--start=-0.2,0,0,0"], &["-x1 = 0.2", "gap is 0.1"]);
    refuses(&["map", "--start", "0.9,0,0,0"], &["x1 = 0.9", "gap is 0.02", "no cell", "--start"]);
    refuses(&["map", "--x", "x1=-0.2:-0.11:5", "--y", "v1=-1:1:5"], &["-x1 = 0.2", "gap is 0.1", "no cell"]);
    refuses(
        &["map", "--x", "x1=-0.4:-0.3:5", "--y", "delta=0.05:0.2:5"],
        &["-x1 = 0.4", "gap is 0.05", "no cell"],
    );
    refuses(&["bifurcation", "--x", "x1=0.3:0.2:5"], &["x1 = 0.3", "gap is 0.1", "no column"]);
    let rising = ["bifurcation", "--x", "delta=0.4:0.02:9", "--sweep", "both", "--start", "0.2,0,0,0"];
    refuses(&rising, &["the sweep up begins at delta = 0.02", "x1 = 0.2", "gap is 0.02"]);
    refuses(&["classify", "--start", "1,2,3"], &["1,2,3", "X1,X2,V1,V2"]);
    refuses(&["classify", "--start", "0,NaN,0,0"], &["not a finite number"]);
}

#[test]
fn unusable_lengths_are_refused() {
    refuses(&["classify", "--observe", "0"], &["0 forcing periods", "1 to"]);
    refuses(&["classify", "--transient", "4000000000"], &["4000000000", "at most"]);
    refuses(&["classify", "--max-period", "0"], &["largest period of 0"]);
    refuses(&["map", "--max-period", "2000"], &["2000", "1024"]);
    refuses(&["classify", "--observe", "many"], &["many", "--observe"]);
    refuses(&["orbit", "--periods", "0"], &["--periods"]);
    refuses(&["orbit", "--trajectory", "t.csv", "--periods", "1000000", "--samples", "100"], &["at most"]);
    refuses(&["orbit", "--impacts", "i.csv", "--samples", "100"], &["--samples 100", "--trajectory"]);
    refuses(&["validate", "--cells", "0"], &["--cells"]);
    refuses(&["map", "--size", "0x0"], &["0 × 0"]);
    refuses(&["map", "--size", "big"], &["WIDTHxHEIGHT"]);
    refuses(&["map", "--no-such-option"], &["--no-such-option"]);
    refuses(&["mpa"], &["mpa"]);
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_anything_is_computed() {
    let began = Instant::now();
    let folder = tempdir().unwrap();
    let directory = folder.path().to_str().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "kept").unwrap();
    let below = file.join("map.png");
    refuses(&["map", "--out", directory], &[directory, "directory"]);
    refuses(&["map", "--data", directory], &[directory, "directory"]);
    refuses(&["map", "--out", "no/such/map.png"], &["no/such", "directory"]);
    refuses(&["map", "--out", below.to_str().unwrap()], &["map.png"]);
    refuses(&["map", "--out", ""], &["error"]);
    refuses(&["map", "--out", "map.jpg"], &["map.jpg", ".png"]);
    refuses(&["map", "--out", "a.png", "--data", "./a.png"], &["a.png", "two results"]);
    refuses(&["orbit", "--impacts", directory], &[directory, "directory"]);
    refuses(&["orbit", "--impacts", "a.csv", "--trajectory", "a.csv"], &["a.csv", "two results"]);
    assert_eq!(names(folder.path()), ["file"]);
    assert_eq!(fs::read_to_string(file).unwrap(), "kept");
    assert!(began.elapsed() < Duration::from_secs(30), "a whole map takes longer");
}

#[test]
fn an_adapter_that_is_not_there_is_the_machines_matter() {
    for command in ["map", "classify", "validate"] {
        let folder = tempdir().unwrap();
        let output = run_in(folder.path(), &[command, "--adapter", "no such adapter"]);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        assert!(stderr(&output).contains("no such adapter"), "{}", stderr(&output));
        assert_eq!(stdout(&output), "");
        assert_eq!(names(folder.path()), [""; 0]);
    }
}

#[test]
fn classify_gives_the_keys_of_the_contract() {
    let output = run(&["classify", "--set", "omega=3.7", "--set", "delta=0.1", "--backend", "cpu", "--json"]);
    let result = json(&output);
    let mut expected = [
        "label",
        "regime",
        "n",
        "p",
        "q",
        "symmetric",
        "lyapunov",
        "state",
        "peak_impact_velocity",
        "periods",
        "start",
        "start_state",
        "impacts_per_stop",
        "backend",
        "adapter",
    ];
    expected.sort_unstable();
    assert_eq!(keys(&result), expected);
    assert_eq!(result["label"], "1-1-1");
    assert_eq!(result["regime"], "periodic");
    assert_eq!((&result["n"], &result["p"], &result["q"]), (&1.into(), &1.into(), &1.into()));
    assert_eq!(result["symmetric"], true);
    assert_eq!(result["state"].as_array().unwrap().len(), 4);
    assert_eq!(result["backend"], "cpu");
    assert!(stderr(&output).contains("computing on cpu"), "{}", stderr(&output));
}

#[test]
fn classify_without_json_says_it_in_words() {
    let output = run(&["classify", "--backend", "cpu", "--set", "omega=3.5"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(stdout(&output).starts_with("1-1-1, unsymmetric\n"), "{}", stdout(&output));
    let chaos = run(&["classify", "--backend", "cpu", "--set", "omega=2.83"]);
    assert!(stdout(&chaos).starts_with("chaotic\n"), "{}", stdout(&chaos));
}

#[test]
fn a_symmetric_start_that_is_not_there_is_told() {
    let start = |delta: &str| {
        let output = run(&["classify", "--backend", "cpu", "--start", "symmetric", "--set", delta, "--json"]);
        (json(&output)["label"].clone(), stderr(&output).contains("starting from rest"))
    };
    assert_eq!(start("delta=5"), ("no impact".into(), true));
    assert_eq!(start("delta=0.1"), ("1-1-1".into(), false));
}

#[test]
fn map_writes_a_picture_and_data_beside_it() {
    let folder = tempdir().unwrap();
    let output = run_in(folder.path(), &small_map(&["--out", "plane.png", "--size", "400x300", "--json"]));
    let result = json(&output);
    assert_eq!(names(folder.path()), ["plane.npz", "plane.png"]);
    let map = read_map(fs::File::open(folder.path().join("plane.npz")).unwrap()).unwrap();
    assert_eq!((map.plane.x.count, map.plane.y.count, map.verdicts.len()), (6, 4, 24));
    assert_eq!(map.plane.start, Start::Symmetric);
    assert_eq!(map.at(5, 0).label(), "1-1-1");
    let png = fs::read(folder.path().join("plane.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    assert_eq!(
        [&png[16..20], &png[20..24]],
        [400u32.to_be_bytes(), 300u32.to_be_bytes()],
        "the size asked for"
    );
    let expected =
        ["adapter", "backend", "cells", "certified", "impacts", "impacts_per_second", "regimes", "seconds"];
    assert_eq!(keys(&result), expected);
    assert_eq!(result["cells"], 24);
    assert_eq!(result["regimes"].as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum::<u64>(), 24);
    assert_eq!(result["regimes"]["failed"], 0);
    assert!(result["impacts"].as_u64().unwrap() > 1000);
    assert!(stderr(&output).contains("computing on cpu"));
    assert!(!stderr(&output).contains("left"), "a bar that is not on a terminal: {}", stderr(&output));
}

#[test]
fn map_replaces_older_results_where_it_is_forced_and_takes_other_names() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("map.png"), "old").unwrap();
    let output = run_in(folder.path(), &small_map(&["--data", "cells.npz", "--force"]));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(names(folder.path()), ["cells.npz", "map.png"]);
    assert_ne!(fs::read(folder.path().join("map.png")).unwrap(), b"old");
    assert!(stdout(&output).starts_with("24 cells"), "{}", stdout(&output));
}

#[test]
fn basins_start_from_rest_where_no_start_is_given() {
    let basin = [
        "map",
        "--backend",
        "cpu",
        "--x",
        "x1=-0.1:0.1:3",
        "--y",
        "v1=-1:1:3",
        "--transient",
        "10",
        "--observe",
    ];
    let folder = tempdir().unwrap();
    let output = run_in(folder.path(), &[&basin[..], &["10"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let map = read_map(fs::File::open(folder.path().join("map.npz")).unwrap()).unwrap();
    assert_eq!(map.plane.start, Start::Rest);
}

#[test]
fn orbit_writes_its_impacts_and_its_trajectory() {
    let folder = tempdir().unwrap();
    let arguments = ["orbit", "--set", "omega=3.7", "--impacts", "i.csv", "--trajectory", "t.csv"];
    let more = ["--transient", "2000", "--periods", "3", "--samples", "10"];
    let output = run_in(folder.path(), &[&arguments[..], &more[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stdout(&output).starts_with("6 impacts in 3 forcing periods: 3 at stop A"),
        "{}",
        stdout(&output)
    );

    let impacts = fs::read_to_string(folder.path().join("i.csv")).unwrap();
    let mut lines = impacts.lines();
    assert_eq!(lines.next(), Some("time,stop,velocity_before,velocity_after,x2,v2,phase"));
    let at_a: Vec<Vec<f64>> = lines
        .filter_map(|line| line.split_once(",A,").map(|(_, rest)| rest))
        .map(|rest| rest.split(',').map(|number| number.parse().unwrap()).collect())
        .collect();
    assert_eq!(at_a.len(), 3);
    // The analytic X* of the paper at omega = 3.7: (v1+, x2, v2, phase).
    for row in at_a {
        for (value, expected) in row[1..].iter().zip([-0.345457, -0.006341, 0.021160, 1.802134]) {
            assert!((value - expected).abs() < 1e-6, "{value} instead of {expected}");
        }
        assert!((row[1] + 0.8 * row[0]).abs() < 1e-15);
    }

    let trajectory = fs::read_to_string(folder.path().join("t.csv")).unwrap();
    assert_eq!(trajectory.lines().next(), Some("time,x1,x2,v1,v2"));
    assert!((30..=32).contains(&trajectory.lines().skip(1).count()));
    let farthest =
        trajectory.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap());
    assert!(farthest.map(f64::abs).fold(0.0, f64::max) <= 0.1);
}

#[test]
fn an_orbit_without_impacts_has_a_table_all_the_same() {
    let folder = tempdir().unwrap();
    let arguments = ["orbit", "--set", "delta=5", "--impacts", "i.csv", "--transient", "10"];
    let output = run_in(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let impacts = fs::read_to_string(folder.path().join("i.csv")).unwrap();
    assert_eq!(impacts, "time,stop,velocity_before,velocity_after,x2,v2,phase\n");
    assert_eq!(names(folder.path()), ["i.csv"]);
}

#[test]
fn single_precision_agrees_with_the_reference() {
    let plane = ["validate", "--x", "omega=3.5:4.2:6", "--y", "delta=0.08:0.2:5"];
    // As it is used: where kernels are not optimised for the tests' sake, these are.
    let run = |more: &[&str]| program().args(plane).args(more).env_remove("GALLIVM_PERF").output().unwrap();
    let report = json(&run(&["--json"]));
    assert_eq!(report["holds"], true);
    assert_eq!(report["cells"], 30);
    assert_eq!(report["checks"].as_array().unwrap().len(), 6);
    assert_eq!(report["confusion"].as_array().unwrap().len(), 9);
    assert_eq!(keys(&report["tipped"]), ["cells", "inside", "non_chaotic"]);
    let text = run(&[]);
    assert_eq!(text.status.code(), Some(0));
    assert!(stdout(&text).contains("agreement inside regions") && !stdout(&text).contains("DOES NOT HOLD"));
}

/// With no Vulkan driver in sight (where Vulkan is the only way to a GPU).
#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_maps_run_on_the_cpu_and_validation_says_so() {
    let blind = |arguments: &[&str]| {
        let folder = tempdir().unwrap();
        let mut command = program();
        command.args(arguments).current_dir(folder.path());
        command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
        command.output().unwrap()
    };
    let map =
        blind(&small_map(&[]).into_iter().filter(|a| *a != "--backend" && *a != "cpu").collect::<Vec<_>>());
    assert_eq!(map.status.code(), Some(0), "{}", stderr(&map));
    assert!(stderr(&map).contains("computing on cpu"), "{}", stderr(&map));
    assert!(stderr(&map).contains("no hardware GPU was found"), "{}", stderr(&map));
    for arguments in [vec!["validate", "--cells", "30"], vec!["classify", "--backend", "gpu"]] {
        let output = blind(&arguments);
        assert_eq!(output.status.code(), Some(3), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("adapter"), "{}", stderr(&output));
    }
    let adapters = blind(&["adapters", "--json"]);
    assert_eq!(json(&adapters), Value::Array(Vec::new()));
}

#[test]
fn adapters_are_listed() {
    let output = run(&["adapters", "--json"]);
    for adapter in json(&output).as_array().unwrap() {
        assert_eq!(keys(adapter), ["api", "driver", "kind", "name", "pci"]);
    }
    assert_eq!(run(&["adapters"]).status.code(), Some(0));
}

#[test]
fn help_has_examples() {
    for command in ["map", "classify", "orbit", "validate", "adapters"] {
        let output = run(&[command, "--help"]);
        assert_eq!(output.status.code(), Some(0));
        assert!(stdout(&output).contains(&format!("  impact-atlas {command}")), "{}", stdout(&output));
    }
    assert!(stdout(&run(&["--help"])).contains("N-p-q"));
}

#[cfg(unix)]
mod unix {
    use super::*;

    /// Waits, but not for ever.
    fn wait(child: &mut std::process::Child) -> i32 {
        let began = Instant::now();
        loop {
            if let Some(status) = child.try_wait().unwrap() {
                return status.code().expect("the process ends by itself");
            }
            assert!(began.elapsed() < Duration::from_secs(30), "still running");
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    fn interrupted(arguments: &[&str]) {
        let folder = tempdir().unwrap();
        fs::write(folder.path().join("map.png"), "old").unwrap();
        let mut command = program();
        command.args(arguments).current_dir(folder.path()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        std::thread::sleep(Duration::from_millis(700));
        assert!(child.try_wait().unwrap().is_none(), "{arguments:?} was over too soon");
        let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        assert_eq!(wait(&mut child), 130, "{arguments:?}");
        let mut message = String::new();
        child.stderr.take().unwrap().read_to_string(&mut message).unwrap();
        assert!(message.contains("interrupted"), "{message}");
        assert_eq!(names(folder.path()), ["map.png"]);
        assert_eq!(fs::read_to_string(folder.path().join("map.png")).unwrap(), "old");
    }

    #[test]
    fn ctrl_c_leaves_nothing_behind() {
        interrupted(&["map", "--backend", "cpu", "--fixed-periods", "--force"]);
        interrupted(&["validate", "--fixed-periods"]);
        interrupted(&["classify", "--backend", "cpu", "--transient", "100000000", "--set", "omega=2.83"]);
        interrupted(&["orbit", "--transient", "100000000", "--impacts", "i.csv", "--set", "omega=2.83"]);
    }

    #[test]
    fn a_reader_that_has_gone_away_is_no_error() {
        let mut command = program();
        command.args(["classify", "--backend", "cpu"]).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        drop(child.stdout.take());
        assert_eq!(wait(&mut child), 0);
        let mut message = String::new();
        child.stderr.take().unwrap().read_to_string(&mut message).unwrap();
        assert!(!message.contains("panicked") && !message.contains("error"), "{message}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_the_machines_matter() {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = program();
        command.args(["classify", "--backend", "cpu"]).stdout(full).stderr(Stdio::piped());
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(3));
        assert!(stderr(&output).contains("standard output"), "{}", stderr(&output));
    }

    #[test]
    fn directories_without_permission_are_refused() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempdir().unwrap();
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
        let map = folder.path().join("map.png");
        if fs::write(folder.path().join("probe"), "").is_ok() {
            return; // a superuser may write anywhere
        }
        refuses(&["map", "--out", map.to_str().unwrap()], &["map.png"]);
    }
}
