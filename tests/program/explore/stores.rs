//! Stores behind the explorer: read as far as they are looked at, and completed by what is computed.

use std::fs;
use std::path::Path;

use impact_atlas::analysis::{Counts, Measures, Regime, Schedule, Verdict};
use impact_atlas::backend::Cpu;
use impact_atlas::plane::fields::Extras;
use impact_atlas::plane::{Plane, Start};
use impact_atlas::store::{Wanted, ZarrStore};
use impact_atlas::sweep::provenance;
use serde_json::{Value, json};
use tempfile::tempdir;

use crate::explore::server::{Explorer, SMALL};
use crate::explore::socket::Socket;
use crate::run::{self, json, run_in};

fn map(folder: &Path, more: &[&str]) {
    run::done(folder, &format!("map --tile 32 {} {SMALL}", more.join(" ")));
}

fn done(folder: &Path, store: &str) -> u64 {
    json(&run_in(folder, &["status", store, "--json"]))["done"].as_u64().unwrap()
}

/// Every file of a store but its logs, with its bytes.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if name == ".impact-atlas" {
            continue;
        }
        if path.is_dir() {
            let own = files(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes));
            found.extend(own);
        } else {
            found.push((name, fs::read(&path).unwrap()));
        }
    }
    found.sort();
    found
}

/// Looks at some tiles until all have come.
async fn look(socket: &mut Socket, scene: &Value, tiles: &[[i64; 3]]) -> Vec<Vec<u8>> {
    socket.send(json!({ "type": "want", "scene": scene["scene"], "tiles": tiles }).to_string()).await;
    let mut came = Vec::new();
    while came.len() < tiles.len() {
        came.push(socket.tile().await);
    }
    came
}

#[tokio::test(flavor = "multi_thread")]
async fn what_the_explorer_computes_is_kept_in_the_store() {
    let folder = tempdir().unwrap();
    map(folder.path(), &["--data", "whole.zarr"]);
    map(folder.path(), &["--data", "plane.zarr", "--part", "1/3"]);
    let before = done(folder.path(), "plane.zarr");
    assert!(before < 9, "{before}");
    let explorer = Explorer::start(folder.path(), "--data plane.zarr --backend cpu");
    let (mut socket, hello) = Socket::connect(&explorer).await;
    // Of another plane, or of a part of a tile, nothing is kept.
    let mut other = hello["plane"].clone();
    other["set"]["r"] = json!(0.7);
    socket.send(json!({ "type": "open", "ask": 4, "plane": other }).to_string()).await;
    let other = socket.text("scene").await["content"].clone();
    let all: Vec<[i64; 3]> = (0..30).map(|k| [0, k % 6, k / 6]).collect();
    look(&mut socket, &other, &all).await;
    let scene = socket.open(&hello).await;
    look(&mut socket, &scene, &all[..6]).await;
    assert_eq!(done(folder.path(), "plane.zarr"), before);
    // Of the store's own plane every tile is, once all its cells are there.
    look(&mut socket, &scene, &all[6..]).await;
    look(&mut socket, &scene, &[[-2, 0, 0]]).await;
    assert_eq!(done(folder.path(), "plane.zarr"), 9);
    drop(explorer);
    let (kept, undisturbed) =
        (files(&folder.path().join("plane.zarr")), files(&folder.path().join("whole.zarr")));
    assert!(kept == undisturbed, "the store differs from that of an undisturbed run");
    assert!(kept.len() > 100, "{}", kept.len());
}

/// A verdict that no cell of the plane has.
fn mark() -> Verdict {
    Verdict {
        regime: Regime::Periodic,
        n: 77,
        counts: Counts::new(&[5, 6]),
        symmetric: false,
        lyapunov: -0.5,
        state: [0.0; 4].into(),
        impacts: 9,
        impacts_total: 9,
        peak_impact_velocity: 1.0,
        periods: 99,
        returning: 0,
        measures: Measures::default(),
    }
}

/// N of every cell of a tile's message.
fn ns(tile: &[u8]) -> Vec<u16> {
    tile[32 + 512..32 + 1024].chunks(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_store_of_more_cells_than_memory_is_read_where_it_is_looked_at() {
    let folder = tempdir().unwrap();
    let plane = Plane {
        x: "omega=2:4:20000".parse().unwrap(),
        y: "delta=0.05:0.3:15000".parse().unwrap(),
        parameters: impact_atlas::model::Parameters::default().into(),
        start: Start::Rest,
        task: Schedule { transient: 20, observe: 16, max_period: 4, fixed_periods: true },
    };
    let made = provenance(&Cpu);
    let wanted = Wanted { plane: &plane, provenance: &made, extras: Extras::NONE, tile: Some(128) };
    let store = ZarrStore::of(&folder.path().join("large.zarr"), &wanted).unwrap();
    store.write_tile(0, &vec![mark(); 128 * 128].into()).unwrap();
    let explorer = Explorer::start(folder.path(), "--data large.zarr --backend cpu");
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await;
    assert_eq!(scene["x"]["count"], 20000);
    // From afar the tile is not worth reading: its one cell is computed.
    let far = look(&mut socket, &scene, &[[-10, 0, 0]]).await;
    assert!(ns(&far[0]).iter().all(|&n| n != 77), "{:?}", ns(&far[0]));
    // Close up it is read.
    let near = look(&mut socket, &scene, &[[0, 7, 7], [0, 8, 7], [-1, 0, 0]]).await;
    let count = |tile: &Vec<u8>| ns(tile).into_iter().filter(|&n| n == 77).count();
    let mut counts: Vec<usize> = near.iter().map(count).collect();
    counts.sort_unstable();
    assert_eq!(counts, [0, 256, 256]);
    assert!(explorer.memory() < 500_000_000, "{} bytes", explorer.memory());
    // A shard that is damaged within is told, not shown; one that was cut off is not there.
    let shard = folder.path().join("large.zarr/state/c/0/1/0");
    store.write_tile(1, &vec![mark(); 128 * 128].into()).unwrap();
    let bytes = fs::read(&shard).unwrap();
    fs::write(&shard, [&bytes[..5], &[!bytes[5]], &bytes[6..]].concat()).unwrap();
    socket.send(json!({ "type": "want", "scene": scene["scene"], "tiles": [[0, 9, 0]] }).to_string()).await;
    let told = socket.text("failed").await["message"].as_str().unwrap().to_owned();
    assert!(told.contains("large.zarr") && told.contains("damaged"), "{told}");
}
