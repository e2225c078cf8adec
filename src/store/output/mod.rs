//! Output files that appear complete or not at all.

mod error;

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

pub use error::OutputError;

/// A file to be written once its content is there; `-` is standard output.
///
/// What cannot work is found by [`Output::prepare`], before any computing. [`Output::fill`] writes into a temporary
/// file next to the final one, and [`Filled::show`] renames it when it is complete: an error or an interruption
/// leaves neither half a file nor a damaged older one.
#[derive(Debug)]
pub struct Output {
    /// As the user gave it.
    path: PathBuf,
    target: Target,
    /// Whether a file that is there stays.
    keeping: bool,
}

#[derive(Debug)]
enum Target {
    /// Where the file will be, symbolic links followed.
    File(PathBuf),
    StandardOutput,
}

impl Output {
    /// The path that means standard output.
    pub const STANDARD: &str = "-";

    /// Checks that a file can be written at `path`, in place of one that may be there; changes nothing.
    ///
    /// # Errors
    /// What stands in the way, with the path and the remedy.
    pub fn prepare(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        if path.as_os_str() == Self::STANDARD {
            return Ok(Output { path, target: Target::StandardOutput, keeping: false });
        }
        let ends_in_separator = path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
        if path.is_dir() || ends_in_separator {
            return Err(OutputError::Directory(path));
        }
        if path.file_name().is_none() {
            return Err(OutputError::NoName(path));
        }
        let Some(target) = followed(&path) else { return Err(OutputError::Circle(path)) };
        if let Ok(existing) = fs::metadata(&target) {
            if !existing.is_file() {
                return Err(OutputError::Special(path));
            }
            if existing.permissions().readonly() {
                return Err(OutputError::ReadOnly(path));
            }
        }
        let parent = parent(&target);
        if !parent.is_dir() {
            return Err(OutputError::NoParent { path, parent: parent.to_owned() });
        }
        if let Err(source) = temporary(parent) {
            return Err(OutputError::Unwritable { path, parent: parent.to_owned(), source });
        }
        Ok(Output { path, target: Target::File(target), keeping: false })
    }

    /// The same, but a file that is there is left alone: now, and if one appears until the result is shown.
    ///
    /// # Errors
    /// [`OutputError::Exists`] where there is one now.
    pub fn keeping(self) -> Result<Self, OutputError> {
        match &self.target {
            Target::File(target) if target.exists() => Err(OutputError::Exists(self.path)),
            _ => Ok(Output { keeping: true, ..self }),
        }
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the result goes to standard output.
    pub fn is_standard(&self) -> bool {
        matches!(self.target, Target::StandardOutput)
    }

    /// Fills the file through `content`, out of sight.
    ///
    /// # Errors
    /// [`OutputError::DiskFull`], [`OutputError::TooLarge`], or whatever else `content` or the file system reported;
    /// the file is then as it was before.
    pub fn fill(
        &self,
        content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<Filled<'_>, OutputError> {
        self.try_fill(content).map_err(|source| self.failed(source))
    }

    /// Fills the file through `content`, and shows it when all of it is on the disk.
    ///
    /// # Errors
    /// Those of [`Output::fill`] and [`Filled::show`].
    pub fn write(
        &self,
        content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        self.fill(content)?.show()
    }

    fn try_fill(
        &self,
        content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> io::Result<Filled<'_>> {
        match &self.target {
            Target::StandardOutput => {
                let file = tempfile::tempfile()?;
                complete(&file, content)?;
                Ok(Filled { output: self, content: Content::Unnamed(file) })
            }
            Target::File(target) => {
                let temporary = temporary(parent(target))?;
                complete(temporary.as_file(), content)?;
                temporary.as_file().sync_all()?;
                if let Ok(existing) = fs::metadata(target) {
                    temporary.as_file().set_permissions(existing.permissions())?;
                }
                Ok(Filled { output: self, content: Content::Beside(temporary, target) })
            }
        }
    }

    fn failed(&self, source: io::Error) -> OutputError {
        OutputError::of_writing(&self.path, source)
    }
}

/// A result that is complete and not yet seen; dropped, it is gone.
#[derive(Debug)]
pub struct Filled<'a> {
    output: &'a Output,
    content: Content<'a>,
}

#[derive(Debug)]
enum Content<'a> {
    Beside(NamedTempFile, &'a Path),
    Unnamed(File),
}

impl Filled<'_> {
    /// The path as it was given.
    pub fn path(&self) -> &Path {
        self.output.path()
    }

    /// Puts the result where it belongs. A reader of standard output that has gone away is content.
    ///
    /// # Errors
    /// [`OutputError::Exists`] where a file has appeared that is to stay, or what the file system reported.
    pub fn show(self) -> Result<(), OutputError> {
        let shown = match self.content {
            Content::Beside(file, target) if self.output.keeping => {
                file.persist_noclobber(target).map(drop).map_err(|error| error.error)
            }
            Content::Beside(file, target) => file.persist(target).map(drop).map_err(|error| error.error),
            Content::Unnamed(mut file) => {
                let copied = file.rewind().and_then(|()| {
                    let mut standard = io::stdout().lock();
                    io::copy(&mut file, &mut standard)?;
                    standard.flush()
                });
                copied
                    .or_else(|error| if error.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(error) })
            }
        };
        shown.map_err(|source| self.output.failed(source))
    }
}

fn complete(file: &File, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(file);
    let filled = content(&mut writer).and_then(|()| writer.flush());
    // Taken apart, the writer does not flush its buffer once more.
    drop(writer.into_parts());
    filled
}

/// Where a path leads, whether or not a file is there; `None` for links that lead to each other.
fn followed(path: &Path) -> Option<PathBuf> {
    /// As many links as systems follow.
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = parent(&path).join(next),
            Err(_) => return Some(path),
        }
    }
    None
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// A hidden file in a directory, removed when dropped.
fn temporary(directory: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".impact-atlas-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask
    builder.tempfile_in(directory)
}

#[cfg(test)]
mod tests;
