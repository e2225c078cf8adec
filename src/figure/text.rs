//! Lines of text with the symbols of a formula: italic letters, subscripts, superscripts.

use super::font::Face;

/// A line of text in parts of different style.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text {
    spans: Vec<Span>,
}

/// A part of a text in one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub content: String,
    pub style: Style,
}

/// How a part of a text is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    Upright,
    Italic,
    Subscript,
    Superscript,
}

impl Style {
    pub fn face(self) -> Face {
        if self == Style::Italic { Face::Italic } else { Face::Upright }
    }

    /// The size of the letters, in parts of the text size.
    pub fn size(self) -> f64 {
        if matches!(self, Style::Subscript | Style::Superscript) { 0.7 } else { 1.0 }
    }

    /// How far the letters stand below the line, in parts of the text size.
    pub fn drop(self) -> f64 {
        match self {
            Style::Subscript => 0.18,
            Style::Superscript => -0.36,
            _ => 0.0,
        }
    }
}

impl Text {
    /// An empty text, to add to.
    pub fn new() -> Self {
        Text::default()
    }

    /// Adds plain words.
    #[must_use]
    pub fn upright(self, content: impl Into<String>) -> Self {
        self.span(content, Style::Upright)
    }

    /// Adds the letter of a quantity.
    #[must_use]
    pub fn italic(self, content: impl Into<String>) -> Self {
        self.span(content, Style::Italic)
    }

    /// Adds a subscript.
    #[must_use]
    pub fn subscript(self, content: impl Into<String>) -> Self {
        self.span(content, Style::Subscript)
    }

    /// Adds an exponent.
    #[must_use]
    pub fn superscript(self, content: impl Into<String>) -> Self {
        self.span(content, Style::Superscript)
    }

    /// Adds another text.
    #[must_use]
    pub fn then(self, other: Text) -> Self {
        other.spans.into_iter().fold(self, |text, span| text.span(span.content, span.style))
    }

    /// Whether there is nothing to see.
    pub fn is_blank(&self) -> bool {
        self.spans.iter().all(|span| span.content.trim().is_empty())
    }

    /// The width in pixels at a text size in pixels.
    pub fn width(&self, size: f64) -> f64 {
        let spans = self.spans.iter();
        spans.map(|span| span.style.face().width(&span.content) * span.style.size() * size).sum()
    }

    /// Breaks a line between pieces, separated by spaces, wherever it would be wider than `width`.
    pub fn wrap(pieces: impl IntoIterator<Item = Text>, size: f64, width: f64) -> Vec<Text> {
        let mut lines: Vec<Text> = Vec::new();
        for piece in pieces {
            let longer = lines.last().map(|line| line.clone().upright(" ").then(piece.clone()));
            match (lines.last_mut(), longer) {
                (Some(line), Some(longer)) if longer.width(size) <= width => *line = longer,
                _ => lines.push(piece),
            }
        }
        lines
    }

    /// The words alone, whatever their style.
    #[cfg(test)]
    pub(crate) fn plain(&self) -> String {
        self.spans.iter().map(|span| span.content.as_str()).collect()
    }

    pub(crate) fn spans(&self) -> &[Span] {
        &self.spans
    }

    fn span(mut self, content: impl Into<String>, style: Style) -> Self {
        let content = content.into();
        if content.is_empty() {
            return self;
        }
        match self.spans.last_mut() {
            Some(last) if last.style == style => last.content.push_str(&content),
            _ => self.spans.push(Span { content, style }),
        }
        self
    }
}

impl<T: Into<String>> From<T> for Text {
    fn from(content: T) -> Self {
        Text::new().upright(content)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subscripts_are_narrower() {
        let flat = Text::from("x1").width(10.0);
        let lowered = Text::from("x").subscript("1").width(10.0);
        assert!(lowered < flat && lowered > Text::from("x").width(10.0));
        assert!((Text::from("x1").width(20.0) - 2.0 * flat).abs() < 1e-9);
    }

    /// What stands behind an empty subscript would be drawn as low as that.
    #[test]
    fn nothing_takes_no_place() {
        assert_eq!(Text::new().italic("ω").subscript("").upright(" = 1").spans().len(), 2);
        assert!(Text::from("").spans().is_empty());
    }

    #[test]
    fn lines_break_where_they_must() {
        let pieces = || ["one", "two", "three"].map(Text::from);
        let whole = Text::from("one two three").width(10.0);
        assert_eq!(Text::wrap(pieces(), 10.0, whole).len(), 1);
        let lines = Text::wrap(pieces(), 10.0, whole - 0.1);
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|line| line.width(10.0) < whole));
        assert_eq!(Text::wrap(pieces(), 10.0, 0.0).len(), 3);
    }
}
