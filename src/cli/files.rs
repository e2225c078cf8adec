//! Result files: whether they can be written is found out before anything is computed.

use std::io;
use std::path::{Path, PathBuf};

use impact_atlas::figure::{Picture, TooSmall};
use impact_atlas::store::{Filled, Output};
use serde::Serialize;

use super::options::OverwriteArgs;
use super::{CliError, Result, interrupt, note, pictures, terminal, wrong};

/// What a file holds, which its name must not contradict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture: PNG, SVG or PDF.
    Picture,
    /// A table: CSV.
    Table,
    /// Arrays: a NumPy archive.
    Archive,
    /// The same of a plane, which could also be put into a store.
    Plane,
}

impl Kind {
    /// A file of this kind, if there is to be one.
    pub fn at(self, path: Option<&Path>) -> Option<Wanted<'_>> {
        path.map(|path| Wanted { kind: self, path })
    }

    /// What is wrong with a name; one without an extension is anything's.
    fn complaint(self, path: &Path) -> Option<String> {
        let (what, known): (_, &[&str]) = match self {
            Kind::Picture => (
                "pictures are PNG, SVG or PDF files, name it with .png, .svg or .pdf",
                &["png", "svg", "pdf"],
            ),
            Kind::Table => ("tables are CSV files, name it with .csv", &["csv"]),
            Kind::Archive => ("data are NumPy archives, name it with .npz", &["npz"]),
            Kind::Plane => ("data are NumPy archives or Zarr stores, name it with .npz or .zarr", &["npz"]),
        };
        let extension = path.extension()?;
        let fits = known.iter().any(|known| extension.eq_ignore_ascii_case(known));
        (!fits).then(|| what.to_owned())
    }
}

/// A file that is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    kind: Kind,
    path: &'a Path,
}

/// Checks that each of the files can be written, that its name fits what it holds, and that no two are the same.
pub fn prepare<const N: usize>(
    overwrite: OverwriteArgs,
    wanted: [Option<Wanted<'_>>; N],
) -> Result<[Option<Output>; N]> {
    let mut outputs = [const { None }; N];
    let mut places: Vec<PathBuf> = Vec::new();
    for Wanted { kind, path } in wanted.iter().flatten() {
        let name = path.display();
        let complaint = kind.complaint(path);
        let place = place(path);
        if places.contains(&place) {
            let more = complaint.map(|complaint| format!(" ({complaint})")).unwrap_or_default();
            return Err(wrong!("two results are to be written to `{name}`: name another file{more}"));
        }
        places.push(place);
        if let Some(complaint) = complaint {
            return Err(wrong!("cannot write to `{name}`: {complaint}"));
        }
    }
    for (output, wanted) in outputs.iter_mut().zip(wanted) {
        let Some(Wanted { path, .. }) = wanted else { continue };
        let prepared = Output::prepare(path).map_err(CliError::input)?;
        let prepared =
            if overwrite.force { prepared } else { prepared.keeping().map_err(CliError::input)? };
        if prepared.is_standard() {
            terminal::give_away_standard_output();
        }
        *output = Some(prepared);
    }
    Ok(outputs)
}

/// Whether a path names a picture.
pub fn is_picture(path: &Path) -> bool {
    path.extension().is_some() && Kind::Picture.complaint(path).is_none()
}

/// Whether a path names a store.
pub fn is_store(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("zarr"))
}

/// Where the data go: where they are asked for, otherwise beside the picture with its name, if it has one.
pub fn data_beside(picture: &Path, data: Option<&Path>) -> Option<PathBuf> {
    match data {
        Some(data) => Some(data.to_owned()),
        None if picture.as_os_str() == Output::STANDARD => None,
        None => Some(picture.with_extension("npz")),
    }
}

/// The same for every way of writing a path.
fn place(path: &Path) -> PathBuf {
    if let Ok(existing) = path.canonicalize() {
        return existing;
    }
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let parent = parent.canonicalize().unwrap_or_else(|_| parent.to_owned());
    path.file_name().map_or_else(|| parent.clone(), |name| parent.join(name))
}

/// Anything that takes bytes and can be rewound.
pub trait File: io::Write + io::Seek {}

impl<T: io::Write + io::Seek> File for T {}

/// The files of one command: seen together once all of them are complete, or not at all.
#[derive(Debug, Default)]
pub struct Batch<'a> {
    filled: Vec<Filled<'a>>,
}

impl<'a> Batch<'a> {
    /// A file, if it is asked for.
    pub fn add(
        &mut self,
        output: &'a Option<Output>,
        content: impl FnOnce(&mut dyn File) -> io::Result<()>,
    ) -> Result<()> {
        if let Some(output) = output {
            self.filled.push(output.fill(|file| content(file)).map_err(CliError::machine)?);
        }
        Ok(())
    }

