//! The same bits everywhere: `--reproducible`.

use std::fs::File;

use npyz::NpyFile;
use tempfile::tempdir;

use crate::run::{done, json, refuses, run, stderr, stdout, words};

const PLANE: &str = "--x omega=0.4:4:14 --y delta=0.02:0.4:9 --transient 60 --observe 48";

/// A map's states and exponents as their bits, and what computed it.
fn map(options: &str) -> (Vec<u64>, Vec<u32>, String) {
    let folder = tempdir().unwrap();
    let said = stderr(&done(folder.path(), &format!("map {PLANE} {options} --out map.png")));
    let file = File::open(folder.path().join("map.npz")).unwrap();
    let mut archive = zip::ZipArchive::new(file).unwrap();
    let states = NpyFile::new(archive.by_name("state.npy").unwrap()).unwrap().into_vec::<f64>().unwrap();
    let exponents =
        NpyFile::new(archive.by_name("lyapunov.npy").unwrap()).unwrap().into_vec::<f32>().unwrap();
    (
        states.into_iter().map(f64::to_bits).collect(),
        exponents.into_iter().map(f32::to_bits).collect(),
        said.lines().find(|line| line.contains("computing on")).unwrap().to_owned(),
    )
}

#[test]
fn maps_have_the_same_bits_on_an_adapter_and_on_the_cpu() {
    let (states, exponents, said) = map("--backend gpu --reproducible");
    assert!(said.ends_with(", reproducible"), "{said}");
    let (twins_states, twins_exponents, said) = map("--backend cpu --reproducible");
    assert!(said.contains("f32, reproducible"), "{said}");
    assert!(states == twins_states && exponents == twins_exponents);
    // Without it neither the adapter nor the CPU has these bits.
    for other in ["--backend gpu", "--backend cpu"] {
        assert!(map(other).0 != states, "{other}");
    }
}

#[test]
fn an_adapter_is_held_to_the_bits() {
    let output = run(&words(&format!("validate --reproducible {PLANE}")));
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(stdout(&output).trim(), "126 of 126 cells have the same bits");
    let report = json(&run(&words(&format!("validate --reproducible {PLANE} --json"))));
    assert_eq!((report["cells"].as_u64(), report["differing"].as_u64()), (Some(126), Some(0)));
    refuses(&words("validate --reproducible --curves"), &["--reproducible", "--curves"]);
    refuses(&words("explore --reproducible"), &["--reproducible", "map"]);
}

#[test]
fn a_cell_of_a_reproducible_map_is_asked_about_as_it_was_computed() {
    let folder = tempdir().unwrap();
    done(folder.path(), &format!("map {PLANE} --backend cpu --reproducible --out map.png"));
    let told = done(folder.path(), "classify --from map.png --at omega=4,delta=0.4 --json");
    assert!(json(&told)["adapter"].as_str().unwrap().ends_with("f32, reproducible"), "{}", stdout(&told));
}
