//! Text on a canvas.

use std::io::{self, Write};

use quick_xml::Writer;
use quick_xml::events::BytesText;

use super::canvas::{Canvas, IN_MEMORY, number};
use super::font::{CAPITALS, FAMILY};
use super::ink::css;
use super::shapes::{Anchor, Colour, Point};
use super::text::{Span, Style, Text};

impl Canvas {
    /// Writes a line of text, its capitals centred on the height of `at`.
    pub fn text(&mut self, text: &Text, at: Point, anchor: Anchor, size: f64, colour: Colour) {
        self.write_text(text, at, anchor, size, colour, &[]);
    }

    /// Writes a line of text that runs upwards, its capitals centred on `at` from left to right.
    pub fn rising_text(&mut self, text: &Text, at: Point, anchor: Anchor, size: f64, colour: Colour) {
        let turn = format!("rotate(-90 {} {})", number(at.x), number(at.y));
        self.write_text(text, at, anchor, size, colour, &[("transform", &turn)]);
    }

    /// Writes a line of text like [`Canvas::text`], with a rim of some width and colour around its letters.
    pub fn haloed_text(
        &mut self,
        text: &Text,
        at: Point,
        anchor: Anchor,
        size: f64,
        colour: Colour,
        (rim, around): (f64, Colour),
    ) {
        let (rim, around) = (number(rim), css(around));
        let halo = [
            ("stroke", &*around),
            ("stroke-width", &*rim),
            ("stroke-linejoin", "round"),
            ("paint-order", "stroke"),
        ];
        self.write_text(text, at, anchor, size, colour, &halo);
    }

    fn write_text(
        &mut self,
        text: &Text,
        at: Point,
        anchor: Anchor,
        size: f64,
        colour: Colour,
        more: &[(&str, &str)],
    ) {
        if text.is_blank() {
            return;
        }
        let element = self
            .xml
            .create_element("text")
            .with_attributes([
                ("x", &*number(at.x)),
                ("y", &number(at.y + CAPITALS / 2.0 * size)),
                ("font-size", &number(size)),
                ("fill", &css(colour)),
                ("text-anchor", anchor.into()),
                ("font-family", FAMILY),
                ("xml:space", "preserve"),
            ])
            .with_attributes(more.iter().copied());
        let spans = |xml: &mut Writer<Vec<u8>>| {
            let mut drop = 0.0;
            for span in text.spans() {
                write_span(xml, span, span.style.drop() - drop, size)?;
                drop = span.style.drop();
            }
            Ok(())
        };
        element.write_inner_content(spans).expect(IN_MEMORY);
        self.line_break();
    }
}

fn write_span(xml: &mut Writer<impl Write>, span: &Span, drop: f64, size: f64) -> io::Result<()> {
    let mut element = xml.create_element("tspan");
    if span.style == Style::Italic {
        element = element.with_attribute(("font-style", "italic"));
    }
    if span.style.size() != 1.0 {
        element = element.with_attribute(("font-size", &*number(span.style.size() * size)));
    }
    if drop != 0.0 {
        element = element.with_attribute(("dy", &*number(drop * size)));
    }
    element.write_text_content(BytesText::new(&span.content))?;
    Ok(())
}
