//! Output files that appear complete or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};
use thiserror::Error;

/// A file to be written once its content is there.
///
/// What cannot work is found by [`Output::prepare`], before any computing. [`Output::write`] fills a
/// temporary file next to the final one and renames it when it is complete: an error or an interruption
/// leaves neither half a file nor a damaged older one.
#[derive(Debug)]
pub struct Output {
    /// As the user gave it.
    path: PathBuf,
    /// Where the file will be, symbolic links followed.
    target: PathBuf,
}

impl Output {
    /// Checks that a file can be written at `path`; changes nothing.
    ///
    /// # Errors
    /// What stands in the way, with the path and the remedy.
    pub fn prepare(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        let ends_in_separator = path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
        if path.is_dir() || ends_in_separator {
            return Err(OutputError::Directory { path });
        }
        if path.file_name().is_none() {
            return Err(OutputError::NoName { path });
        }
        let target = fs::canonicalize(&path).unwrap_or_else(|_| path.clone());
        if let Ok(existing) = fs::metadata(&target) {
            if !existing.is_file() {
                return Err(OutputError::Special { path });
            }
            if existing.permissions().readonly() {
                return Err(OutputError::ReadOnly { path });
            }
        }
        let output = Output { path, target };
        let parent = output.parent();
        if !parent.is_dir() {
            return Err(OutputError::NoParent { path: output.path.clone(), parent: parent.to_owned() });
        }
        output.temporary().map_err(|source| OutputError::Unwritable {
            path: output.path.clone(),
            parent: parent.to_owned(),
            source,
        })?;
        Ok(output)
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file through `content`, and shows it only when all of it is on the disk.
    ///
    /// # Errors
    /// [`OutputError::DiskFull`], or whatever else `content` or the file system reported; the file is then
    /// as it was before.
    pub fn write(
        &self,
        content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        self.try_write(content).map_err(|source| {
            let path = self.path.clone();
            match source.kind() {
                ErrorKind::StorageFull | ErrorKind::QuotaExceeded => OutputError::DiskFull { path, source },
                _ => OutputError::Write { path, source },
            }
        })
    }

    fn try_write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
        let temporary = self.temporary()?;
        let mut writer = BufWriter::new(temporary.as_file());
        content(&mut writer)?;
        writer.flush()?;
        drop(writer);
        temporary.as_file().sync_all()?;
        if let Ok(existing) = fs::metadata(&self.target) {
            temporary.as_file().set_permissions(existing.permissions())?;
        }
        temporary.persist(&self.target)?;
        Ok(())
    }

    fn parent(&self) -> &Path {
        match self.target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        }
    }

    /// A hidden file next to the final one, removed when dropped.
    fn temporary(&self) -> io::Result<NamedTempFile> {
        let mut builder = Builder::new();
        builder.prefix(".impact-atlas-").suffix(".part");
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask
        builder.tempfile_in(self.parent())
    }
}

/// Why an output file cannot be, or was not, written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The path is a directory.
    #[error("cannot write to `{}`: it is a directory; give the name of a file in it", path.display())]
    Directory {
        /// The path that was given.
        path: PathBuf,
    },
    /// The path has no file name.
    #[error("cannot write to `{}`: it names no file", path.display())]
    NoName {
        /// The path that was given.
        path: PathBuf,
    },
    /// A device, a pipe or a socket is there.
    #[error("cannot write to `{}`: it is not a regular file; give another name", path.display())]
    Special {
        /// The path that was given.
        path: PathBuf,
    },
    /// A write-protected file is there.
    #[error("cannot write to `{}`: it is write-protected; remove it or give another name", path.display())]
    ReadOnly {
        /// The path that was given.
        path: PathBuf,
    },
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
    /// Anything else that went wrong while writing.
    #[error("`{}` was not written", path.display())]
    Write {
        /// The path that was given.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
}

#[cfg(test)]
mod tests {
    use tempfile::{TempDir, tempdir};

    use super::*;

    fn names(directory: &TempDir) -> Vec<String> {
        let entries = fs::read_dir(directory).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_file_is_written_and_replaced() {
        let directory = tempdir().unwrap();
        let path = directory.path().join("map.png");
        for content in ["first", "second"] {
            let output = Output::prepare(&path).unwrap();
            output.write(|file| file.write_all(content.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), content);
        }
        assert_eq!(names(&directory), ["map.png"]);
    }

    #[test]
    fn preparing_changes_nothing() {
        let directory = tempdir().unwrap();
        Output::prepare(directory.path().join("new.npz")).unwrap();
        assert!(names(&directory).is_empty());
        fs::write(directory.path().join("old.npz"), "old").unwrap();
        Output::prepare(directory.path().join("old.npz")).unwrap();
        assert_eq!(fs::read_to_string(directory.path().join("old.npz")).unwrap(), "old");
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() {
        let directory = tempdir().unwrap();
        let path = directory.path().join("map.npz");
        fs::write(&path, "old").unwrap();
        let output = Output::prepare(&path).unwrap();
        let fail = |kind: ErrorKind| {
            output.write(|file| {
                file.write_all(&[0; 100_000])?;
                Err(kind.into())
            })
        };
        let full = fail(ErrorKind::StorageFull).unwrap_err();
        assert!(matches!(full, OutputError::DiskFull { .. }));
        assert!(full.to_string().contains("map.npz"));
        assert!(matches!(fail(ErrorKind::Other), Err(OutputError::Write { .. })));
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(&directory), ["map.npz"]);
    }

    #[test]
    fn what_cannot_work_is_named_beforehand() {
        let directory = tempdir().unwrap();
        let root = directory.path();
        fs::write(root.join("file"), "").unwrap();
        let is = |path: &Path, part: &str| {
            let message = Output::prepare(path).unwrap_err().to_string();
            assert!(message.contains(part) && message.contains(&path.display().to_string()), "{message}");
        };
        is(root, "is a directory");
        is(&root.join("new/"), "is a directory");
        is(&root.join("missing/map.png"), "create it first");
        is(&root.join("file/map.png"), "no directory");
        is(Path::new(""), "names no file");
        is(Path::new(".."), "is a directory");
        let mut permissions = fs::metadata(root.join("file")).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(root.join("file"), permissions).unwrap();
        is(&root.join("file"), "write-protected");
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_refused_and_links_are_followed() {
        let refused = Output::prepare("/dev/null");
        assert!(matches!(refused, Err(OutputError::Special { .. })));
        let directory = tempdir().unwrap();
        let (real, link) = (directory.path().join("real"), directory.path().join("link"));
        fs::write(&real, "old").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        Output::prepare(&link).unwrap().write(|file| file.write_all(b"new")).unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read_to_string(&real).unwrap(), "new");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_other_file() {
        use std::os::unix::fs::PermissionsExt;
        let directory = tempdir().unwrap();
        let mode = |name: &str| fs::metadata(directory.path().join(name)).unwrap().permissions().mode();
        let write = |name: &str| {
            let output = Output::prepare(directory.path().join(name)).unwrap();
            output.write(|file| file.write_all(b"content")).unwrap();
        };
        fs::write(directory.path().join("ordinary"), "").unwrap();
        write("ours");
        assert_eq!(mode("ours"), mode("ordinary"));
        fs::set_permissions(directory.path().join("ours"), fs::Permissions::from_mode(0o640)).unwrap();
        write("ours");
        assert_eq!(mode("ours") & 0o777, 0o640);
    }
}
