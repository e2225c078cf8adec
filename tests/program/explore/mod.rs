//! The explorer from outside: what it refuses, what it serves, and its page in a real browser.

mod again;
mod browser;
mod figures;
mod hostile;
mod journey;
mod layers;
mod proxy;
mod refusals;
pub(crate) mod server;
pub(crate) mod socket;
mod stopped;
mod stores;
