//! The server: a page, its parts, and one WebSocket, behind a token.

use std::future::Future;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;

use axum::Router;
use axum::extract::ws::{Message, WebSocket, WebSocketUpgrade};
use axum::extract::{Path, Request, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use futures_util::{SinkExt, StreamExt};
use tokio::net::TcpListener;

use super::guard::Guard;
use super::limits;
use super::outbox::{Outbox, outbox};
use super::page;
use super::reply::Outgoing;
use super::served::Served;
use super::session::Session;

/// What the page may do: nothing but use its own parts.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
                      font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

/// A server that listens, and has no page yet.
#[derive(Debug)]
pub struct Server {
    listener: std::net::TcpListener,
    guard: Guard,
    served: Arc<Served>,
}

#[derive(Clone)]
struct Shared {
    guard: Arc<Guard>,
    served: Arc<Served>,
}

impl Server {
    /// Listens on a port of this machine alone; 0 for any that is free.
    ///
    /// # Errors
    /// A port that is taken, or may not be used.
    pub fn bind(port: u16, guard: Guard, served: Arc<Served>) -> std::io::Result<Self> {
        let listener = std::net::TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)))?;
        listener.set_nonblocking(true)?;
        Ok(Server { listener, guard, served })
    }

    /// The address of the page.
    ///
    /// # Errors
    /// What the operating system reports.
    pub fn address(&self) -> std::io::Result<String> {
        Ok(format!("http://{}/{}/", self.listener.local_addr()?, self.guard.token()))
    }

    /// Serves until `ended` is done, and ends what is being computed.
    ///
    /// # Errors
    /// What the operating system reports.
    pub fn run(self, ended: impl Future<Output = ()>) -> std::io::Result<()> {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
        let engine = self.served.engine.clone();
        let shared = Shared { guard: Arc::new(self.guard), served: self.served };
        let listener = self.listener;
        let result = runtime.block_on(async {
            let listener = TcpListener::from_std(listener)?;
            tokio::select! {
                result = async { axum::serve(listener, router(shared)).await } => result,
                () = ended => Ok(()),
            }
        });
        engine.end();
        runtime.shutdown_background();
        result
    }
}

fn router(shared: Shared) -> Router {
    Router::new()
        .route("/{token}", get(without_slash))
        .route("/{token}/", get(index))
        .route("/{token}/ws", get(socket))
        .route("/{token}/{*part}", get(part))
        .layer(middleware::from_fn_with_state(shared.clone(), guarded))
        .with_state(shared)
}

/// Refuses requests without the token, and gives every answer its security headers.
async fn guarded(State(shared): State<Shared>, request: Request, next: Next) -> Response {
    let token = request.uri().path().trim_start_matches('/').split('/').next().unwrap_or_default();
    let mut response = if !shared.guard.admits(request.headers()) {
        refusal(StatusCode::FORBIDDEN, "this address is not for you")
    } else if !shared.guard.knows(token) {
        refusal(StatusCode::NOT_FOUND, "use the address that impact-atlas explore printed: it holds a token")
    } else {
        next.run(request).await
    };
    let rules = [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
        (header::HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (header::HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ];
    for (name, rule) in rules {
        response.headers_mut().insert(name, HeaderValue::from_static(rule));
    }
    response
}

fn refusal(status: StatusCode, why: &'static str) -> Response {
    (status, [(header::CONTENT_TYPE, "text/plain; charset=utf-8")], why).into_response()
}

/// An address without its last slash, which relative addresses need; also behind a prefix.
async fn without_slash(Path(token): Path<String>) -> Response {
    (StatusCode::PERMANENT_REDIRECT, [(header::LOCATION, format!("{token}/"))]).into_response()
}

async fn index() -> Response {
    sent("index.html")
}

async fn part(Path((_, part)): Path<(String, String)>) -> Response {
    sent(&part)
}

/// A part of the page; nothing else is ever sent.
fn sent(name: &str) -> Response {
    match page::part(name) {
        Some(part) => ([(header::CONTENT_TYPE, part.media)], part.content).into_response(),
        None => refusal(StatusCode::NOT_FOUND, "the page has no such part"),
    }
}

async fn socket(State(shared): State<Shared>, upgrade: WebSocketUpgrade) -> Response {
    let Some(place) = shared.served.place() else {
        return refusal(StatusCode::SERVICE_UNAVAILABLE, "too many pages are open: close one");
    };
    let served = shared.served;
    upgrade.max_message_size(limits::MESSAGE).max_frame_size(limits::MESSAGE).on_upgrade(
        async move |socket| {
            let (page, from) = outbox();
            let session = Session::begin(&served, place, page);
            converse(socket, session, from).await;
        },
    )
}

/// Receives the messages of a page and sends it the answers, until the connection is closed.
async fn converse(socket: WebSocket, session: Session, mut from: Outbox) {
    let (mut to_page, mut from_page) = socket.split();
    let session = Arc::new(session);
    loop {
        tokio::select! {
            message = from_page.next() => match message {
                Some(Ok(Message::Text(text))) => {
                    let session = session.clone();
                    // Opening a device takes its time.
                    if tokio::task::spawn_blocking(move || session.hear(&text)).await.is_err() {
                        break;
                    }
                }
                Some(Ok(Message::Close(_)) | Err(_)) | None => break,
                Some(Ok(_)) => {}
            },
            message = from.next() => {
                let message = match message {
                    Some(Outgoing::Text(text)) => Message::Text(text.into()),
                    Some(Outgoing::Bytes(bytes)) => Message::Binary(bytes.into()),
                    None => break,
                };
                if to_page.send(message).await.is_err() {
                    break;
                }
            }
        }
    }
}
