//! A line of text in parts, for a page that sets it itself.

use serde::Serialize;

use crate::figure::{Style, Text};

/// A part of a text in one style.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Word {
    /// What is written.
    pub text: String,
    /// "upright", "italic", "subscript" or "superscript".
    pub style: &'static str,
}

/// The parts of a text, in order.
pub fn words(text: &Text) -> Vec<Word> {
    let style = |style: Style| match style {
        Style::Upright => "upright",
        Style::Italic => "italic",
        Style::Subscript => "subscript",
        Style::Superscript => "superscript",
    };
    text.spans().iter().map(|span| Word { text: span.content.clone(), style: style(span.style) }).collect()
}
