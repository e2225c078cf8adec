//! Text as outlines, so that an SVG file looks the same wherever it is opened, whatever fonts are there.

use std::collections::BTreeSet;

use quick_xml::events::{BytesEnd, BytesStart, Event};
use quick_xml::{Reader, Writer, XmlVersion};
use resvg::usvg::fontdb::ID;
use resvg::usvg::layout::Span;
use resvg::usvg::{Group, Node, Text, Tree};

use super::font;

/// Why nothing here returns an error.
const SOUND: &str = "the canvas writes valid SVG";

/// A glyph of one of the embedded fonts.
type Glyph = (ID, u32);

/// The same document with the outlines of its text in place of the text, laid out as in `tree`.
///
/// Every glyph is defined once. The words stay in the file as labels: `aria-label` is what a screen reader says, and what
/// a search finds.
pub(crate) fn outlined(svg: &str, tree: &Tree) -> String {
    let mut texts = Vec::new();
    collect(tree.root(), &mut texts);
    let mut texts = texts.into_iter();
    let mut reader = Reader::from_str(svg);
    let mut xml = Writer::new(Vec::new());
    let copy = |xml: &mut Writer<Vec<u8>>, event: Event| xml.write_event(event).expect(SOUND);
    loop {
        match reader.read_event().expect(SOUND) {
            Event::Eof => break,
            Event::Start(element) if element.name().as_ref() == "svg" => {
                copy(&mut xml, Event::Start(element));
                write_glyphs(&mut xml, tree, texts.as_slice());
            }
            Event::Start(element) if element.name().as_ref() == "text" => {
                reader.read_to_end(element.name()).expect(SOUND);
                let text = texts.next().expect("a text of the tree for each of the document");
                write_outlines(&mut xml, &element, text, tree);
            }
            event => copy(&mut xml, event),
        }
    }
    String::from_utf8(xml.into_inner()).expect("only text was written")
}

fn collect<'a>(group: &'a Group, texts: &mut Vec<&'a Text>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => collect(inner, texts),
            Node::Text(text) => texts.push(text),
            Node::Path(_) | Node::Image(_) => {}
        }
    }
}

/// Defines every glyph that texts use, in font units and upside down, as fonts have it.
fn write_glyphs(xml: &mut Writer<Vec<u8>>, tree: &Tree, texts: &[&Text]) {
    let spans = texts.iter().flat_map(|text| text.layouted());
    let used: BTreeSet<Glyph> =
        spans.flat_map(|span| &span.positioned_glyphs).map(|glyph| (glyph.font, glyph.id.0)).collect();
    xml.get_mut().push(b'\n');
    xml.write_event(Event::Start(BytesStart::new("defs"))).expect(SOUND);
    for glyph in used {
        let outline = tree.fontdb().with_face_data(glyph.0, |data, _| font::outline(data, glyph.1));
        let path = outline.flatten().unwrap_or_default();
        let element = xml.create_element("path");
        element.with_attributes([("id", &*name(tree, glyph)), ("d", &path)]).write_empty().expect(SOUND);
        xml.get_mut().push(b'\n');
    }
    xml.write_event(Event::End(BytesEnd::new("defs"))).expect(SOUND);
}

/// What a glyph is called in the file: the number of its face, and its own.
fn name(tree: &Tree, (face, glyph): Glyph) -> String {
    let number = tree.fontdb().faces().position(|known| known.id == face).unwrap_or_default();
    format!("g{number}-{glyph}")
}

/// Writes the outlines of a text: first its rim, if it has one, then the letters.
fn write_outlines(xml: &mut Writer<Vec<u8>>, element: &BytesStart, text: &Text, tree: &Tree) {
    let attribute = |name| {
        let found = element.try_get_attribute(name).expect(SOUND)?;
        Some(found.normalized_value(XmlVersion::Implicit1_0).expect(SOUND).into_owned())
    };
    let words: String = text.chunks().iter().map(|chunk| chunk.text()).collect();
    let mut group = BytesStart::new("g").with_attributes([("role", "img"), ("aria-label", &*words)]);
    for name in ["fill", "transform"] {
        if let Some(value) = attribute(name) {
            group.push_attribute((name, &*value));
        }
    }
    xml.write_event(Event::Start(group)).expect(SOUND);
    if let (Some(rim), Some(width)) = (attribute("stroke"), attribute("stroke-width")) {
        let width: f64 = width.parse().expect(SOUND);
        text.layouted().iter().for_each(|span| write_span(xml, span, tree, Some((&rim, width))));
    }
    text.layouted().iter().for_each(|span| write_span(xml, span, tree, None));
    xml.write_event(Event::End(BytesEnd::new("g"))).expect(SOUND);
}

