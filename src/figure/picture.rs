//! A finished picture.

use std::fmt;
use std::io::{self, Write};

use image::RgbImage;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::canvas::printable;
use super::font::{self, FAMILY};
use super::outlines::outlined;
use super::size::Size;
use super::{pdf, png};

/// A finished picture, to be saved as SVG or PNG.
#[derive(Clone, Debug)]
pub struct Picture {
    size: Size,
    config: String,
    svg: String,
    left_out: Option<LeftOut>,
    command: Option<String>,
}

/// What a picture leaves out for want of room.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its parts, such as "the legend".
    pub parts: Vec<&'static str>,
    /// A size at which nothing is left out, in the same proportion; none if there is no such size.
    pub enough: Option<Size>,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the picture is too small for {}", self.parts.join(" and "))?;
        match self.enough {
            Some(size) => write!(f, ": {}x{} is enough", size.width(), size.height()),
            None => Ok(()),
        }
    }
}

impl Picture {
    /// A picture from its SVG document, and what it takes to make it again.
    pub(crate) fn new(size: Size, config: String, svg: String) -> Self {
        Picture { size, config, svg, left_out: None, command: None }
    }

    /// The same picture, of which something is left out.
    pub(crate) fn without(self, left_out: Option<LeftOut>) -> Self {
        Picture { left_out, ..self }
    }

    /// The same picture, with the command that makes it, which its files carry.
    #[must_use]
    pub fn made_by(self, command: String) -> Self {
        Picture { command: Some(printable(command)), ..self }
    }

    /// What is left out for want of room, if anything is.
    pub fn left_out(&self) -> Option<&LeftOut> {
        self.left_out.as_ref()
    }

    /// The picture's description: an SVG document with real text in the embedded font, which [`Picture::write_svg`] turns
    /// into outlines; its configuration is in the element `metadata`.
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// The picture in pixels; the same on every machine.
    pub fn pixels(&self) -> RgbImage {
        let tree = self.tree();
        let (width, height) = (self.size.width(), self.size.height());
        let mut pixmap = Pixmap::new(width, height).expect("a checked size is neither empty nor too large");
        resvg::render(&tree, Transform::identity(), &mut pixmap.as_mut());
        let opaque = pixmap.data().chunks_exact(4).flat_map(|rgba| [rgba[0], rgba[1], rgba[2]]).collect();
        RgbImage::from_raw(width, height, opaque).expect("three bytes for each pixel")
    }

    /// Writes the picture as a PNG, its configuration in a text chunk named `impact-atlas`, the command in one named
    /// `impact-atlas command`.
    ///
    /// # Errors
    /// What the writer reports.
    pub fn write_png(&self, to: impl Write) -> io::Result<()> {
        png::write(&self.pixels(), &self.config, self.command.as_deref(), to)
    }

    /// Writes the picture as an SVG document, text as outlines: it needs no font to look the same everywhere.
    ///
    /// # Errors
    /// What the writer reports.
    pub fn write_svg(&self, mut to: impl Write) -> io::Result<()> {
        let mut document = outlined(&self.svg, &self.tree());
        const END: &str = "</metadata>";
        if let (Some(command), Some(end)) = (&self.command, document.find(END)) {
            let command = quick_xml::escape::escape(command.as_str());
            let own = format!("\n<metadata id=\"{}\">{command}</metadata>", png::COMMAND.replace(' ', "-"));
            document.insert_str(end + END.len(), &own);
        }
        to.write_all(document.as_bytes())
    }

    /// Writes the picture as a PDF of one page, text as outlines, its configuration as the document's subject and the
    /// command as its keywords.
    ///
    /// # Errors
    /// What the writer reports.
    pub fn write_pdf(&self, mut to: impl Write) -> io::Result<()> {
        let outlines = outlined(&self.svg, &self.tree());
        to.write_all(&pdf::document(&outlines, &self.config, self.command.as_deref())?)
    }

    fn tree(&self) -> Tree {
        let options = Options { fontdb: font::database(), font_family: FAMILY.into(), ..Options::default() };
        Tree::from_str(&self.svg, &options).expect("the canvas writes valid SVG")
    }
}

#[cfg(test)]
mod tests {
    use image::Rgb;

    use super::super::canvas::Canvas;
    use super::super::shapes::{Anchor, Point, Rect};
    use super::super::text::Text;
    use super::*;

