//! Where everything goes, and what is left out where space is scarce.

use super::census::Census;
use super::names;
use crate::figure::{Frame, Legend, Placed, Point, Rect, Size, Text};
use crate::render::curves::Key;

/// The height of a line of the title, in em.
pub(super) const TITLE_ROW: f64 = 1.4;
/// The space around everything, in em.
const MARGIN: f64 = 1.0;
/// The space between plot and legend, in em.
const LEGEND_GAP: f64 = 1.3;
/// The space between legend and key, in em.
const KEY_GAP: f64 = 0.7;
/// The most rows of a legend.
const MOST_ROWS: usize = 24;
/// The most lines of a title.
const MOST_TITLE_LINES: usize = 3;
/// The largest part of the width that a legend at the side may take.
const WIDEST_LEGEND: f64 = 0.42;
/// The largest part of the height that a legend below may take.
const HIGHEST_LEGEND: f64 = 0.4;
/// Pictures that are this many times higher than wide have their legend below.
const UPRIGHT: f64 = 1.15;

/// Where everything goes.
#[derive(Debug)]
pub(super) struct Layout {
    /// The space around everything.
    pub margin: f64,
    /// The lines of the title.
    pub title: Vec<Text>,
    /// The plot, on whole pixels.
    pub plot: Rect,
    /// The axes, unless the picture is too small for them.
    pub frame: Option<Placed>,
    /// The legend, unless the picture is too small for it.
    pub legend: Option<PlacedLegend>,
    /// What there is no room for.
    pub left_out: Vec<&'static str>,
}

/// A legend that has found its place, and the key to lines below it.
#[derive(Debug)]
pub(super) struct PlacedLegend {
    pub legend: Legend,
    pub at: Point,
    pub width: f64,
    pub columns: usize,
    pub key_at: Point,
    pub key_columns: usize,
}

/// What a picture shows besides the regions and their axes.
#[derive(Clone, Copy, Debug)]
struct Detail {
    legend: Option<LegendDetail>,
    title: bool,
    axis_titles: bool,
}

#[derive(Clone, Copy, Debug)]
struct LegendDetail {
    shares: bool,
    definition: Definition,
}

/// How the meaning of labels is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Definition {
    /// By where stops stand.
    Places,
    /// By their names.
    Names,
    Missing,
}

/// The parts of a picture that may be left out.
const LEGEND: &str = "the legend";
const TITLE: &str = "the title";
const LONG_TITLE: &str = "so long a title";
const AXIS_TITLES: &str = "the titles of the axes";
const AXES: &str = "the axes";

impl Detail {
    fn left_out(self) -> Vec<&'static str> {
        let parts = [(self.legend.is_none(), LEGEND), (!self.title, TITLE), (!self.axis_titles, AXIS_TITLES)];
        parts.into_iter().filter(|(out, _)| *out).map(|(_, part)| part).collect()
    }

    const fn new(legend: Option<LegendDetail>, title: bool, axis_titles: bool) -> Self {
        Detail { legend, title, axis_titles }
    }

    /// From everything to the axes alone, in the order in which things are given up.
    const LADDER: [Detail; 7] = {
        let full = LegendDetail { shares: true, definition: Definition::Places };
        let shorter = LegendDetail { shares: true, definition: Definition::Names };
        let undefined = LegendDetail { shares: true, definition: Definition::Missing };
        let names = LegendDetail { shares: false, definition: Definition::Missing };
        [
            Detail::new(Some(full), true, true),
            Detail::new(Some(shorter), true, true),
            Detail::new(Some(undefined), true, true),
            Detail::new(Some(names), true, true),
            Detail::new(None, true, true),
            Detail::new(None, false, true),
            Detail::new(None, false, false),
        ]
    };
}

impl Layout {
    /// The layout with the most detail that fits, of a picture that is to have a legend, or none.
    pub fn of(legend: bool, title: &[Text], census: &Census, frame: &Frame, key: &Key, size: Size) -> Self {
        let mut all = Attempt { title, census, frame, key, size, em: size.em() };
        // For a title that is longer than there ever is room for nothing else is given up.
        let long = all.title_lines().is_none();
        if long {
            all.title = &[];
        }
        let attempt = |detail: Detail| {
            let layout = all.layout(detail)?;
            let mut left_out = detail.left_out();
            left_out.retain(|part| (legend || *part != LEGEND) && !(long && *part == TITLE));
            left_out.extend(long.then_some(LONG_TITLE));
            Some(Layout { left_out, ..layout })
        };
        let mut wanted = Detail::LADDER.into_iter().filter(|detail| legend || detail.legend.is_none());
        wanted.find_map(attempt).unwrap_or_else(|| Layout::bare(size))
    }

    /// The regions alone.
    fn bare(size: Size) -> Self {
        let left_out = vec![LEGEND, TITLE, AXIS_TITLES, AXES];
        let plot = Rect::whole(size);
        Layout { margin: 0.0, title: Vec::new(), plot, frame: None, legend: None, left_out }
    }
}

struct Attempt<'a> {
    title: &'a [Text],
    census: &'a Census,
    frame: &'a Frame,
    key: &'a Key,
    size: Size,
    em: f64,
}

