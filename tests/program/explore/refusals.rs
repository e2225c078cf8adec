//! Bad input: a clear message and the right exit code; and what is taken along is what `map` makes.

use std::fs;
use std::io::Cursor;
use std::net::TcpListener;

use impact_atlas::backend::{Unwatched, open};
use impact_atlas::store::read_map;
use impact_atlas::sweep::sweep;
use serde_json::json;
use tempfile::tempdir;

use crate::explore::server::{Explorer, SMALL};
use crate::explore::socket::Socket;
use crate::run::{done, run_in};

#[test]
fn bad_input_has_a_clear_message() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("other.npz"), b"PK\x05\x06 not a map").unwrap();
    fs::write(folder.path().join("text.npz"), "hello").unwrap();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let cases: [(&[&str], i32, &[&str]); 8] = [
        (&["--port", &port], 3, &["cannot listen on port", &port, "--port"]),
        (&["--data", "none.npz"], 2, &["cannot read `none.npz`"]),
        (&["--data", "other.npz"], 2, &["other.npz", "that `map` wrote"]),
        (&["--data", "text.npz"], 2, &["text.npz", "that `map` wrote"]),
        (&["--x", "omega=1:1:1"], 2, &["no extent"]),
        (&["--x", "omgea=1:2:9"], 2, &["omgea"]),
        (&["--data", "other.npz", "--x", "omega=1:2:3"], 2, &["--data"]),
        (&["--backend", "cpu", "--adapter", "x"], 2, &["--adapter"]),
    ];
    for (arguments, code, parts) in cases {
        let output = run_in(folder.path(), &[&["explore"], arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        for part in parts {
            assert!(said.contains(part), "{arguments:?}: no `{part}` in {said}");
        }
    }
}

/// A question about a window of the whole plane.
fn whole(kind: &str, scene: &serde_json::Value, more: serde_json::Value) -> String {
    let count = |side: &str| scene[side]["count"].as_i64().unwrap() - 1;
    let window = json!({ "z": 0, "columns": [0, count("x")], "rows": [0, count("y")] });
    let mut message = json!({ "type": kind, "ask": 3, "scene": scene["scene"], "window": window, "size": [800, 600],
        "curves": null });
    message.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    message.to_string()
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_taken_along_is_what_map_makes() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await;
    // Some cells are computed as tiles before, of every level.
    let tiles = json!([[-2, 0, 0], [-1, 0, 0], [0, 0, 0], [0, 1, 1]]);
    socket.send(json!({ "type": "want", "scene": scene["scene"], "tiles": tiles }).to_string()).await;
    for _ in 0..4 {
        socket.tile().await;
    }
    socket.send(whole("command", &scene, json!({}))).await;
    let command = socket.text("command").await["content"]["text"].as_str().unwrap().to_owned();
    socket.send(whole("save", &scene, json!({ "format": "npz" }))).await;
    let saved = socket.file().await;
    socket.send(whole("save", &scene, json!({ "format": "png", "ask": 4 }))).await;
    let picture = socket.file().await;
    done(folder.path(), command.strip_prefix("impact-atlas ").unwrap());
    assert_eq!(fs::read(folder.path().join("map.npz")).unwrap(), saved, "{command}");
    // The picture of `map` carries its command beside its configuration.
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).unwrap().into_rgb8();
    assert!(pixels(&fs::read(folder.path().join("map.png")).unwrap()) == pixels(&picture), "{command}");
    // A map that was written is explored, and its cells are those of the file.
    let again = Explorer::start(folder.path(), "--data map.npz --backend cpu");
    let (mut socket, hello) = Socket::connect(&again).await;
    let scene = socket.open(&hello).await;
    assert_eq!((&scene["x"]["count"], &scene["y"]["count"]), (&json!(96), &json!(72)));
    socket.send(whole("save", &scene, json!({ "format": "npz" }))).await;
    assert_eq!(socket.file().await, saved);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_part_that_is_taken_along_is_computed_at_its_own_values() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await;
    let tiles = json!([[1, 0, 0], [1, 1, 0], [1, 0, 1], [1, 1, 1]]);
    socket.send(json!({ "type": "want", "scene": scene["scene"], "tiles": tiles }).to_string()).await;
    for _ in 0..4 {
        socket.tile().await;
    }
    let window = json!({ "z": 1, "columns": [3, 29], "rows": [2, 21] });
    socket.send(whole("save", &scene, json!({ "format": "npz", "window": window }))).await;
    let map = read_map(Cursor::new(socket.file().await)).unwrap();
    let cpu = open(impact_atlas::backend::Choice::Cpu, None).unwrap();
    let fresh = sweep(&map.plane, &*cpu, &Unwatched).unwrap();
    let states =
        |map: &impact_atlas::plane::RegionMap| map.verdicts.iter().map(|v| v.state).collect::<Vec<_>>();
    assert_eq!(states(&map), states(&fresh));
    assert_eq!(map.verdicts.len(), 27 * 20);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_store_is_explored_as_far_as_it_is_there() {
    let folder = tempdir().unwrap();
    done(folder.path(), &format!("map --data plane.zarr --tile 32 --part 1/2 {SMALL}"));
    let explorer = Explorer::start(folder.path(), "--data plane.zarr --backend cpu");
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await;
    assert_eq!((&scene["x"]["count"], &scene["y"]["count"]), (&json!(96), &json!(72)));
    socket.send(whole("save", &scene, json!({ "format": "npz" }))).await;
    let map = read_map(Cursor::new(socket.file().await)).unwrap();
    let cpu = open(impact_atlas::backend::Choice::Cpu, None).unwrap();
    let fresh = sweep(&map.plane, &*cpu, &Unwatched).unwrap();
    assert!(map.verdicts.iter().zip(&fresh.verdicts).all(|(a, b)| a.state == b.state));
}
