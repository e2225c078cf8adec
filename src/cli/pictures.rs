//! Pictures: the format by the name of the file, and what every one of them carries.

use std::path::Path;

use impact_atlas::figure::Picture;

use super::{CliError, Result, note};

/// The formats that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Pixels.
    Png,
    /// Vectors, text as outlines.
    Svg,
    /// The same, as it is printed.
    Pdf,
}

/// The format that a path asks for: SVG or PDF by its extension, PNG otherwise.
pub fn format_of(path: &Path) -> Format {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("svg") => Format::Svg,
        Some(extension) if extension.eq_ignore_ascii_case("pdf") => Format::Pdf,
        _ => Format::Png,
    }
}

/// The bytes of a picture's file; says what there was no room for.
pub fn encoded(picture: &Picture, format: Format) -> Result<Vec<u8>> {
    if let Some(left_out) = picture.left_out() {
        note(&left_out.to_string());
    }
    let picture = picture.clone().made_by(command());
    let mut bytes = Vec::new();
    match format {
        Format::Png => picture.write_png(&mut bytes),
        Format::Svg => picture.write_svg(&mut bytes),
        Format::Pdf => picture.write_pdf(&mut bytes),
    }
    .map_err(CliError::machine)?;
    Ok(bytes)
}

/// The command that runs, as it would be typed, without what changes nothing in what it computes or draws.
pub fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    said(words)
}

fn said(words: impl Iterator<Item = String>) -> String {
    let mut kept = vec!["impact-atlas".to_owned()];
    let mut is_value = false;
    for word in words {
        let drops = matches!(word.as_str(), "--force" | "--quiet" | "-q" | "--json");
        if !drops && !is_value && word != "--threads" && !word.starts_with("--threads=") {
            kept.push(word.clone());
        }
        is_value = word == "--threads";
    }
    shlex::try_join(kept.iter().map(String::as_str)).unwrap_or_else(|_| kept.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_is_said_as_it_would_be_typed() {
        let words =
            ["map", "--threads", "2", "--set", "r=0.7", "--title", "a plane", "--force", "-q", "--threads=1"];
        let command = said(words.into_iter().map(str::to_owned));
        assert_eq!(command, "impact-atlas map --set 'r=0.7' --title 'a plane'");
    }

    #[test]
    fn the_name_tells_the_format() {
        for (name, format) in
            [("map", Format::Png), ("a.b/map.PNG", Format::Png), ("map.svg", Format::Svg), ("-", Format::Png)]
        {
            assert_eq!(format_of(Path::new(name)), format, "{name}");
        }
    }
}
