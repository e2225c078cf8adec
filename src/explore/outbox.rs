//! What is on its way to a page. A page that does not read what it asks for is given up.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};

use super::limits;
use super::reply::Outgoing;

/// The page is gone, or does not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gone;

/// Where messages for a page are put.
#[derive(Clone, Debug)]
pub struct Page {
    to: UnboundedSender<Outgoing>,
    waiting: Arc<AtomicUsize>,
}

/// Where they are taken.
#[derive(Debug)]
pub struct Outbox {
    from: UnboundedReceiver<Outgoing>,
    waiting: Arc<AtomicUsize>,
}

/// Both ends.
pub fn outbox() -> (Page, Outbox) {
    let (to, from) = unbounded_channel();
    let waiting = Arc::new(AtomicUsize::new(0));
    (Page { to, waiting: waiting.clone() }, Outbox { from, waiting })
}

fn bytes(message: &Outgoing) -> usize {
    match message {
        Outgoing::Text(text) => text.len(),
        Outgoing::Bytes(bytes) => bytes.len(),
    }
}

impl Page {
    /// Puts a message there.
    ///
    /// # Errors
    /// [`Gone`].
    pub fn send(&self, message: Outgoing) -> Result<(), Gone> {
        if self.is_closed() {
            return Err(Gone);
        }
        self.waiting.fetch_add(bytes(&message), Ordering::Relaxed);
        self.to.send(message).map_err(|_| Gone)
    }

    /// Whether the page is gone, or more waits for it than is kept.
    pub fn is_closed(&self) -> bool {
        self.to.is_closed() || self.waiting.load(Ordering::Relaxed) > limits::WAITING
    }
}

impl Outbox {
    /// The next message; none once all senders are gone.
    pub async fn next(&mut self) -> Option<Outgoing> {
        let message = self.from.recv().await?;
        self.waiting.fetch_sub(bytes(&message), Ordering::Relaxed);
        Some(message)
    }
}
