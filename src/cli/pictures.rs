//! Pictures: the format by the name of the file, and what every one of them carries.

use std::path::Path;

use anyhow::anyhow;
use impact_atlas::render::Picture;
use impact_atlas::store::Output;

use super::{CliError, files, note};

/// The formats that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Pixels.
    Png,
    /// Vectors, text as outlines.
    Svg,
}

/// The format that a path asks for: SVG by its extension, PNG by its extension or without one.
///
/// A picture named otherwise would be one of the two all the same, and be taken for something else.
pub fn format_of(path: &Path) -> Result<Format, CliError> {
    match path.extension() {
        None => Ok(Format::Png),
        Some(extension) if extension.eq_ignore_ascii_case("png") => Ok(Format::Png),
        Some(extension) if extension.eq_ignore_ascii_case("svg") => Ok(Format::Svg),
        Some(_) => Err(CliError::Input(anyhow!(
            "cannot draw `{}`: pictures are PNG or SVG files, name it with .png or .svg",
            path.display()
        ))),
    }
}

/// The bytes of a picture's file; says what there was no room for.
pub fn encoded(picture: &Picture, format: Format) -> Result<Vec<u8>, CliError> {
    if let Some(left_out) = picture.left_out() {
        note(&left_out.to_string());
    }
    let mut bytes = Vec::new();
    match format {
        Format::Png => picture.write_png(&mut bytes),
        Format::Svg => picture.write_svg(&mut bytes),
    }
    .map_err(CliError::machine)?;
    Ok(bytes)
}

/// Writes a picture in the format that its file asks for.
pub fn write(picture: &Picture, output: &Output) -> Result<(), CliError> {
    let bytes = encoded(picture, format_of(output.path())?)?;
    files::write(output, |file| file.write_all(&bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_tells_the_format() {
        let format = |name: &str| format_of(Path::new(name)).map_err(|error| error.to_string());
        assert_eq!(format("map"), Ok(Format::Png));
        assert_eq!(format("a.b/map.PNG"), Ok(Format::Png));
        assert_eq!(format("map.svg"), Ok(Format::Svg));
        for name in ["map.jpg", "map.pdf", "map.svgz", "map."] {
            assert!(format(name).unwrap_err().contains(name), "{name}");
        }
    }
}
