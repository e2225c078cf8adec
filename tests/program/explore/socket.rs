//! The other end of the WebSocket, without a browser.

use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

use crate::explore::server::Explorer;

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// A connection.
pub struct Socket(WebSocketStream<MaybeTlsStream<TcpStream>>);

/// What came.
#[derive(Debug)]
pub enum Heard {
    Text(Value),
    Bytes(Vec<u8>),
    Closed,
}

impl Socket {
    /// Connects, and hears the greeting.
    pub async fn connect(explorer: &Explorer) -> (Socket, Value) {
        let address = format!("{}ws", explorer.address.replacen("http", "ws", 1));
        let (socket, _) = connect_async(address).await.unwrap();
        let mut socket = Socket(socket);
        let Heard::Text(hello) = socket.hear().await else { panic!("no greeting") };
        assert_eq!(hello["type"], "hello");
        (socket, hello)
    }

    pub async fn send(&mut self, text: impl Into<String>) -> bool {
        let text: String = text.into();
        timeout(PATIENCE, self.0.send(Message::Text(text.into()))).await.unwrap().is_ok()
    }

    pub async fn send_bytes(&mut self, bytes: Vec<u8>) -> bool {
        timeout(PATIENCE, self.0.send(Message::Binary(bytes.into()))).await.unwrap().is_ok()
    }

    /// The next message.
    pub async fn hear(&mut self) -> Heard {
        loop {
            match timeout(PATIENCE, self.0.next()).await.expect("an answer in time") {
                Some(Ok(Message::Text(text))) => return Heard::Text(serde_json::from_str(&text).unwrap()),
                Some(Ok(Message::Binary(bytes))) => return Heard::Bytes(bytes.to_vec()),
                Some(Ok(Message::Close(_)) | Err(_)) | None => return Heard::Closed,
                Some(Ok(_)) => {}
            }
        }
    }

    /// The next text of a type; others are passed over.
    pub async fn text(&mut self, kind: &str) -> Value {
        loop {
            match self.hear().await {
                Heard::Text(value) if value["type"] == kind => return value,
                Heard::Text(value) if value["type"] == "refused" => panic!("{value}"),
                Heard::Text(_) | Heard::Bytes(_) => {}
                Heard::Closed => panic!("closed before {kind}"),
            }
        }
    }

    /// Opens the plane of the greeting; its number.
    pub async fn open(&mut self, hello: &Value) -> Value {
        let request = json!({ "type": "open", "ask": 1, "plane": hello["plane"] });
        self.send(request.to_string()).await;
        self.text("scene").await["content"].clone()
    }

    /// The next tile.
    pub async fn tile(&mut self) -> Vec<u8> {
        loop {
            match self.hear().await {
                Heard::Bytes(bytes) if bytes[0] == 1 => return bytes,
                Heard::Closed => panic!("closed before a tile"),
                _ => {}
            }
        }
    }

    /// The next file.
    pub async fn file(&mut self) -> Vec<u8> {
        loop {
            match self.hear().await {
                Heard::Bytes(bytes) if bytes[0] == 2 => return bytes[8..].to_vec(),
                Heard::Text(value) if value["type"] == "refused" => panic!("{value}"),
                Heard::Closed => panic!("closed before a file"),
                _ => {}
            }
        }
    }
}
