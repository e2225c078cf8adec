//! The explorer: a server on this machine whose page shows a plane that one moves through.
//!
//! The server knows planes and back ends through the same doors as `map`: a tile's cells are followed by
//! [`decide`](crate::backend::decide), coloured, named and counted by [`render`](crate::render), and what is taken along is
//! drawn and stored as `map` does it. The page is in the folder `page` as plain modules; what goes between the two is
//! described below.
//!
#![doc = include_str!("protocol.md")]

mod asked;
mod backends;
mod batch;
mod command;
mod describe;
mod engine;
mod figures;
mod gather;
mod guard;
mod known;
mod lattice;
mod layer;
mod limits;
mod outbox;
mod page;
mod probe;
mod ranges;
mod reply;
mod request;
mod scene;
mod served;
mod server;
mod session;
mod slice;
mod store;
mod stored;
mod task;
mod tile;

pub use asked::{Refused, check};
pub use backends::{Asked, Computing, choosable, open};
pub use guard::Guard;
pub use known::Known;
pub use served::Served;
pub use server::Server;

/// The cells of a tile.
fn tile_cells() -> usize {
    (lattice::SIDE * lattice::SIDE) as usize
}
