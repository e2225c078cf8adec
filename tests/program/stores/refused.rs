//! What is refused, with its reason, and changes nothing.

use std::fs;

use tempfile::tempdir;

use super::{SMALL, files};
use crate::run::{done, names, refuses, run_in, stderr, words};

/// Checks that a command is refused in a folder with all of `parts` in the message.
fn refused(folder: &std::path::Path, command: &[&str], parts: &[&str]) {
    let before = names(folder);
    let output = run_in(folder, command);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{command:?}: {message}");
    for part in parts {
        assert!(message.contains(part), "{command:?}: no `{part}` in {message}");
    }
    assert_eq!(names(folder), before, "{command:?}");
}

#[test]
fn bad_parts_and_tiles_are_refused() {
    for part in ["0/0", "65/64", "0/4", "half", "-1/4"] {
        let option = format!("--part={part}");
        refuses(&["map", "--data", "plane.zarr", &option], &[part, "K/M", "from 1 to M"]);
    }
    refuses(&["map", "--part", "1/2"], &["--data"]);
    refuses(&["map", "--data", "map.npz", "--part", "1/2"], &["stores", "--data DATA.zarr"]);
    refuses(&["map", "--data", "plane.zarr", "--tile", "0"], &["--tile"]);
    refuses(&["map", "--data", "plane.zarr", "--tile", "9999"], &["--tile"]);
    refuses(&["map", "--data", "p.zarr", "--part", "1/2", "--out", "p.png"], &["draws nothing", "render"]);
    let plane = ["map", "--x", "omega=1:2:30000", "--y", "delta=0.1:0.2:30000"];
    refuses(&plane, &["900000000 cells", "--data DATA.zarr"]);
    refuses(&["map", "--control", "delay", "--y", "gain=0:1:4", "--data", "p.zarr"], &["npz"]);
}

#[test]
fn another_plane_and_stores_of_others_are_refused() {
    let folder = tempdir().unwrap();
    let root = folder.path();
    done(root, &format!("{SMALL} --data plane.zarr"));
    let before = files(&root.join("plane.zarr"));
    let other = format!("{SMALL} --data plane.zarr --set r=0.7");
    refused(root, &words(&other), &["parameters.r is 0.8 there and 0.7 here", "plane.zarr"]);
    let tiles = format!("{SMALL} --data plane.zarr --tile 5");
    refused(root, &words(&tiles), &["the tile is 16 there and 5 here"]);
    assert!(before == files(&root.join("plane.zarr")));

    fs::create_dir(root.join("other.zarr")).unwrap();
    fs::write(root.join("other.zarr/zarr.json"), r#"{"zarr_format":3,"node_type":"group"}"#).unwrap();
    refused(root, &words(&format!("{SMALL} --data other.zarr")), &["other.zarr", "another program"]);
    refused(root, &["status", "other.zarr"], &["another program"]);
    refused(root, &["render", "other.zarr", "--out", "o.png"], &["another program"]);
    refused(root, &["status", "none.zarr"], &["there is no store"]);
    refused(root, &["render", "none.npz", "--out", "o.png"], &["none.npz"]);
    fs::write(root.join("text.npz"), "text").unwrap();
    refused(root, &["render", "text.npz", "--out", "o.png"], &["text.npz"]);

    let about = fs::read_to_string(root.join("plane.zarr/zarr.json")).unwrap();
    let foreign = about.replace("\"impact_atlas_format\": 1", "\"impact_atlas_format\": 2");
    assert_ne!(about, foreign);
    fs::write(root.join("plane.zarr/zarr.json"), foreign).unwrap();
    refused(root, &["status", "plane.zarr"], &["format 2", "impact-atlas 0."]);
}

/// A ball over a stop at a gap that has no value at b = 0.
const DIVIDES: &str = r#"
name = "Divides"
[parameters]
b = 1
[system]
frequency = 1.3
mass = [[1]]
damping = [[0.2]]
stiffness = [[1]]
force_sin = [1]
[[stop]]
name = "A"
direction = [1]
gap = "0.1/b"
restitution = 0.7
"#;

#[test]
fn a_plane_without_systems_at_its_border_leaves_no_store() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("own.toml"), DIVIDES).unwrap();
    let command = |b: &str| {
        format!(
            "map --backend cpu --system own.toml --x b={b}:1:9 --y x1=-0.2:0:5 --transient 20 --observe 20 --data plane.zarr"
        )
    };
    refused(folder.path(), &words(&command("0")), &["divides by zero", "b = 0"]);
    done(folder.path(), &command("0.1"));
}

#[test]
fn a_truncated_shard_and_layers_that_are_not_there_are_refused() {
    let folder = tempdir().unwrap();
    let root = folder.path();
    done(root, &format!("{SMALL} --data plane.zarr"));
    let render = |more: &[&str], parts: &[&str]| {
        refused(root, &[&["render", "plane.zarr", "--out", "o.png"], more].concat(), parts);
    };
    render(&["--layer", "colour"], &["no layer `colour`", "motion", "lyapunov"]);
    render(&["--palette", "viridis"], &["colours of their own", "--layer"]);
    render(&["--layer", "n", "--palette", "rainbow"], &["viridis"]);
    render(&["--layer", "n", "--range", "0:4"], &["--range must begin above 0"]);
    render(&["--x", "7:9"], &["holds none of the cells", "omega=2.6:3.9:12"]);
    render(&["--x", "7"], &["A:B"]);
    render(&["--curves", "none.csv"], &["none.csv"]);
    refused(root, &["render", "map.png", "--out", "o.png"], &["map.png", "map.npz"]);
    fs::write(root.join("bad.csv"), "a,b\n1,2\n").unwrap();
    render(&["--curves", "bad.csv"], &["columns"]);
    let header = "curve,kind,motion,x,y,criticality,point,symmetric,bounding";
    for (row, parts) in [
        ("1,fold,1-1-1,3,0.1,supper,ordinary,true,true", ["line 2", "`supper` in criticality"]),
        ("1,fold,1-1-1,3,0.1,,special,true,true", ["line 2", "`special` in point"]),
        ("1,fold,1-1-1,3,0.1,,ordinary,true,perhaps", ["line 2", "neither true nor false in bounding"]),
        ("1,fold,1-1-1,3,0.1,,ordinary,1,true", ["line 2", "neither true nor false in symmetric"]),
    ] {
        fs::write(root.join("bad.csv"), format!("{header}\n{row}\n")).unwrap();
        render(&["--curves", "bad.csv"], &parts);
    }
    render(&["--curves", "bad.csv", "--curves-max-period", "3"], &["--curves-max-period 3", "bad.csv"]);
    let shard = root.join("plane.zarr/n/c/0/0");
    let bytes = fs::read(&shard).unwrap();
    fs::write(&shard, &bytes[..bytes.len() / 2]).unwrap();
    render(&[], &["n/c/0/0", "damaged", "delete it"]);
    // The same command computes it again.
    done(root, &format!("{SMALL} --data plane.zarr"));
    assert_eq!(fs::read(&shard).unwrap(), bytes);
    refused(root, &words(&format!("{SMALL} --data plane.zarr --curves")), &["--curves", "--out"]);
    for option in ["--title=a", "--size=300x300", "--layer=lyapunov", "--no-legend"] {
        let name = option.split('=').next().unwrap();
        refused(root, &words(&format!("{SMALL} --data plane.zarr {option}")), &[name, "--out"]);
    }
}
