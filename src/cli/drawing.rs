//! What of a plane is drawn, and how: options that `map` and `render` share.

use std::path::Path;

use clap::Args;
use impact_atlas::analysis::Schedule;
use impact_atlas::curves::Curve;
use impact_atlas::figure::{Palette, Picture, Size, Spread};
use impact_atlas::plane::fields::{Cells, Layer, thinned};
use impact_atlas::plane::{Axis, RegionMap, Window};
use impact_atlas::render::{DrawnCurves, PlanePicture, Shown};

use super::values::{counted, parse, parse_size, parse_span};
use super::{CliError, Result, curve_list, curve_table, curves, defaults, wrong};

/// Curves are read off a map of so many cells at most, those of a larger one in equal steps.
const MOST_CELLS_OF_CURVES: usize = 480_000;

/// What is drawn, and how.
#[derive(Clone, Debug, Args)]
pub struct DrawingArgs {
    /// The picture's size in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = parse_size, default_value = defaults::PICTURE_SIZE)]
    pub size: Size,

    /// What is drawn of every cell: motion, or a field by its number, such as lyapunov, impacts_per_period, settling,
    /// state.x1
    #[arg(long, value_name = "LAYER", default_value = Layer::MOTION)]
    layer: String,

    /// What stands above the plane [default: its parameters and its start]
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,

    /// The colours of a layer of numbers: viridis, cividis, magma, inferno, plasma, turbo, blue-red, purple-green,
    /// brown-green
    #[arg(long, value_name = "NAME", value_parser = parse::<Palette>)]
    palette: Option<Palette>,

    /// The ends of the colour bar [default: those of the numbers]
    #[arg(long, value_name = "A:B", value_parser = parse_span, allow_hyphen_values = true)]
    range: Option<[f64; 2]>,

    /// Leaves the legend, or the colour bar, out
    #[arg(long)]
    no_legend: bool,

    /// Largest N, in forcing periods, of the motions whose curves are computed [default: that of `curves`]
    #[arg(long, value_name = "N", requires = "curves", value_parser = counted(1, Schedule::LARGEST_PERIOD))]
    curves_max_period: Option<u32>,
}

/// Where curves come from.
#[derive(Clone, Copy, Debug)]
pub enum CurveSource<'a> {
    /// The curves are computed, and these of them drawn.
    Computed(Shown),
    /// They are read from a table, likewise.
    Table(&'a Path, Shown),
}

/// Curves, and the map that they are drawn over.
pub struct Curves {
    map: RegionMap,
    /// The curves.
    pub curves: Vec<Curve>,
    which: Shown,
    max_period: Option<u32>,
}

impl DrawingArgs {
    /// The option of the size.
    pub const SIZE: &str = "size";
    /// The option of the layer.
    pub const LAYER: &str = "layer";

    /// The options that were given.
    pub fn given(&self) -> impl Iterator<Item = &'static str> {
        let given = [
            (Self::LAYER, self.layer != Layer::MOTION),
            ("title", self.title.is_some()),
            ("palette", self.palette.is_some()),
            ("range", self.range.is_some()),
            ("no-legend", self.no_legend),
            ("curves-max-period", self.curves_max_period.is_some()),
            (Self::SIZE, parse_size(defaults::PICTURE_SIZE) != Ok(self.size)),
        ];
        given.into_iter().filter(|(_, given)| *given).map(|(option, _)| option)
    }

    /// Refuses what does not fit a plane.
    pub fn check(&self, family: &'static impact_atlas::system::Family) -> Result<Layer> {
        let layer = Layer::named(&self.layer, family).map_err(CliError::input)?;
        if layer == Layer::Motion {
            let given = [("--palette", self.palette.is_some()), ("--range", self.range.is_some())];
            if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
                return Err(wrong!(
                    "{option} is for layers of numbers, and motions have colours of their own: choose a --layer"
                ));
            }
        }
        if let Layer::Number { drawn, .. } = layer
            && let Some([low, _]) = self.range
            && drawn.spread == Spread::Ratios
            && low <= 0.0
        {
            return Err(wrong!(
                "the colour bar of {} has equal ratios: --range must begin above 0, not at {low}",
                self.layer
            ));
        }
        Ok(layer)
    }

    /// Refuses a layer that some cells do not have.
    pub fn check_there(&self, cells: &dyn Cells) -> Result<Layer> {
        let layer = self.check(cells.plane().parameters.family())?;
        if layer.is_with(cells.extras()) {
            return Ok(layer);
        }
        Err(wrong!("these data do not have the layer {}: compute them with `map --extents`", self.layer))
    }

    /// The curves over a window.
    pub fn curves(&self, cells: &dyn Cells, window: Window, source: CurveSource) -> Result<Curves> {
        if let (CurveSource::Table(path, _), Some(n)) = (source, self.curves_max_period) {
            let path = path.display();
            return Err(wrong!("--curves-max-period {n} has no effect on the curves of `{path}`: drop it"));
        }
        let map = thinned(cells, window, MOST_CELLS_OF_CURVES).map_err(CliError::input)?;
        Ok(match source {
            CurveSource::Table(path, which) => {
                Curves { curves: curve_table::read(path, &map.plane)?, map, which, max_period: None }
            }
            CurveSource::Computed(which) => {
                impact_atlas::curves::check(&map.plane).map_err(CliError::input)?;
                let max_period = self.curves_max_period.unwrap_or(defaults::CURVES_MAX_PERIOD);
                let (map, found) = curves::of_map(map, max_period)?;
                curve_list::note_left_out(&found.left_out);
                Curves { map, curves: found.curves, which, max_period: Some(max_period) }
            }
        })
    }

    /// Draws a window of a plane, with the curves of a source over it; gives these as well.
    pub fn draw(
        &self,
        cells: &dyn Cells,
        window: Window,
        source: Option<CurveSource>,
    ) -> Result<(Picture, Vec<Curve>)> {
        self.check_there(cells)?;
        let found = source.map(|source| self.curves(cells, window, source)).transpose()?;
        let drawn = self.draw_under(cells, window, found.as_ref())?;
        Ok((drawn, found.map(|found| found.curves).unwrap_or_default()))
    }

    /// Draws a window of a plane, with curves over it.
    pub fn draw_under(&self, cells: &dyn Cells, window: Window, found: Option<&Curves>) -> Result<Picture> {
        let curves = found.map(|found| DrawnCurves {
            map: &found.map,
            curves: &found.curves,
            shown: found.which,
            max_period: found.max_period,
        });
        let picture = PlanePicture {
            cells,
            window,
            layer: self.check_there(cells)?,
            curves,
            title: self.title.clone(),
            palette: self.palette,
            range: self.range,
            legend: !self.no_legend,
        };
        picture.draw(self.size).map_err(CliError::input)
    }
}

/// The part of a plane between given values.
pub fn window(cells: &dyn Cells, x: Option<[f64; 2]>, y: Option<[f64; 2]>) -> Result<Window> {
    let plane = cells.plane();
    let on = |option: &str, axis: &Axis, range: Option<[f64; 2]>| match range {
        None => Ok((0, axis.count)),
        Some([a, b]) => axis
            .between(a, b)
            .ok_or_else(|| wrong!("{option} {a}:{b} holds none of the cells, whose axis is {axis}")),
    };
    let ((column, columns), (row, rows)) = (on("--x", &plane.x, x)?, on("--y", &plane.y, y)?);
    Ok(Window { column, row, columns, rows })
}
