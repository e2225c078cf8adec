//! An SVG document under construction.

use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageBuffer, PixelWithColorType, Rgb};
use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};

use super::ink::css;
use super::paint::{Hatch, Paint};
use super::shapes::{Colour, Point, Rect};
use super::size::Size;

/// An SVG document under construction: later things cover earlier ones.
pub struct Canvas {
    pub(super) xml: Writer<Vec<u8>>,
}

/// A text with a sign in place of every character that XML has no place for.
pub(super) fn printable(text: String) -> String {
    let has_place = |c: char| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..);
    if text.chars().all(has_place) {
        return text;
    }
    text.chars().map(|c| if has_place(c) { c } else { char::REPLACEMENT_CHARACTER }).collect()
}

/// Why nothing here returns an error.
pub(super) const IN_MEMORY: &str = "memory takes every byte";

impl Canvas {
    /// An empty white canvas; `config` says what it takes to make the picture again.
    pub fn new(size: Size, config: &str) -> Self {
        let mut canvas = Canvas { xml: Writer::new(Vec::new()) };
        let (width, height) = (size.width().to_string(), size.height().to_string());
        let root = BytesStart::new("svg").with_attributes([
            ("xmlns", "http://www.w3.org/2000/svg"),
            ("width", &width),
            ("height", &height),
            ("viewBox", &format!("0 0 {width} {height}")),
        ]);
        canvas.xml.write_event(Event::Start(root)).expect(IN_MEMORY);
        canvas.line_break();
        let metadata = canvas.xml.create_element("metadata").with_attribute(("id", "impact-atlas"));
        metadata.write_text_content(BytesText::new(config)).expect(IN_MEMORY);
        canvas.line_break();
        canvas.fill(Rect::whole(size), Rgb([255; 3]));
        canvas
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, rect: Rect, colour: Colour) {
        self.rect(rect, &[("fill", &css(colour))]);
    }

    /// Draws the edge of a rectangle.
    pub fn outline(&mut self, rect: Rect, width: f64, colour: Colour) {
        self.rect(rect, &[("fill", "none"), ("stroke", &css(colour)), ("stroke-width", &number(width))]);
    }

    /// Draws straight lines of one width and colour.
    pub fn lines(&mut self, lines: &[(Point, Point)], width: f64, colour: Colour) {
        if lines.is_empty() {
            return;
        }
        let path: Vec<String> = lines
            .iter()
            .map(|(a, b)| format!("M{} {}L{} {}", number(a.x), number(a.y), number(b.x), number(b.y)))
            .collect();
        self.path(&path.concat(), width, colour, &[]);
    }

    /// Draws a line through points, its corners round, with dashes and gaps of the given lengths unless there are none.
    pub fn stroke(&mut self, points: &[Point], width: f64, colour: Colour, dashes: &[f64]) {
        let [first, rest @ ..] = points else { return };
        let mut path = format!("M{} {}", number(first.x), number(first.y));
        for point in rest {
            path.push_str(&format!("L{} {}", number(point.x), number(point.y)));
        }
        let lengths: Vec<String> = dashes.iter().map(|&length| number(length)).collect();
        let lengths = lengths.join(" ");
        let dashed = (!dashes.is_empty()).then_some(("stroke-dasharray", &*lengths));
        let more: Vec<_> = [("stroke-linejoin", "round")].into_iter().chain(dashed).collect();
        self.path(&path, width, colour, &more);
    }

    /// Draws dots of one size and colour.
    pub fn dots(&mut self, points: &[Point], diameter: f64, colour: Colour) {
        if points.is_empty() {
            return;
        }
        // A line of almost no length with round ends is a disc, and takes far fewer bytes than a circle.
        let path: String =
            points.iter().map(|point| format!("M{} {}h.01", number(point.x), number(point.y))).collect();
        self.path(&path, diameter, colour, &[("stroke-linecap", "round")]);
    }

    fn path(&mut self, path: &str, width: f64, colour: Colour, more: &[(&str, &str)]) {
        let element = self.xml.create_element("path").with_attributes([
            ("d", path),
            ("fill", "none"),
            ("stroke", &css(colour)),
            ("stroke-width", &number(width)),
        ]);
        element.with_attributes(more.iter().copied()).write_empty().expect(IN_MEMORY);
        self.line_break();
    }

    /// Fills a rectangle with a paint; `em` sets the spacing of a hatch.
    pub fn paint(&mut self, rect: Rect, paint: Paint, em: f64) {
        self.fill(rect, paint.fill);
        if let Some(colour) = paint.hatch {
            let hatch = Hatch::new(em);
            self.lines(&hatch.lines(rect), hatch.width(), colour);
        }
    }

    /// Lays an image, which may be transparent in places, into a rectangle, pixel by pixel, without smoothing.
    pub fn image<P: PixelWithColorType<Subpixel = u8>>(
        &mut self,
        rect: Rect,
        image: &ImageBuffer<P, Vec<u8>>,
    ) {
        let mut png = Cursor::new(Vec::new());
        let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Up);
        image.write_with_encoder(encoder).expect(IN_MEMORY);
        let element = self.xml.create_element("image").with_attributes([
            ("x", &*number(rect.x)),
            ("y", &number(rect.y)),
            ("width", &number(rect.width)),
            ("height", &number(rect.height)),
            ("preserveAspectRatio", "none"),
            ("image-rendering", "optimizeSpeed"),
            ("style", "image-rendering:pixelated"),
            ("href", &format!("data:image/png;base64,{}", BASE64.encode(png.into_inner()))),
        ]);
        element.write_empty().expect(IN_MEMORY);
        self.line_break();
    }

    /// Draws a disc with an edge.
    pub fn disc(&mut self, at: Point, radius: f64, fill: Colour, width: f64, edge: Colour) {
        let element = self.xml.create_element("circle").with_attributes([
            ("cx", &*number(at.x)),
            ("cy", &number(at.y)),
            ("r", &number(radius)),
            ("fill", &css(fill)),
            ("stroke", &css(edge)),
            ("stroke-width", &number(width)),
        ]);
        element.write_empty().expect(IN_MEMORY);
        self.line_break();
    }

    /// The finished document.
    pub fn finish(mut self) -> String {
        self.xml.write_event(Event::End(BytesEnd::new("svg"))).expect(IN_MEMORY);
        self.line_break();
        printable(String::from_utf8(self.xml.into_inner()).expect("only text was written"))
    }

    fn rect(&mut self, rect: Rect, style: &[(&str, &str)]) {
        let element = self.xml.create_element("rect").with_attributes([
            ("x", &*number(rect.x)),
            ("y", &number(rect.y)),
            ("width", &number(rect.width)),
            ("height", &number(rect.height)),
        ]);
        element.with_attributes(style.iter().copied()).write_empty().expect(IN_MEMORY);
        self.line_break();
    }

    /// Keeps the file readable.
    pub(super) fn line_break(&mut self) {
        self.xml.get_mut().push(b'\n');
    }
}

/// A coordinate to a hundredth of a pixel.
pub(super) fn number(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0;
    (rounded + 0.0).to_string()
}
