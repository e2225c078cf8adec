//! Pictures: the format by the name of the file, and what every one of them carries.

use std::path::Path;

use impact_atlas::render::Picture;

use super::{CliError, note};

/// The formats that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Pixels.
    Png,
    /// Vectors, text as outlines.
    Svg,
}

/// The format that a path asks for: SVG by its extension, PNG otherwise.
pub fn format_of(path: &Path) -> Format {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("svg") => Format::Svg,
        _ => Format::Png,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_tells_the_format() {
        for (name, format) in
            [("map", Format::Png), ("a.b/map.PNG", Format::Png), ("map.svg", Format::Svg), ("-", Format::Png)]
        {
            assert_eq!(format_of(Path::new(name)), format, "{name}");
        }
    }
}
