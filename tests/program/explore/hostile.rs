//! More than a hundred hostile requests: no panic, no hang, no file read or written, and everybody else is served.

use std::fs;
use std::time::Duration;

use serde_json::json;
use tempfile::tempdir;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::timeout;

use crate::explore::server::{Explorer, SMALL};
use crate::explore::socket::{Heard, Socket};

/// Sends bytes as they are; what comes back within a moment.
async fn raw(port: u16, bytes: &[u8]) -> String {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).await.unwrap();
    let _ = stream.write_all(bytes).await;
    let mut answer = Vec::new();
    let _ = timeout(Duration::from_secs(3), stream.read_to_end(&mut answer)).await;
    String::from_utf8_lossy(&answer).into_owned()
}

fn request(path: &str, host: &str, more: &str) -> String {
    format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n")
}

/// Requests that must not get the page, nor a file.
fn outsiders(port: u16, token: &str) -> Vec<String> {
    let own = format!("127.0.0.1:{port}");
    let wrong =
        ["0".repeat(48), String::new(), "%00".into(), "..".into(), token[..47].into(), format!("{token}x")];
    let mut all: Vec<String> = wrong
        .iter()
        .flat_map(|token| {
            ["", "/", "/main.js", "/ws", "/font/Inter-Regular.otf"]
                .map(|part| request(&format!("/{token}{part}"), &own, ""))
        })
        .collect();
    let hosts =
        ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "", "127.0.0.1:x", "0.0.0.0", "a b"];
    all.extend(hosts.map(|host| request(&format!("/{token}/"), host, "")));
    let origins =
        ["http://evil.example", "null", "http://127.0.0.1:1", "file:///etc/passwd", "http://localhost"];
    let upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n\
                   Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    all.extend(
        origins
            .map(|origin| request(&format!("/{token}/ws"), &own, &format!("Origin: {origin}\r\n{upgrade}"))),
    );
    let paths = [
        "/../../../../etc/passwd",
        "/..%2f..%2f..%2fetc%2fpasswd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "//etc/passwd",
        "/main.js/../../Cargo.toml",
        "/map.npz",
        "/style/",
        "/.git/config",
        "/index.html%00.js",
        "/ws?x=1",
    ];
    all.extend(paths.map(|path| request(&format!("/{token}{path}"), &own, "")));
    all.push(format!("POST /{token}/ HTTP/1.1\r\nHost: {own}\r\nContent-Length: 999999999\r\n\r\n"));
    all.push(format!("DELETE /{token}/main.js HTTP/1.1\r\nHost: {own}\r\nConnection: close\r\n\r\n"));
    all.push(format!(
        "GET /{token}/ HTTP/1.1\r\nHost: {own}\r\nHost: evil.example\r\nConnection: close\r\n\r\n"
    ));
    all.push(format!("GET /{token}/ HTTP/1.1\r\nConnection: close\r\n\r\n"));
    all.push(request(&format!("/{token}/"), "evil.example", &format!("X-Forwarded-Host: {own}\r\n")));
    all.push(format!("GET /{} HTTP/1.1\r\nHost: {own}\r\nConnection: close\r\n\r\n", "a".repeat(70_000)));
    all.push(request("/", &own, &format!("X: {}\r\n", "y".repeat(600_000))));
    all.push("\u{0}\u{1}\u{2}\r\n\r\n".into());
    all.push("GET".into());
    all
}

#[tokio::test(flavor = "multi_thread")]
async fn outsiders_get_nothing() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let (port, token) = (explorer.port(), explorer.token().to_owned());
    let all = outsiders(port, &token);
    for request in &all {
        let answer = raw(port, request.as_bytes()).await;
        let first = answer.lines().next().unwrap_or_default();
        let refused = ["400", "403", "404", "405", "408", "413", "414", "431"];
        let fine = answer.is_empty() || refused.iter().any(|code| first.contains(code));
        assert!(fine, "{:.200} → {first}", request);
        for secret in ["root:", "[package]", "<!doctype", "Impact Atlas</h1>"] {
            assert!(!answer.contains(secret), "{request:.200} → {answer:.400}");
        }
    }
    assert!(all.len() > 55, "{}", all.len());
    // The owner is let in: what was refused was not refused to everybody.
    let page = raw(port, request(&format!("/{token}/"), &format!("127.0.0.1:{port}"), "").as_bytes()).await;
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("<!doctype html>"), "{page:.300}");
    assert!(page.to_lowercase().contains("content-security-policy: default-src 'none'"));
    let (code, said, _) = explorer.interrupt();
    assert_eq!(code, Some(130), "{said}");
    assert!(!said.contains("panick") && !said.contains("internal error"), "{said}");
}

