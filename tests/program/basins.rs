//! Planes of starts wider than what lies between the stops: `map`, its pictures, its stores and the explorer tell what is
//! inadmissible, and refuse only where nothing begins.

use std::fs::{self, File};
use std::path::Path;

use impact_atlas::analysis::Regime;
use impact_atlas::plane::fields::Layer;
use impact_atlas::plane::{RegionMap, Window};
use impact_atlas::store::read_map;
use npyz::NpyFile;
use serde_json::{Value, json};
use tempfile::tempdir;
use zip::ZipArchive;

use crate::explore::server::Explorer;
use crate::explore::socket::{Heard, Socket};
use crate::run::{done, json, refuses, run_in, stderr};

/// The gap is 0.1: two columns in three lie beyond a stop.
const PLANE: &str =
    "--backend cpu --x x1=-0.32:0.28:16 --y v1=-1:1:5 --transient 40 --observe 40 --max-period 8";

/// What is asked of cells whose ends are compared.
const BASIN: &str = "--transient 400 --observe 60 --max-period 8 --data map.npz";

fn map_of(folder: &Path) -> RegionMap {
    read_map(File::open(folder.join("map.npz")).unwrap()).unwrap()
}

/// Checks that the cells beyond the gap are inadmissible, and no others; how many they are.
fn inadmissible(map: &RegionMap) -> usize {
    let places = Window::whole(&map.plane).places();
    let found = places.zip(&map.verdicts).filter(|((column, row), verdict)| {
        let beyond = map.plane.x.value(*column).abs() > 0.1;
        assert_eq!(verdict.regime == Regime::Inadmissible, beyond, "column {column}, row {row}");
        beyond
    });
    found.count()
}

#[test]
fn a_basin_shows_what_is_inadmissible() {
    let folder = tempdir().unwrap();
    let words: Vec<&str> =
        "map --json --data map.npz --extents --certify".split(' ').chain(PLANE.split(' ')).collect();
    let told = json(&run_in(folder.path(), &words));
    let map = map_of(folder.path());
    let cells = inadmissible(&map);
    assert_eq!((told["regimes"]["inadmissible start"].as_u64(), cells), (Some(55), 55));
    // The legend names it, and so does the key of a layer; a part without such cells names none.
    for layer in ["motion", "peak_impact_velocity", "rms.x1"] {
        let drawn = |part: &str| {
            done(folder.path(), &format!("render map.npz --force --layer {layer} --out part.svg {part}"));
            fs::read_to_string(folder.path().join("part.svg")).unwrap().contains("inadmissible start")
        };
        assert!(drawn("") && !drawn("--x=-0.09:0.09"), "{layer}");
    }
    // In a store it is the same, whatever the tiles.
    done(folder.path(), &format!("map --data plane.zarr --tile 4 --out store.png {PLANE}"));
    done(folder.path(), &format!("map --force --data map.npz --out map.png {PLANE}"));
    let pixels = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb8();
    assert!(pixels("store.png") == pixels("map.png"));
    // One cell of it, asked for alone, is refused with the reason.
    let refused = run_in(folder.path(), &["classify", "--from", "map.npz", "--at", "x1=0.2,v1=0"]);
    assert_eq!(refused.status.code(), Some(2));
    let message = stderr(&refused);
    assert!(
        message.contains("lies beyond stop A") && message.contains("choose another by --at"),
        "{message}"
    );
}

/// A motion and its mirror image have one label: where a cell ends tells them apart.
#[test]
fn basins_of_a_motion_and_its_mirror_image_are_told_apart_by_the_end_state() {
    let folder = tempdir().unwrap();
    done(
        folder.path(),
        &format!("map --backend cpu --set omega=1.65 --x x1=-0.16:0.16:17 --y v1=-1.5:1.5:9 {BASIN}"),
    );
    let map = map_of(folder.path());
    let layer = Layer::named("state.v1", map.plane.parameters.family()).unwrap();
    let numbers = layer.values(&map, Window::whole(&map.plane)).unwrap();
    // The paper's 1-2-2 motion is unsymmetric there; its image is half a period later in the forcing, and as far from the middle.
    let settled = &map.verdicts[map.verdicts.len() / 2];
    assert_eq!((settled.n, settled.counts.to_vec(), settled.symmetric), (1, vec![2, 2], false));
    let mut ends: Vec<f32> = Vec::new();
    for ((place, verdict), number) in Window::whole(&map.plane).places().zip(&map.verdicts).zip(numbers) {
        if map.plane.x.value(place.0).abs() > 0.1 {
            assert!(number.is_nan(), "where nothing moved no state is at the end: {number}");
            continue;
        }
        assert_eq!((verdict.n, &verdict.counts), (settled.n, &settled.counts));
        if ends.iter().all(|end| (end - number).abs() > 1e-4) {
            ends.push(number);
        }
    }
    assert_eq!(ends.len(), 2, "{ends:?}");
    let drawn = |layer: &str| {
        done(folder.path(), &format!("render map.npz --force --layer {layer} --out basins.svg"));
        fs::read_to_string(folder.path().join("basins.svg")).unwrap()
    };
    assert!(drawn("state.v1").contains("state at the end, v1") && drawn("state.v1") != drawn("state.x2"));
}