    /// The files of another one, after its own.
    pub fn append(&mut self, mut other: Batch<'a>) {
        self.filled.append(&mut other.filled);
    }

    /// A picture in the format that its file asks for.
    pub fn picture(&mut self, output: &'a Option<Output>, picture: &Picture) -> Result<()> {
        let Some(format) = output.as_ref().map(|output| pictures::format_of(output.path())) else {
            return Ok(());
        };
        let bytes = pictures::encoded(picture, format)?;
        self.add(output, |file| file.write_all(&bytes))
    }

    /// A table.
    pub fn table(
        &mut self,
        output: &'a Option<Output>,
        columns: &[impl AsRef<str>],
        rows: impl Iterator<Item = impl Serialize>,
    ) -> Result<()> {
        self.add(output, |file| {
            let mut table = csv::WriterBuilder::new().has_headers(false).from_writer(file);
            table.write_record(columns.iter().map(AsRef::as_ref))?;
            for row in rows {
                table.serialize(row)?;
            }
            table.flush()
        })
    }

    /// Shows them with a picture; where that does not fit, without it, and that is the error: what was computed is kept.
    pub fn show_with(mut self, output: &'a Option<Output>, drawn: Result<Picture, TooSmall>) -> Result<()> {
        match drawn {
            Ok(picture) => {
                self.picture(output, &picture)?;
                self.show()
            }
            Err(too_small) if self.filled.is_empty() => Err(CliError::input(too_small)),
            Err(too_small) => {
                self.show()?;
                Err(wrong!("{too_small}; everything else is written, and --force writes it anew"))
            }
        }
    }

    /// Puts every file where it belongs, unless Ctrl-C was pressed, and lists them.
    pub fn show(self) -> Result<()> {
        interrupt::check()?;
        let mut names = Vec::new();
        for filled in self.filled {
            let path = filled.path();
            let standard = path.as_os_str() == Output::STANDARD;
            names.push(if standard { "standard output".to_owned() } else { path.display().to_string() });
            filled.show().map_err(CliError::machine)?;
        }
        if !names.is_empty() {
            note(&format!("written: {}", names.join(", ")));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEW: OverwriteArgs = OverwriteArgs { force: false };

    fn tables<const N: usize>(paths: [Option<&Path>; N]) -> Result<[Option<Output>; N]> {
        prepare(NEW, paths.map(|path| Kind::Table.at(path)))
    }

    #[test]
    fn two_names_of_one_file_are_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let detour = folder.path().join(".").join("a");
        let refused = tables([Some(&path), None, Some(&detour)]).unwrap_err().to_string();
        assert!(refused.contains("two results"), "{refused}");
        assert!(tables([Some(&path), Some(&folder.path().join("b"))]).is_ok());
        std::fs::write(&path, "").unwrap();
        assert!(tables([Some(&path), Some(&detour)]).is_err());
        let refused = tables([Some(&path)]).unwrap_err().to_string();
        assert!(refused.contains("--force"), "{refused}");
        assert!(prepare(OverwriteArgs { force: true }, [Kind::Table.at(Some(&path))]).is_ok());
    }

    #[test]
    fn the_name_fits_what_the_file_holds() {
        let folder = tempfile::tempdir().unwrap();
        let refused = |kind: Kind, name: &str| {
            let path = folder.path().join(name);
            prepare(NEW, [kind.at(Some(&path))]).err().map(|error| error.to_string())
        };
        for (kind, good, bad, remedy) in [
            (Kind::Picture, ["map.PNG", "a.b.svg", "map"], ["map.jpg", "map.svgz", "map."], ".svg"),
            (Kind::Table, ["t.csv", "t.CSV", "t"], ["t.png", "t.tsv", "t.npz"], ".csv"),
            (Kind::Archive, ["m.npz", "m.NPZ", "m"], ["m.png", "m.npy", "m.csv"], ".npz"),
        ] {
            good.iter().for_each(|name| assert_eq!(refused(kind, name), None));
            for name in bad {
                let message = refused(kind, name).unwrap();
                assert!(message.contains(name) && message.contains(remedy), "{message}");
            }
        }
    }

    #[test]
    fn data_lie_beside_a_picture_that_has_a_place() {
        let beside = |picture: &str, data: Option<&str>| data_beside(Path::new(picture), data.map(Path::new));
        assert_eq!(beside("a/map.png", None), Some("a/map.npz".into()));
        assert_eq!(beside("map", Some("cells.npz")), Some("cells.npz".into()));
        assert_eq!((beside("-", None), beside("-", Some("m.npz"))), (None, Some("m.npz".into())));
    }
}