/// Messages that nobody should send.
fn messages(scene: u64, plane: &serde_json::Value) -> Vec<String> {
    let changed = |key: &str, value: serde_json::Value| {
        let mut plane = plane.clone();
        plane[key] = value;
        json!({ "type": "open", "ask": 9, "plane": plane }).to_string()
    };
    let mut all: Vec<String> =
        ["", "{", "null", "[]", "1e999", "\"open\"", "{\"type\":\"open\"}", "{\"type\":\"exec\"}"]
            .map(str::to_owned)
            .to_vec();
    all.push("[".repeat(100_000));
    all.push(format!("{{\"type\":\"want\",\"scene\":{scene},\"tiles\":{}", "[".repeat(50_000)));
    for name in
        ["/etc/passwd", "../secret.toml", "luo-ma-lv/../../x", "", "file:///etc/passwd", "\u{0}", "map.npz"]
    {
        all.push(changed("system", json!({ "name": name })));
    }
    let deep = format!("a = {}", "[".repeat(20_000));
    let lines = format!("a = {}", "[\n".repeat(20_000));
    let nested = format!("[system]\nmass = [[\"{}1\"]]", "(".repeat(30_000));
    let long = "x".repeat(70_000);
    let zero = "[system]\nmass = [[\"1/0\"]]";
    let texts = ["", "= = =", "name = 1", "\u{0}", &deep, &long, zero, &lines, &nested];
    for text in texts {
        all.push(changed("system", json!({ "text": text })));
    }
    for axis in [
        "",
        "omega",
        "omega=1:2:1e12",
        "omega=NaN:2:9",
        "omega=-1:2:9",
        "omega=1:1:9",
        "omega=1:2:1",
        "delta=0:1:9",
        "gain=0:1:9",
        "omega=1e-300:1e300:9:log",
        "omega=1:2:99999999",
        "$(reboot)=1:2:3",
        "omega=0:1:9",
    ] {
        all.push(changed("x", json!(axis)));
    }
    for start in ["", "1", "1,2,3,4,5", "NaN,0,0,0", "9,0,0,0", "symmetric; rm -rf /", &"1,".repeat(5000)] {
        all.push(changed("start", json!(start)));
    }
    for (key, value) in [
        ("transient", json!(4_000_000_000_u32)),
        ("transient", json!(-1)),
        ("observe", json!(0)),
        ("observe", json!(1e9)),
        ("max_period", json!(0)),
        ("max_period", json!(99_999)),
        ("backend", json!("adapter:99")),
        ("backend", json!("sh")),
        ("set", json!({ "zeta": -1 })),
        ("set", json!({ "zeta": 1e308 })),
        ("set", json!({ "PATH": 1 })),
        ("set", json!([1])),
    ] {
        all.push(changed(key, value));
    }
    let about = |kind: &str, rest: serde_json::Value| {
        let mut message = json!({ "type": kind, "ask": 9, "scene": scene });
        message.as_object_mut().unwrap().extend(rest.as_object().unwrap().clone());
        message.to_string()
    };
    let far = json!([0, 1_u64 << 60, 0]);
    let huge = json!({ "z": 0, "columns": [0, 1_000_000_000], "rows": [0, 1_000_000_000] });
    let backwards = json!({ "z": 0, "columns": [9, 0], "rows": [0, 9] });
    let outside = json!({ "z": 0, "columns": [-5000, -4900], "rows": [0, 9] });
    let last = json!({ "z": 30, "columns": [i64::MIN, i64::MAX], "rows": [i64::MIN, i64::MAX] });
    all.push(json!({ "type": "want", "scene": scene, "tiles": [far] }).to_string());
    all.push(json!({ "type": "want", "scene": scene, "tiles": [[99, 0, 0]] }).to_string());
    all.push(json!({ "type": "want", "scene": scene, "tiles": vec![[0, 0, 0]; 5000] }).to_string());
    all.push(json!({ "type": "want", "scene": 4_000_000, "tiles": [[0, 0, 0]] }).to_string());
    all.push(about("legend", json!({ "cells": [[65_000, 1]], "rows": 5 })));
    all.push(about("legend", json!({ "cells": [], "rows": 1_u64 << 50 })));
    all.push(about("axes", json!({ "x": [0, 0], "y": [0, 1], "size": [300, 300], "em": 13 })));
    all.push(about("axes", json!({ "x": [-1e300, 1e300], "y": [0, 1], "size": [300, 300], "em": 13 })));
    all.push(about("axes", json!({ "x": [0, 1], "y": [0, 1], "size": [1e9, -5], "em": 0 })));
    all.push(about("probe", json!({ "cell": [0, i64::MAX, i64::MIN], "width": 300 })));
    all.push(about("probe", json!({ "cell": [0, -4000, 3], "width": 300 })));
    for window in [&huge, &backwards, &outside, &last] {
        all.push(about("curves", json!({ "window": window, "max_period": 2, "all": false })));
        all.push(about(
            "save",
            json!({ "window": window, "format": "png", "size": [400, 300], "curves": null }),
        ));
        all.push(about("command", json!({ "window": window, "size": [400, 300], "curves": null })));
    }
    let few = json!({ "z": 0, "columns": [0, 9], "rows": [0, 9] });
    all.push(about("curves", json!({ "window": few, "max_period": 999, "all": true })));
    all.push(about("save", json!({ "window": few, "format": "exe", "size": [400, 300], "curves": null })));
    all.push(about(
        "save",
        json!({ "window": few, "format": "png", "size": [90_000, 90_000], "curves": null }),
    ));
    all.push(about("save", json!({ "window": few, "format": "png", "size": [0, 0], "curves": null })));
    all.push(about("slice", json!({ "from": [0, 0], "to": [0, 0], "columns": 50, "width": 600 })));
    all.push(about("slice", json!({ "from": [0, 0], "to": [9, 9], "columns": 9_000_000, "width": 600 })));
    all.push(about("slice", json!({ "from": [-1e9, 0], "to": [9, 9], "columns": 50, "width": 600 })));
    all.push(json!({ "type": "cancel", "ask": 123_456 }).to_string());
    all
}