/// Writes the glyphs of one size, or the rim around them, in a group of font units.
fn write_span(xml: &mut Writer<Vec<u8>>, span: &Span, tree: &Tree, rim: Option<(&str, f64)>) {
    let Some(first) = span.positioned_glyphs.first() else { return };
    let origin = first.outline_transform();
    let scale = f64::from(origin.sx);
    let matrix = format!("matrix({scale:.6} 0 0 {:.6} {:.2} {:.2})", -scale, origin.tx, origin.ty);
    let mut group = BytesStart::new("g").with_attributes([("transform", &*matrix)]);
    if let Some((colour, width)) = rim {
        group.push_attribute(("stroke", colour));
        group.push_attribute(("stroke-width", &*format!("{:.0}", width / scale)));
        group.push_attribute(("stroke-linejoin", "round"));
        group.push_attribute(("fill", "none"));
    }
    xml.write_event(Event::Start(group)).expect(SOUND);
    for glyph in &span.positioned_glyphs {
        let at = glyph.outline_transform();
        let x = (f64::from(at.tx - origin.tx) / scale).round();
        let href = format!("#{}", name(tree, (glyph.font, glyph.id.0)));
        let element = xml.create_element("use").with_attribute(("href", &*href));
        element.with_attributes((x != 0.0).then_some(("x", &*x.to_string()))).write_empty().expect(SOUND);
    }
    xml.write_event(Event::End(BytesEnd::new("g"))).expect(SOUND);
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use image::Rgb;
    use resvg::tiny_skia::{Pixmap, Transform};
    use resvg::usvg::Options;

    use super::super::canvas::Canvas;
    use super::super::picture::Picture;
    use super::super::shapes::{Anchor, Point};
    use super::super::size::Size;
    use super::super::text::Text as Words;

    /// A picture with upright, italic, small, turned and haloed text.
    fn picture() -> Picture {
        let size = Size::new(300, 200).unwrap();
        let mut canvas = Canvas::new(size, "{}");
        let words = Words::from("half < clearance ").italic("δ").subscript("m").superscript("+");
        let ink = Rgb([20; 3]);
        canvas.text(&words, Point { x: 290.0, y: 30.0 }, Anchor::End, 21.3, ink);
        canvas.text(&Words::new(), Point { x: 9.0, y: 9.0 }, Anchor::End, 21.3, ink);
        canvas.rising_text(&words, Point { x: 30.0, y: 100.0 }, Anchor::Middle, 12.0, ink);
        let rim = (5.0, Rgb([0, 200, 0]));
        canvas.haloed_text(&words, Point { x: 60.0, y: 120.0 }, Anchor::Start, 18.0, ink, rim);
        Picture::new(size, "{}".into(), canvas.finish())
    }

    /// The pixels of a document where there is no font at all.
    fn without_fonts(svg: &str) -> Vec<u8> {
        let options = Options { fontdb: Arc::default(), ..Options::default() };
        let tree = resvg::usvg::Tree::from_str(svg, &options).unwrap();
        let mut pixmap = Pixmap::new(300, 200).unwrap();
        resvg::render(&tree, Transform::identity(), &mut pixmap.as_mut());
        pixmap.data().chunks_exact(4).flat_map(|rgba| [rgba[0], rgba[1], rgba[2]]).collect()
    }

    /// The share of bytes that differ by more than antialiasing at hundredths of a pixel can.
    fn different(a: &[u8], b: &[u8]) -> f64 {
        assert_eq!(a.len(), b.len());
        let far = a.iter().zip(b).filter(|(a, b)| a.abs_diff(**b) > 24).count();
        far as f64 / a.len() as f64
    }

    #[test]
    fn a_file_looks_like_the_pixels_where_no_font_is_installed() {
        let picture = picture();
        let mut file = Vec::new();
        picture.write_svg(&mut file).unwrap();
        let file = String::from_utf8(file).unwrap();
        let pixels = picture.pixels();
        let outlined = different(&without_fonts(&file), pixels.as_raw());
        let lost = different(&without_fonts(picture.svg()), pixels.as_raw());
        assert!(outlined < 1e-3 && lost > 0.02, "{outlined}, and {lost} where text lacks its font");
    }

    #[test]
    fn words_stay_as_labels_and_glyphs_are_defined_once() {
        let mut file = Vec::new();
        picture().write_svg(&mut file).unwrap();
        let file = String::from_utf8(file).unwrap();
        assert!(!file.contains("<text") && !file.contains("font-family"));
        assert_eq!(file.matches("aria-label=\"half &lt; clearance δm+\"").count(), 3);
        let defined = file.matches("<path id=\"g").count();
        let used = file.matches("<use ").count();
        assert!((12..20).contains(&defined) && used > 60, "{defined} {used}");
    }
}
