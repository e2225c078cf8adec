//! `impact-atlas render`: a picture of a plane that was computed before.

use std::fs::File;
use std::path::{Path, PathBuf};

use clap::Args;
use impact_atlas::plane::fields::Cells;
use impact_atlas::render::Shown;
use impact_atlas::store::{ReadError, ZarrStore, read_map};

use super::drawing::{CurveSource, DrawingArgs, window};
use super::files::{self, Batch, Kind};
use super::options::OverwriteArgs;
use super::values::parse_span;
use super::{CliError, Result, wrong};

/// Draws a plane that `map` computed, from its data; nothing is computed again
///
/// A cell of the picture that covers many cells of the plane shows the motion of most of them, or the mean of their numbers.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas render map.npz --out map.pdf
  impact-atlas render plane.zarr --out zoom.png --x 2.4:2.9 --y 0.05:0.2 --size 2000x1500
  impact-atlas render map.npz --out exponent.png --layer lyapunov --range=-1:0.5
  impact-atlas render map.npz --out curves.png --curves curves.csv --title \"Fig. 5\"")]
pub struct RenderArgs {
    /// The data: an npz file or a Zarr store
    #[arg(value_name = "DATA")]
    data: PathBuf,

    /// The picture, a PNG, SVG or PDF file
    #[arg(long, value_name = "FILE")]
    out: PathBuf,

    /// Draws the columns between two values of the horizontal axis alone
    #[arg(long, value_name = "A:B", value_parser = parse_span, allow_hyphen_values = true)]
    x: Option<[f64; 2]>,

    /// Draws the rows between two values of the vertical axis alone
    #[arg(long, value_name = "A:B", value_parser = parse_span, allow_hyphen_values = true)]
    y: Option<[f64; 2]>,

    /// Draws bifurcation curves over it: those of a table that `curves` wrote, or `compute`
    #[arg(long, value_name = "FILE.csv|compute")]
    curves: Option<PathBuf>,

    /// Which of the curves: as for `map`, those that bound what can be observed, or all of them
    #[arg(long, value_name = "WHICH", value_enum, requires = "curves", default_value_t = Shown::Bounding)]
    curves_shown: Shown,

    #[command(flatten)]
    drawing: DrawingArgs,

    #[command(flatten)]
    overwrite: OverwriteArgs,
}

/// Runs the command.
pub fn run(args: &RenderArgs) -> Result<()> {
    let cells = opened(&args.data)?;
    let cells = &*cells;
    args.drawing.check_there(cells)?;
    let window = window(cells, args.x, args.y)?;
    let [picture] = files::prepare(args.overwrite, [Kind::Picture.at(Some(&args.out))])?;
    let source = args.curves.as_deref().map(|curves| match curves.to_str() {
        Some("compute") => CurveSource::Computed(args.curves_shown),
        _ => CurveSource::Table(curves, args.curves_shown),
    });
    let (drawn, _) = args.drawing.draw(cells, window, source)?;
    let mut batch = Batch::default();
    batch.picture(&picture, &drawn)?;
    batch.show()
}

/// The cells of an archive or of a store.
pub fn opened(path: &Path) -> Result<Box<dyn Cells>> {
    let name = path.display();
    if path.is_dir() {
        return Ok(Box::new(ZarrStore::open(path).map_err(CliError::from)?));
    }
    if files::is_picture(path) {
        return Err(wrong!(
            "`{name}` is a picture: give the data beside it, `{}`",
            path.with_extension("npz").display()
        ));
    }
    let file = File::open(path).map_err(|error| wrong!("cannot read `{name}`: {error}"))?;
    let refused = |error: ReadError| {
        let why = anyhow::Error::new(error);
        wrong!(
            "`{name}` cannot be drawn: {why:#}; give an npz file or a store that `map` of this version wrote, of a \
             plane without control"
        )
    };
    Ok(Box::new(read_map(file).map_err(refused)?))
}