#[tokio::test(flavor = "multi_thread")]
async fn hostile_messages_are_refused_and_others_are_served() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("secret.toml"), "secret = 1").unwrap();
    let explorer = Explorer::start(folder.path(), SMALL);
    let (mut first, hello) = Socket::connect(&explorer).await;
    let scene = first.open(&hello).await["scene"].as_u64().unwrap();
    let all = messages(scene, &hello["plane"]);
    assert!(all.len() > 65, "{}", all.len());
    let (mut socket, _) = Socket::connect(&explorer).await;
    let mut refused = 0;
    for message in &all {
        if !socket.send(message.clone()).await {
            (socket, _) = Socket::connect(&explorer).await;
        }
        // Nothing answers a `cancel`, nor a `want`; a question of no consequence tells when the message was heard.
        socket
            .send(json!({ "type": "legend", "ask": 77, "scene": scene, "cells": [], "rows": 3 }).to_string())
            .await;
        loop {
            match socket.hear().await {
                Heard::Text(answer) => {
                    assert!(!answer.to_string().contains("secret"), "{message:.200} → {answer}");
                    assert!(!answer.to_string().contains("internal error"), "{message:.200} → {answer}");
                    refused += u32::from(answer["type"] == "refused");
                    if answer["ask"] == 77 {
                        break;
                    }
                }
                Heard::Bytes(_) => {}
                Heard::Closed => {
                    (socket, _) = Socket::connect(&explorer).await;
                    break;
                }
            }
        }
    }
    assert!(refused > 55, "{refused} of {}", all.len());
    // Too long a message ends the connection, and no other.
    socket.send("x".repeat(400_000)).await;
    assert!(matches!(socket.hear().await, Heard::Closed));
    socket = Socket::connect(&explorer).await.0;
    socket.send_bytes(vec![0xff; 1000]).await;
    // Somebody who behaves is served all the while.
    first.send(json!({ "type": "want", "scene": scene, "tiles": [[-2, 0, 0]] }).to_string()).await;
    assert_eq!(first.tile().await.len(), 32 + 256 * 16);
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["secret.toml"], "files were written");
    let (code, said, took) = explorer.interrupt();
    assert_eq!(code, Some(130), "{said}");
    assert!(!said.contains("panick") && !said.contains("internal error"), "{said}");
    assert!(took < Duration::from_secs(3), "{took:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn ctrl_c_ends_what_is_being_computed() {
    let folder = tempdir().unwrap();
    let explorer = Explorer::start(folder.path(), "--backend cpu --transient 100000 --fixed-periods");
    let (mut socket, hello) = Socket::connect(&explorer).await;
    let scene = socket.open(&hello).await["scene"].as_u64().unwrap();
    let tiles: Vec<[i64; 3]> = (0..300).map(|i| [0, i % 20, i / 20]).collect();
    socket.send(json!({ "type": "want", "scene": scene, "tiles": tiles }).to_string()).await;
    let window = json!({ "z": 0, "columns": [0, 799], "rows": [0, 599] });
    let save = json!({ "type": "save", "ask": 5, "scene": scene, "window": window, "format": "npz", "size": [400, 300],
        "curves": null });
    socket.send(save.to_string()).await;
    tokio::time::sleep(Duration::from_millis(400)).await;
    let (code, said, took) = explorer.interrupt();
    assert_eq!(code, Some(130), "{said}");
    assert!(took < Duration::from_secs(3), "{took:?}");
}
