//! Result files: NumPy archives of whole maps, and output files that appear complete or not at all.

mod npz;
mod output;

pub use npz::{ReadError, read_map, write_control, write_map};
pub use output::{Output, OutputError};