impl Attempt<'_> {
    fn layout(&self, detail: Detail) -> Option<Layout> {
        let em = self.em;
        let margin = MARGIN * em;
        let (width, height) = (f64::from(self.size.width()), f64::from(self.size.height()));
        let mut space =
            Rect { x: margin, y: margin, width: width - 2.0 * margin, height: height - 2.0 * margin };
        let title = if detail.title { self.title_lines()? } else { Vec::new() };
        space.height -= title.len() as f64 * TITLE_ROW * em;
        space.y += title.len() as f64 * TITLE_ROW * em;
        let Some(wanted) = detail.legend else {
            let placed = self.frame.place(space, em, detail.axis_titles)?;
            return Some(Layout {
                margin,
                title,
                plot: placed.plot,
                frame: Some(placed),
                legend: None,
                left_out: Vec::new(),
            });
        };
        let (placed, legend) = if height > UPRIGHT * width {
            self.legend_below(space, wanted, detail.axis_titles)?
        } else {
            self.legend_beside(space, wanted, detail.axis_titles)?
        };
        let (plot, frame, legend) = (placed.plot, Some(placed), Some(legend));
        Some(Layout { margin, title, plot, frame, legend, left_out: Vec::new() })
    }

    /// The lines of the title; none where they are too many, or too long.
    fn title_lines(&self) -> Option<Vec<Text>> {
        // It starts above the plot, whose left edge is not known yet: ticks and titles take at most this.
        let width = f64::from(self.size.width()) - (2.0 * MARGIN + 7.0) * self.em;
        let lines = Text::wrap(self.title.to_vec(), self.em, width);
        let fits = lines.len() <= MOST_TITLE_LINES && lines.iter().all(|line| line.width(self.em) <= width);
        fits.then_some(lines)
    }

    fn legend_beside(
        &self,
        space: Rect,
        wanted: LegendDetail,
        axis_titles: bool,
    ) -> Option<(Placed, PlacedLegend)> {
        let em = self.em;
        let notes = self.notes(wanted);
        let plot_height = self.frame.place(space, em, axis_titles)?.plot.height;
        let key_height = self.key_height(1);
        let rows = Legend::rows_in(plot_height - key_height, notes.len(), em).min(MOST_ROWS);
        let legend = self.legend(rows, wanted, notes)?;
        let width = legend.width(1, em).max(self.key.width(em));
        if width > WIDEST_LEGEND * f64::from(self.size.width()) {
            return None;
        }
        let left = Rect { width: space.width - width - LEGEND_GAP * em, ..space };
        let placed = self.frame.place(left, em, axis_titles)?;
        let at = Point { x: space.right() - width, y: placed.plot.y - 0.25 * em };
        let key_at = Point { x: at.x, y: at.y + legend.height(1, em) + KEY_GAP * em };
        Some((placed, PlacedLegend { legend, at, width, columns: 1, key_at, key_columns: 1 }))
    }

    fn legend_below(
        &self,
        space: Rect,
        wanted: LegendDetail,
        axis_titles: bool,
    ) -> Option<(Placed, PlacedLegend)> {
        let em = self.em;
        let notes = Text::wrap(self.notes(wanted), em, space.width - 7.0 * em);
        let most = HIGHEST_LEGEND * f64::from(self.size.height());
        // The legend stands under the plot, whose width does not depend on its height but for the labels.
        let width = self.frame.place(space, em, axis_titles)?.plot.width;
        let columns = self.legend(MOST_ROWS, wanted, Vec::new())?.columns_in(width, em);
        let key_columns = self.key.columns_in(width, em);
        let key_height = self.key_height(key_columns);
        let in_column = Legend::rows_in(most - key_height, notes.len(), em);
        let legend = self.legend((in_column * columns).min(MOST_ROWS), wanted, notes)?;
        let height = legend.height(columns, em) + key_height;
        if legend.width(columns, em) > width || self.key.width(em) > width || height > most {
            return None;
        }
        let above = Rect { height: space.height - height - LEGEND_GAP * em, ..space };
        let placed = self.frame.place(above, em, axis_titles)?;
        let Rect { x, width, .. } = placed.plot;
        let at = Point { x, y: space.bottom() - height };
        let key_at = Point { x, y: space.bottom() - key_height + KEY_GAP * em };
        Some((placed, PlacedLegend { legend, at, width, columns, key_at, key_columns }))
    }

    /// The meaning of labels, as it is wanted.
    fn notes(&self, wanted: LegendDetail) -> Vec<Text> {
        match wanted.definition {
            Definition::Places => names::definition(self.census, false),
            Definition::Names => names::definition(self.census, true),
            Definition::Missing => Vec::new(),
        }
    }

    /// The height of the key with the space above it.
    fn key_height(&self, columns: usize) -> f64 {
        match self.key.height(columns, self.em) {
            0.0 => 0.0,
            height => height + KEY_GAP * self.em,
        }
    }

    /// The legend in at most `rows` rows.
    fn legend(&self, rows: usize, wanted: LegendDetail, notes: Vec<Text>) -> Option<Legend> {
        let indispensable = self.census.indispensable();
        let any_periodic = usize::from(indispensable < self.census.regions.len());
        if rows < indispensable + any_periodic {
            return None;
        }
        let heading = if wanted.shares {
            ["motion".into(), "share of plane".into()]
        } else {
            ["motion".into(), Text::new()]
        };
        Some(Legend { heading, entries: names::entries(self.census, rows, wanted.shares), notes })
    }
}
