//! Layers of numbers behind the explorer: those of `map --layer`, with the values of `map`.

use std::fs::File;

use impact_atlas::plane::RegionMap;
use impact_atlas::store::read_map;
use serde_json::{Value, json};
use tempfile::tempdir;

use crate::explore::server::{Explorer, SMALL};
use crate::explore::socket::Socket;
use crate::run::done;

/// The cells along a tile's side, and the bytes before and in its fields.
const SIDE: usize = 16;
const NUMBERS: usize = 32 + SIDE * SIDE * 12;

/// Looks at tiles with a layer until they have come; the numbers of each.
async fn numbers(socket: &mut Socket, scene: &Value, layer: Value, tiles: &[[i64; 3]]) -> Vec<Vec<f32>> {
    let want = json!({ "type": "want", "scene": scene["scene"], "tiles": tiles, "layer": layer });
    socket.send(want.to_string()).await;
    // The number by which a tile says whose numbers it carries.
    let listed = scene["layers"].as_array().unwrap().iter().position(|other| other["name"] == layer);
    let place = listed.map_or(0, |at| at as u32 + 1);
    let mut came = Vec::new();
    while came.len() < tiles.len() {
        let bytes = socket.tile().await;
        assert_eq!(bytes[12..16], place.to_le_bytes());
        came.push(
            bytes[NUMBERS..].chunks(4).map(|word| f32::from_le_bytes(word.try_into().unwrap())).collect(),
        );
    }
    came
}

/// What a map has of the first tile: one value for each cell.
fn of_first_tile(map: &RegionMap, value: impl Fn(usize) -> f32) -> Vec<f32> {
    let columns = map.plane.x.count as usize;
    (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| row * columns + column)).map(value).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn how_far_motions_go_is_measured_when_it_is_looked_at() {
    let folder = tempdir().unwrap();
    done(folder.path(), &format!("map --extents --data map.npz {SMALL}"));
    let map = read_map(File::open(folder.path().join("map.npz")).unwrap()).unwrap();
    let extents = map.extents.as_deref().unwrap();

    let explorer = Explorer::start(folder.path(), SMALL);
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await;
    let named = |name: &str| scene["layers"].as_array().unwrap().iter().any(|layer| layer["name"] == name);
    assert!(named("rms.x1") && named("peak.x2") && named("lyapunov"), "{}", scene["layers"]);
    let first = [[0, 0, 0]];
    // Without a layer there are no numbers, and nothing is measured.
    let none = numbers(&mut socket, &scene, Value::Null, &first).await;
    assert!(none[0].iter().all(|number| number.is_nan()));
    let rms = numbers(&mut socket, &scene, json!("rms.x1"), &first).await;
    assert_eq!(rms[0], of_first_tile(&map, |cell| extents[cell].rms[0]));
    let peak = numbers(&mut socket, &scene, json!("peak.x2"), &[[0, 1, 0], [0, 0, 0]]).await;
    assert_eq!(peak[1], of_first_tile(&map, |cell| extents[cell].peak[1]));
    assert_ne!(peak[0], peak[1]);
    let window = json!({ "z": 0, "columns": [0, 95], "rows": [0, 71] });
    let bar = json!({
        "type": "bar", "ask": 5, "scene": scene["scene"], "layer": "rms.x1", "window": window, "length": 300, "em": 12
    });
    socket.send(bar.to_string()).await;
    assert!(socket.text("bar").await["content"].is_object());

    // Every component of the end state is a layer.
    assert!(named("state.x1") && named("state.v2"), "{}", scene["layers"]);
    let state = numbers(&mut socket, &scene, json!("state.v1"), &first).await;
    assert_eq!(state[0], of_first_tile(&map, |cell| map.verdicts[cell].state[2] as f32));

    // An archive that is taken along with the layer is that of `map`.
    let save = json!({
        "type": "save", "ask": 6, "scene": scene["scene"], "window": window, "format": "npz", "size": [900, 700],
        "curves": null, "layer": "rms.x1"
    });
    socket.send(save.to_string()).await;
    let saved = read_map(std::io::Cursor::new(socket.file().await)).unwrap();
    assert_eq!(saved.extents, map.extents);

    // Multipliers need every motion to be certified: that is `map`'s.
    let refused = json!({ "type": "want", "scene": scene["scene"], "tiles": first, "layer": "multiplier" });
    socket.send(refused.to_string()).await;
    let refused = loop {
        if let crate::explore::socket::Heard::Text(value) = socket.hear().await
            && value["type"] == "refused"
        {
            break value;
        }
    };
    assert!(refused["message"].as_str().unwrap().contains("multiplier"), "{refused}");
}
