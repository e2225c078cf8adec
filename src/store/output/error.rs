//! Why a result is not written.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why an output file cannot be, or was not, written; with the path that was given.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The path is a directory.
    #[error("cannot write to `{}`: it is a directory; give the name of a file in it", .0.display())]
    Directory(PathBuf),
    /// The path has no file name.
    #[error("cannot write to `{}`: it names no file", .0.display())]
    NoName(PathBuf),
    /// Symbolic links lead to each other.
    #[error("cannot write to `{}`: symbolic links lead in a circle; give another name", .0.display())]
    Circle(PathBuf),
    /// A file is there that was not to be replaced.
    #[error("`{}` is there already: give --force to replace it, or another name", .0.display())]
    Exists(PathBuf),
    /// A device, a pipe or a socket is there.
    #[error("cannot write to `{}`: it is not a regular file; give another name, or - for standard output", .0.display())]
    Special(PathBuf),
    /// A write-protected file is there.
    #[error("cannot write to `{}`: it is write-protected; remove it or give another name", .0.display())]
    ReadOnly(PathBuf),
    /// The directory is missing, or is no directory.
    #[error("cannot write to `{}`: there is no directory `{}`; create it first", path.display(), parent.display())]
    NoParent {
        /// The path that was given.
        path: PathBuf,
        /// The directory it asks for.
        parent: PathBuf,
    },
    /// No file can be created in the directory.
    #[error(
        "cannot write to `{}`: no file can be created in `{}`; choose another directory or change its permissions",
        path.display(),
        parent.display()
    )]
    Unwritable {
        /// The path that was given.
        path: PathBuf,
        /// The directory.
        parent: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
    /// The disk or the quota is full.
    #[error("`{}` was not written: the disk is full; make room or choose another disk", path.display())]
    DiskFull {
        /// The path that was given.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
    /// The file would be larger than the system lets this process write.
    #[error("`{}` was not written: it is larger than the limit on the size of files; raise it (ulimit -f)", path.display())]
    TooLarge {
        /// The path that was given.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
    /// Anything else that went wrong while writing.
    #[error("`{}` was not written", path.display())]
    Write {
        /// The path that was given.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
}

impl OutputError {
    /// What went wrong as a file was written.
    pub(in crate::store) fn of_writing(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => OutputError::DiskFull { path, source },
            ErrorKind::FileTooLarge => OutputError::TooLarge { path, source },
            ErrorKind::AlreadyExists => OutputError::Exists(path),
            _ => OutputError::Write { path, source },
        }
    }
}
