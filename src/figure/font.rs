//! The embedded fonts: Inter, upright and italic, under the SIL Open Font License (`fonts/OFL.txt`).

use std::sync::{Arc, LazyLock};

use resvg::usvg::fontdb;
use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::outline::DrawSettings;
use skrifa::outline::pen::SvgPen;
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// The family of the embedded fonts.
pub(crate) const FAMILY: &str = "Inter";

/// The height of capitals, in parts of the text size.
pub(crate) const CAPITALS: f64 = 0.727;

static UPRIGHT: &[u8] = include_bytes!("fonts/Inter-Regular.otf");
static ITALIC: &[u8] = include_bytes!("fonts/Inter-Italic.otf");

/// One of the embedded fonts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Face {
    Upright,
    Italic,
}

impl Face {
    /// The width of a text in parts of its size, glyph by glyph.
    pub fn width(self, text: &str) -> f64 {
        static METRICS: LazyLock<[Metrics; 2]> = LazyLock::new(|| [UPRIGHT, ITALIC].map(Metrics::of));
        METRICS[self as usize].width(text)
    }
}

/// The outline of a glyph of a font as the data of an SVG path, in font units, upwards; none where there is no such glyph.
pub(crate) fn outline(font: &[u8], glyph: u32) -> Option<String> {
    let font = FontRef::new(font).ok()?;
    let mut pen = SvgPen::with_precision(0);
    let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
    font.outline_glyphs().get(GlyphId::new(glyph))?.draw(settings, &mut pen).ok()?;
    Some(pen.into())
}

struct Metrics {
    characters: Charmap<'static>,
    glyphs: GlyphMetrics<'static>,
}

impl Metrics {
    fn of(bytes: &'static [u8]) -> Self {
        let font = FontRef::new(bytes).expect("the embedded fonts are sound");
        Metrics {
            characters: font.charmap(),
            glyphs: font.glyph_metrics(Size::new(1.0), LocationRef::default()),
        }
    }

    fn width(&self, text: &str) -> f64 {
        let glyphs = text.chars().map(|c| self.characters.map(c).unwrap_or_default());
        glyphs.map(|glyph| f64::from(self.glyphs.advance_width(glyph).unwrap_or_default())).sum()
    }
}

/// The embedded fonts, and none of the system, so that pictures are the same on every machine.
pub(crate) fn database() -> Arc<fontdb::Database> {
    static DATABASE: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
        let mut database = fontdb::Database::new();
        database.load_font_data(UPRIGHT.to_vec());
        database.load_font_data(ITALIC.to_vec());
        database.set_sans_serif_family(FAMILY);
        Arc::new(database)
    });
    Arc::clone(&DATABASE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_faces_have_every_character_that_pictures_use() {
        for bytes in [UPRIGHT, ITALIC] {
            let characters = FontRef::new(bytes).unwrap().charmap();
            for c in "ωδζμτσλ∞−×±Ā<=%,;()-0123456789".chars() {
                assert!(characters.map(c).is_some(), "{c}");
            }
        }
    }

    #[test]
    fn widths_add_up() {
        for face in [Face::Upright, Face::Italic] {
            assert_eq!(face.width(""), 0.0);
            assert!(face.width("i") < face.width("m"));
            assert!((face.width("im") - face.width("i") - face.width("m")).abs() < 1e-9);
            assert!((0.4..0.8).contains(&face.width("n")));
        }
    }
}
