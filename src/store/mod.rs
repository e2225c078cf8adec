//! Placeholder of the result files.

mod output;

use std::io::{self, Seek, Write};

use crate::plane::RegionMap;

pub use output::{Output, OutputError};

/// Writes a map.
///
/// # Errors
/// What the writer reports.
pub fn write_map(map: &RegionMap, mut to: impl Write + Seek) -> io::Result<()> {
    writeln!(to, "{}", map.config())
}
