//! The parts of the page, embedded in the program.

/// A part of the page.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Its address, relative to the page's.
    pub name: &'static str,
    /// Its media type.
    pub media: &'static str,
    /// Its bytes.
    pub content: &'static [u8],
}

macro_rules! parts {
    ($media:literal: $($name:literal),+ $(,)?) => {
        [$(Part { name: $name, media: $media, content: include_bytes!(concat!("page/", $name)) }),+]
    };
}

const HTML: [Part; 1] = parts!("text/html; charset=utf-8": "index.html");

const STYLES: [Part; 5] = parts!("text/css; charset=utf-8":
    "style/base.css", "style/plane.css", "style/controls.css", "style/panel.css", "style/narrow.css");

const MODULES: [Part; 32] = parts!("text/javascript; charset=utf-8":
    "main.js", "link.js", "protocol.js", "view.js", "address.js", "tiles.js", "grid.js", "paint.js", "axes.js",
    "legend.js", "words.js", "pointer.js", "keys.js", "hover.js", "panel.js", "card.js", "circle.js", "controls.js",
    "system.js", "form.js", "curves.js", "marks.js", "toolbar.js", "slice.js", "save.js", "status.js", "theme.js", "dom.js",
    "place.js", "timing.js", "told.js", "summary.js");

const FONTS: [Part; 2] = [
    Part {
        name: "font/Inter-Regular.otf",
        media: "font/otf",
        content: include_bytes!("../figure/fonts/Inter-Regular.otf"),
    },
    Part {
        name: "font/Inter-Italic.otf",
        media: "font/otf",
        content: include_bytes!("../figure/fonts/Inter-Italic.otf"),
    },
];

/// Every part.
pub fn parts() -> impl Iterator<Item = &'static Part> {
    HTML.iter().chain(&STYLES).chain(&MODULES).chain(&FONTS)
}

/// The part of an address.
pub fn part(name: &str) -> Option<&'static Part> {
    parts().find(|part| part.name == name)
}
