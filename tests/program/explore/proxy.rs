//! A proxy with a path of its own, whose line can be cut.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Notify;

/// The path under which the page is found.
pub const PREFIX: &str = "/user/someone/proxy";

/// A proxy.
pub struct Proxy {
    pub port: u16,
    down: Arc<AtomicBool>,
    cut: Arc<Notify>,
}

impl Proxy {
    /// Begins to pass on what comes to a port of its own.
    pub async fn start(to: u16) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let port = listener.local_addr().unwrap().port();
        let (down, cut) = (Arc::new(AtomicBool::new(false)), Arc::new(Notify::new()));
        let (is_down, is_cut) = (down.clone(), cut.clone());
        tokio::spawn(async move {
            loop {
                let (client, _) = listener.accept().await.unwrap();
                if is_down.load(Ordering::Relaxed) {
                    continue;
                }
                let is_cut = is_cut.clone();
                tokio::spawn(async move {
                    let server = TcpStream::connect(("127.0.0.1", to)).await.unwrap();
                    tokio::select! {
                        () = passed_on(client, server) => {}
                        () = is_cut.notified() => {}
                    }
                });
            }
        });
        Proxy { port, down, cut }
    }

    /// Cuts every line; nobody gets through.
    pub fn cut(&self) {
        self.down.store(true, Ordering::Relaxed);
        self.cut.notify_waiters();
    }

    /// Lets everybody through again.
    pub fn mend(&self) {
        self.down.store(false, Ordering::Relaxed);
    }
}

/// Passes bytes on in both directions; the prefix of paths is taken away, as such proxies do.
async fn passed_on(client: TcpStream, server: TcpStream) {
    let (mut from_client, mut to_client) = client.into_split();
    let (mut from_server, mut to_server) = server.into_split();
    let up = async {
        let mut buffer = vec![0; 1 << 16];
        while let Ok(count @ 1..) = from_client.read(&mut buffer).await {
            let mut bytes = buffer[..count].to_vec();
            let wanted = format!("GET {PREFIX}/");
            if bytes.starts_with(wanted.as_bytes()) {
                bytes.splice(..wanted.len(), *b"GET /");
            }
            if to_server.write_all(&bytes).await.is_err() {
                break;
            }
        }
    };
    let back = async {
        let _ = tokio::io::copy(&mut from_server, &mut to_client).await;
    };
    tokio::select! { () = up => {}, () = back => {} }
}