#[test]
fn a_plane_that_begins_nowhere_is_refused() {
    let plane = "map --backend cpu --x x1=0.2:0.3:5 --y v1=-1:1:5";
    refuses(
        &plane.split(' ').collect::<Vec<_>>(),
        &["no cell of the plane begins", "lies beyond stop", "x1 = 0.2"],
    );
    let fixed = "map --backend cpu --x omega=2:3:3 --y r=0.5:0.9:3 --start 0.2,0,0,0";
    refuses(&fixed.split(' ').collect::<Vec<_>>(), &["no cell of the plane begins", "0.2"]);
}

/// A diagram over starts has nothing to show where none begins, and goes on where one does.
#[test]
fn a_diagram_over_starts_leaves_out_what_is_inadmissible() {
    let folder = tempdir().unwrap();
    let diagram =
        "bifurcation --backend cpu --x x1=-0.3:0.3:31 --transient 40 --observe 24 --spectrum --data d.npz";
    done(folder.path(), diagram);
    let mut zip = ZipArchive::new(File::open(folder.path().join("d.npz")).unwrap()).unwrap();
    let regimes = NpyFile::new(zip.by_name("regime.npy").unwrap()).unwrap().into_vec::<u8>().unwrap();
    let counts = NpyFile::new(zip.by_name("counts.npy").unwrap()).unwrap().into_vec::<u32>().unwrap();
    // ±0.1 lies on the stops, however the axis rounds it.
    for (column, (regime, count)) in regimes.iter().zip(&counts).enumerate() {
        let begins = (10..=20).contains(&column);
        assert_eq!((*regime != Regime::Inadmissible.code(), *count > 0), (begins, begins), "column {column}");
    }
    let spectrum = NpyFile::new(zip.by_name("spectrum.npy").unwrap()).unwrap().into_vec::<f64>().unwrap();
    assert!(spectrum[..40].iter().all(|exponent| exponent.is_nan()) && !spectrum[60].is_nan());
}

#[tokio::test(flavor = "multi_thread")]
async fn the_explorer_shows_what_is_inadmissible_and_why() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), PLANE);
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await;
    let want = json!({ "type": "want", "scene": scene["scene"], "tiles": [[0, 0, 0]] });
    socket.send(want.to_string()).await;
    let motions = socket.text("motions").await["motions"].as_array().unwrap().clone();
    let (beyond, others): (Vec<Value>, Vec<Value>) =
        motions.into_iter().partition(|motion| motion["begins"] == false);
    assert_eq!(beyond.len(), 1);
    assert_eq!(beyond[0]["name"], "inadmissible start");
    assert!(!others.is_empty() && others.iter().all(|motion| motion["begins"] == true));
    socket.tile().await;
    // A click on it says why; what is taken along is what `map` makes.
    let probe =
        json!({ "type": "probe", "ask": 2, "scene": scene["scene"], "cell": [0, 1, 2], "width": 400 });
    socket.send(probe.to_string()).await;
    let refused = loop {
        match socket.hear().await {
            Heard::Text(value) if value["type"] == "refused" => break value,
            Heard::Closed => panic!("closed"),
            _ => {}
        }
    };
    let message = refused["message"].as_str().unwrap();
    assert!(
        message.contains("no motion begins at x1 = ") && message.contains("lies beyond stop"),
        "{message}"
    );
    let window = json!({ "z": 0, "columns": [0, 15], "rows": [0, 4] });
    let save = json!({
        "type": "save", "ask": 3, "scene": scene["scene"], "window": window, "format": "npz", "size": [900, 700],
        "curves": null
    });
    socket.send(save.to_string()).await;
    let saved = read_map(std::io::Cursor::new(socket.file().await)).unwrap();
    assert_eq!(inadmissible(&saved), 55);
    done(folder.path(), &format!("map --data map.npz {PLANE}"));
    assert_eq!(format!("{:?}", saved.verdicts), format!("{:?}", map_of(folder.path()).verdicts));
}
