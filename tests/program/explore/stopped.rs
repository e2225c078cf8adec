//! What nobody wants any more is not computed any further.

use std::time::{Duration, Instant};

use serde_json::json;
use tempfile::tempdir;

use crate::explore::server::Explorer;
use crate::explore::socket::{Heard, Socket};

/// The paper's whole plane, whose curves take many seconds.
const PLANE: &str = "--backend cpu --x omega=0.2:5:120 --y delta=0.02:0.8:90 --transient 80 --observe 48";

/// Asks for the curves of the whole plane, and hears that they are being followed.
async fn begun(socket: &mut Socket, scene: u64) {
    let window = json!({ "z": 0, "columns": [0, 119], "rows": [0, 89] });
    let curves = json!({ "type": "curves", "ask": 8, "scene": scene, "window": window, "max_period": 2, "all": false });
    socket.send(curves.to_string()).await;
    loop {
        let Heard::Text(said) = socket.hear().await else { panic!("no progress") };
        if said["what"].as_str().is_some_and(|what| what.contains("curves")) {
            return;
        }
    }
}

/// Processor time over a while, as a share of one processor.
async fn load(explorer: &Explorer) -> f64 {
    let (before, began) = (explorer.processor_time(), Instant::now());
    tokio::time::sleep(Duration::from_millis(1500)).await;
    (explorer.processor_time() - before).as_secs_f64() / began.elapsed().as_secs_f64()
}

#[tokio::test(flavor = "multi_thread")]
async fn curves_that_are_stopped_are_followed_no_further() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), PLANE);
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await["scene"].as_u64().unwrap();
    begun(&mut socket, scene).await;
    let busy = load(&explorer).await;
    // The machine may have others to serve.
    assert!(busy > 0.1, "they are not being followed: {busy}");
    let began = Instant::now();
    socket.send(json!({ "type": "cancel", "ask": 8 }).to_string()).await;
    socket.text("done").await;
    assert!(began.elapsed() < Duration::from_secs(2), "{:?}", began.elapsed());
    let idle = load(&explorer).await;
    assert!(idle < 0.05, "they are still being followed: {idle}");
    // A page that is gone wants nothing any more.
    begun(&mut socket, scene).await;
    drop(socket);
    tokio::time::sleep(Duration::from_secs(2)).await;
    let idle = load(&explorer).await;
    assert!(idle < 0.05, "they are still being followed: {idle}");
}
