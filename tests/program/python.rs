//! The files as Python reads them: numpy, xarray and zarr, installed from tests/python/requirements.txt.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use impact_atlas::plane::fields::{CellField, Cells, Extras, Inner};
use impact_atlas::store::ZarrStore;
use serde_json::{Value, json};
use tempfile::{TempDir, tempdir};

use crate::run::{run_in, stderr, stdout};

const PLANE: &str = "--backend cpu --x omega=2.6:3.9:13 --y delta=0.05:0.3:9 --transient 60 --observe 40 --certify \
     --extents";

fn here() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The Python with the packages: that of `target/python`, otherwise the system's.
fn python(arguments: &[&Path]) -> Output {
    let own = here().join("target/python/bin/python");
    let name = if own.exists() { own } else { "python3".into() };
    let output = Command::new(&name).args(arguments).output();
    output.unwrap_or_else(|error| panic!("{} cannot be run: {error}", name.display()))
}

fn needs_packages() {
    let folder = tempdir().unwrap();
    let script = folder.path().join("imports.py");
    fs::write(&script, "import numpy, xarray, zarr").unwrap();
    let output = python(&[&script]);
    assert!(
        output.status.success(),
        "install the packages first:\n  python3 -m venv target/python && target/python/bin/pip install -r \
         tests/python/requirements.txt\n{}",
        stderr(&output)
    );
}

fn written(folder: &TempDir) {
    for data in ["map.npz", "plane.zarr"] {
        let mut words: Vec<&str> = vec!["map"];
        words.extend(PLANE.split_whitespace());
        words.extend(["--data", data]);
        words.extend(if data == "map.npz" { ["--out", "map.png"] } else { ["--tile", "5"] });
        let output = run_in(folder.path(), &words);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
}

/// What the table of fields and the plane say the files hold.
fn expected(folder: &TempDir) -> Value {
    let store = ZarrStore::open(&folder.path().join("plane.zarr")).unwrap();
    let plane = Cells::plane(&store);
    let family = plane.parameters.family();
    let field = |field: &CellField| {
        let sizes = field.inner.dimensions(family);
        let names = match field.inner {
            Inner::One => None,
            Inner::Stops => Some(vec!["Ā", "A"]),
            Inner::Components => Some(vec!["x1", "x2", "v1", "v2"]),
            Inner::Coordinates => Some(vec!["x1", "x2"]),
            Inner::Multipliers => Some(vec!["real", "imaginary"]),
        };
        json!({
            "name": field.name,
            "kind": field.kind().name(),
            "unit": field.unit,
            "title": field.title,
            "meaning": field.meaning,
            "dimensions": sizes.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "sizes": sizes.iter().map(|(_, size)| size).collect::<Vec<_>>(),
            "names": names,
        })
    };
    let axis = |axis: &impact_atlas::plane::Axis| json!({ "quantity": axis.quantity.name(), "values": axis.values() });
    json!({
        "rows": plane.y.count,
        "columns": plane.x.count,
        "tile": store.tiling().side,
        "fields": CellField::of_plane(Extras { certified: true, extents: true }).map(field).collect::<Vec<_>>(),
        "x": axis(&plane.x),
        "y": axis(&plane.y),
        "version": env!("CARGO_PKG_VERSION"),
        "backend": store.provenance().backend,
        "adapter": store.provenance().adapter,
    })
}

#[test]
fn python_opens_both_files_without_a_word_of_explanation() {
    needs_packages();
    let folder = tempdir().unwrap();
    written(&folder);
    let path = |name: &str| folder.path().join(name);
    let check = |expected: &Value| {
        fs::write(path("expected.json"), expected.to_string()).unwrap();
        let script = here().join("tests/python/check.py");
        python(&[&script, &path("map.npz"), &path("plane.zarr"), &path("expected.json")])
    };
    let expected = expected(&folder);
    let output = check(&expected);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("of 117 cells"), "{}", stdout(&output));
    // The script would notice another unit, another value of an axis, another field.
    for (place, value) in [
        ("/fields/3/unit", json!("metres")),
        ("/x/values/1", json!(2.0)),
        ("/fields/0/kind", json!("u16")),
        ("/adapter", json!("another")),
    ] {
        let mut other = expected.clone();
        *other.pointer_mut(place).unwrap() = value;
        assert!(!check(&other).status.success(), "{place}");
    }
}
