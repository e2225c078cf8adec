//! Result files: whether they can be written is found out before anything is computed.

use std::io;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use impact_atlas::plane::RegionMap;
use impact_atlas::render::Picture;
use impact_atlas::store::{self, Output};
use serde::Serialize;

use super::{CliError, interrupt, pictures};

/// Checks that each of the files can be written, and that no two are the same.
pub fn prepare<const N: usize>(paths: [Option<&Path>; N]) -> Result<[Option<Output>; N], CliError> {
    let mut outputs = [const { None }; N];
    let mut places: Vec<PathBuf> = Vec::new();
    for (output, path) in outputs.iter_mut().zip(paths) {
        let Some(path) = path else { continue };
        *output = Some(Output::prepare(path).map_err(CliError::input)?);
        let place = place(path);
        if places.contains(&place) {
            let name = path.display();
            return Err(CliError::Input(anyhow!(
                "two results are to be written to `{name}`: name another file"
            )));
        }
        places.push(place);
    }
    Ok(outputs)
}

/// Refuses a name for a table that would be taken for something else.
pub fn check_csv(path: Option<&Path>) -> Result<(), CliError> {
    let other = |path: &&Path| path.extension().is_some_and(|found| !found.eq_ignore_ascii_case("csv"));
    match path.filter(other) {
        Some(path) => Err(CliError::Input(anyhow!(
            "cannot write a table to `{}`: curves are CSV files, name it with .csv",
            path.display()
        ))),
        None => Ok(()),
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

/// Writes a map's data and its picture; neither unless both could be made.
pub fn write_map(map: &RegionMap, drawn: &Picture, data: &Output, picture: &Output) -> Result<(), CliError> {
    let bytes = pictures::encoded(drawn, pictures::format_of(picture.path())?)?;
    interrupt::check()?;
    write(data, |file| store::write_map(map, file))?;
    write(picture, |file| file.write_all(&bytes))
}

/// Writes a table.
pub fn write_csv<const N: usize>(
    output: &Output,
    columns: [&str; N],
    rows: impl Iterator<Item = impl Serialize>,
) -> Result<(), CliError> {
    write(output, |file| {
        let mut table = csv::WriterBuilder::new().has_headers(false).from_writer(file);
        table.write_record(columns)?;
        for row in rows {
            table.serialize(row)?;
        }
        table.flush()
    })
}

/// Anything that takes bytes and can be rewound.
pub trait File: io::Write + io::Seek {}

impl<T: io::Write + io::Seek> File for T {}

/// Fills a file.
pub fn write(output: &Output, content: impl FnOnce(&mut dyn File) -> io::Result<()>) -> Result<(), CliError> {
    output.write(|file| content(file)).map_err(CliError::machine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_names_of_one_file_are_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let detour = folder.path().join(".").join("a");
        let refused = prepare([Some(&path), None, Some(&detour)]).unwrap_err().to_string();
        assert!(refused.contains("two results"), "{refused}");
        assert!(prepare([Some(&path), Some(&folder.path().join("b"))]).is_ok());
        std::fs::write(&path, "").unwrap();
        assert!(prepare([Some(&path), Some(&detour)]).is_err());
    }
}
