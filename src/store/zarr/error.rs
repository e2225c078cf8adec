//! What is wrong with a store.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::super::OutputError;
use crate::plane::Tiling;
use crate::plane::fields::CellsError;

/// Why a store was refused, or could not be read or written.
#[derive(Debug, Error)]
pub enum StoreError {
    /// Nothing is there.
    #[error("there is no store `{}`: name one that `map --data` wrote", .0.display())]
    Missing(PathBuf),
    /// Something is there that this program did not write.
    #[error("`{}` is no store of this program ({reason}): name another one; nothing was changed in it", path.display())]
    Foreign {
        /// The path.
        path: PathBuf,
        /// Why it is none.
        reason: String,
    },
    /// Another version of the format.
    #[error(
        "`{}` has format {found} of stores, and this version reads format {known}: use the version that wrote it \
         (impact-atlas {version})",
        path.display()
    )]
    Format {
        /// The path.
        path: PathBuf,
        /// Its format.
        found: u64,
        /// The format that is read here.
        known: u64,
        /// The version that wrote it.
        version: String,
    },
    /// The store is of another plane, or was computed by something else.
    #[error(
        "`{}` holds another computation, and was left as it is: {}; name another store, or ask for the same as before",
        path.display(), differences.join("; ")
    )]
    Differs {
        /// The path.
        path: PathBuf,
        /// What differs, each in words.
        differences: Vec<String>,
    },
    /// Tiles of that side are none that a store has.
    #[error("tiles of {0} × {0} cells cannot be stored: give a side of 1 to {most}", most = Tiling::LARGEST)]
    Tile(u32),
    /// A shard cannot be read.
    #[error(
        "the shard `{}` is damaged ({reason}): delete it, and `map` with the same options computes its tile again",
        path.display()
    )]
    Damaged {
        /// The shard's file.
        path: PathBuf,
        /// Why it cannot be read.
        reason: String,
    },
    /// A file of the store could not be written, or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The file system could not do something else.
    #[error("`{}`: the store could not be used", path.display())]
    Io {
        /// The path.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
}

impl StoreError {
    /// Whether what was asked for is wrong, not the machine.
    pub fn is_input(&self) -> bool {
        !matches!(self, StoreError::Output(_) | StoreError::Io { .. })
    }
}

impl From<StoreError> for CellsError {
    fn from(error: StoreError) -> Self {
        CellsError(error.to_string())
    }
}
