//! Result files: NumPy archives of maps and diagrams, and output files that appear complete or not at all.
//!
#![doc = include_str!("files.md")]

pub mod fields;
mod npz;
mod output;
mod zarr;

pub use npz::{ReadError, read_config, read_map, write_control, write_control_map, write_diagram, write_map};
pub use output::{Filled, Output, OutputError};
pub use zarr::{Event, Failure, Log, Status, StoreError, Wanted, ZarrStore};
