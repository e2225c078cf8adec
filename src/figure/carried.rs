//! The configuration that a picture carries.

use std::io::Cursor;

use quick_xml::Reader;
use quick_xml::events::Event;

use super::png::KEYWORD;

/// The configuration text in the bytes of a picture, PNG or SVG, that this crate wrote; none in other files.
pub fn carried_configuration(bytes: &[u8]) -> Option<String> {
    if bytes.starts_with(b"\x89PNG") { of_png(bytes) } else { of_svg(std::str::from_utf8(bytes).ok()?) }
}

fn of_png(bytes: &[u8]) -> Option<String> {
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info().ok()?;
    reader.info().utf8_text.iter().find(|chunk| chunk.keyword == KEYWORD)?.get_text().ok()
}

fn of_svg(text: &str) -> Option<String> {
    let mut reader = Reader::from_str(text);
    loop {
        match reader.read_event().ok()? {
            Event::Start(element) if element.name().as_ref() == "metadata" => {
                let raw = reader.read_text(element.name()).ok()?;
                return Some(quick_xml::escape::unescape(&raw).ok()?.into_owned());
            }
            Event::Eof => return None,
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Canvas;
    use super::super::picture::Picture;
    use super::super::size::Size;
    use super::*;

    #[test]
    fn a_picture_hands_its_configuration_back() {
        let config = r#"{"version":"<&>"}"#.to_owned();
        let size = Size::new(40, 30).unwrap();
        let picture = Picture::new(size, config.clone(), Canvas::new(size, &config).finish());
        let mut png = Vec::new();
        picture.write_png(&mut png).unwrap();
        assert_eq!(carried_configuration(&png), Some(config.clone()));
        assert_eq!(carried_configuration(picture.svg().as_bytes()), Some(config));
    }

    #[test]
    fn other_files_carry_none() {
        for bytes in [&b""[..], b"\x89PNG\r\n", b"<svg></svg>", b"\xff\xfe", b"omega,delta"] {
            assert_eq!(carried_configuration(bytes), None);
        }
    }
}
