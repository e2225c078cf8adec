//! PNG files that say how to make them again.

use std::io::{self, Write};

use image::RgbImage;
use png::{BitDepth, ColorType, Compression, Encoder};

/// The keyword of the text chunk that holds the configuration.
pub(crate) const KEYWORD: &str = "impact-atlas";

/// The keyword of the text chunk that holds the command.
pub(crate) const COMMAND: &str = "impact-atlas command";

/// Writes an image with `config`, and the command if there is one, in international text chunks; equal input gives equal
/// bytes.
pub(crate) fn write(image: &RgbImage, config: &str, command: Option<&str>, to: impl Write) -> io::Result<()> {
    let mut encoder = Encoder::new(to, image.width(), image.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.add_itxt_chunk(KEYWORD.to_owned(), config.to_owned())?;
    if let Some(command) = command {
        encoder.add_itxt_chunk(COMMAND.to_owned(), command.to_owned())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(image.as_raw())?;
    Ok(writer.finish()?)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use image::Rgb;

    use super::*;

    #[test]
    fn pixels_and_configuration_read_back() {
        let image = RgbImage::from_fn(13, 7, |x, y| Rgb([x as u8 * 19, y as u8 * 36, 7]));
        let config = r#"{"adapter":"Prüfstand ∞","x":{"first":0.2}}"#;
        let mut bytes = Vec::new();
        write(&image, config, None, &mut bytes).unwrap();
        let mut again = Vec::new();
        write(&image, config, None, &mut again).unwrap();
        assert_eq!(bytes, again);
        assert_eq!(image::load_from_memory(&bytes).unwrap().to_rgb8(), image);
        let reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let [chunk] = &reader.info().utf8_text[..] else { panic!("one text chunk") };
        assert_eq!((&*chunk.keyword, chunk.get_text().unwrap()), (KEYWORD, config.to_owned()));
    }
}