    fn picture() -> Picture {
        let size = Size::new(60, 40).unwrap();
        let config = r#"{"adapter":"<&>"}"#;
        let mut canvas = Canvas::new(size, config);
        canvas.fill(Rect { x: 10.0, y: 5.0, width: 20.0, height: 10.0 }, Rgb([1, 2, 3]));
        let text = Text::from("a < b & ").italic("x").subscript("1");
        canvas.text(&text, Point { x: 2.0, y: 30.0 }, Anchor::Start, 10.0, Rgb([0; 3]));
        Picture::new(size, config.to_owned(), canvas.finish())
    }

    #[test]
    fn shapes_and_text_become_pixels() {
        let pixels = picture().pixels();
        assert_eq!(pixels.dimensions(), (60, 40));
        assert_eq!(*pixels.get_pixel(0, 0), Rgb([255; 3]));
        assert_eq!(*pixels.get_pixel(10, 5), Rgb([1, 2, 3]));
        assert_eq!(*pixels.get_pixel(30, 15), Rgb([255; 3]));
        let inked = |range: std::ops::Range<u32>| {
            range
                .flat_map(|x| (20..40).map(move |y| (x, y)))
                .filter(|&(x, y)| pixels.get_pixel(x, y)[0] < 128)
                .count()
        };
        assert!(inked(2..50) > 40, "the text is drawn with the embedded fonts");
        assert_eq!(inked(0..2), 0);
    }

    #[test]
    fn text_and_configuration_are_escaped() {
        let svg = picture().svg().to_owned();
        assert!(svg.contains("a &lt; b &amp; "));
        assert!(svg.contains("&lt;&amp;&gt;"));
    }

    #[test]
    fn characters_that_no_document_holds_are_replaced() {
        let size = Size::new(60, 40).unwrap();
        let mut canvas = Canvas::new(size, "{\"title\":\"\u{fffe}\"}");
        canvas.text(
            &Text::from("a\u{7}b\u{1b}"),
            Point { x: 2.0, y: 30.0 },
            Anchor::Start,
            10.0,
            Rgb([0; 3]),
        );
        let drawn = Picture::new(size, "{}".into(), canvas.finish()).made_by("map --out o\u{1}.svg".into());
        let mut svg = Vec::new();
        drawn.write_svg(&mut svg).unwrap();
        let svg = String::from_utf8(svg).unwrap();
        assert!(svg.contains("a\u{fffd}b\u{fffd}") && svg.contains("o\u{fffd}.svg"), "{svg}");
        assert!(Tree::from_str(&svg, &Options::default()).is_ok());
        assert!(Tree::from_str(&svg.replacen('\u{fffd}', "\u{7}", 1), &Options::default()).is_err());
    }

    #[test]
    fn every_format_carries_the_command() {
        let command = "impact-atlas map --set 'r=0.7' <&>";
        let signed = picture().made_by(command.to_owned());
        let bytes = |write: fn(&Picture, &mut Vec<u8>) -> io::Result<()>, picture: &Picture| {
            let mut bytes = Vec::new();
            write(picture, &mut bytes).unwrap();
            String::from_utf8_lossy(&bytes).into_owned()
        };
        let png = |picture: &Picture| bytes(|picture, to| picture.write_png(to), picture);
        let svg = |picture: &Picture| bytes(|picture, to| picture.write_svg(to), picture);
        let pdf = |picture: &Picture| bytes(|picture, to| picture.write_pdf(to), picture);
        assert!(png(&signed).contains(command) && !png(&picture()).contains("map --set"));
        assert!(svg(&signed).contains("--set &apos;r=0.7&apos; &lt;&amp;&gt;"), "{}", svg(&signed));
        assert!(!svg(&picture()).contains("--set"));
        let pdf = [pdf(&signed), pdf(&picture())];
        assert!(pdf[0].starts_with("%PDF") && pdf[0].contains("impact-atlas map --set"));
        assert!(!pdf[1].contains("map --set") && pdf[1].contains("/Subject"));
    }

    #[test]
    fn equal_pictures_are_equal_files() {
        let file = || {
            let mut bytes = Vec::new();
            picture().write_png(&mut bytes).unwrap();
            bytes
        };
        assert_eq!(file(), file());
        assert_eq!(picture().svg(), picture().svg());
    }
}
