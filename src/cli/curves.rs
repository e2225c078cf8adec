//! `impact-atlas curves`: the bifurcation curves of a plane.

use std::path::PathBuf;

use clap::{Args, value_parser};
use impact_atlas::analysis::Schedule;
use impact_atlas::curves::{self, Curve};
use impact_atlas::plane::{Plane, RegionMap};
use impact_atlas::sweep::sweep;

use super::options::{AxesArgs, BackendArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, curve_list, defaults, files, interrupt, note};

/// Computes the bifurcation curves of a plane of two parameters
///
/// A map of the plane, coarser than that of `map`, shows which motions there are. Each is refined and followed to
/// where it loses its stability or grazes a stop, and from there the curve is followed through the plane: folds, period
/// doublings, pitchforks, Neimark-Sacker bifurcations and grazing. The map only says where to begin: a curve is as
/// exact for a coarse map as for a fine one, but a motion that no cell shows has no curve.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas curves
  impact-atlas curves --out curves.csv --json
  impact-atlas curves --x r=0.5:0.95:80 --y zeta=0.02:0.3:60 --set omega=2.4 --max-period 4")]
pub struct CurvesArgs {
    #[command(flatten)]
    axes: AxesArgs,

    /// Looks for motions on about K cells, whatever COUNT the axes have [default: 19200 where no axis is given]
    #[arg(long, value_name = "K", value_parser = value_parser!(u32).range(4..=Plane::LARGEST as i64))]
    cells: Option<u32>,

    /// Largest N of the motions N-p-q whose curves are computed
    #[arg(long, value_name = "N", default_value_t = defaults::CURVES_MAX_PERIOD,
        value_parser = value_parser!(u32).range(1..=i64::from(Schedule::LARGEST_PERIOD)))]
    max_period: u32,

    /// Forcing periods before a cell is observed
    #[arg(long, value_name = "P", default_value_t = defaults::TRANSIENT)]
    transient: u32,

    /// Forcing periods for which a cell is observed
    #[arg(long, value_name = "P", default_value_t = defaults::OBSERVE)]
    observe: u32,

    #[command(flatten)]
    backend: BackendArgs,

    /// Writes every point: curve, kind, motion, x, y, criticality, point, symmetric, bounding
    ///
    /// A curve has the paper's name (L1 to L7) or a number; `point` is ordinary or the name of a special point.
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,

    /// Prints JSON: [{number, name, kind, motion, symmetric, points, ends, criticality, bounding, special_points}]
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &CurvesArgs) -> Result<(), CliError> {
    let schedule = Schedule {
        transient: args.transient,
        observe: args.observe,
        max_period: defaults::MAX_PERIOD.max(args.max_period),
        fixed_periods: false,
    };
    let plane = args.axes.plane_of(schedule, args.cells, defaults::CURVES_CELLS)?;
    curves::check(&plane).map_err(CliError::input)?;
    files::check_csv(args.out.as_deref())?;
    let [output] = files::prepare([args.out.as_deref()])?;
    let backend = args.backend.open()?;
    let map = sweep(&plane, &*backend, &Progress::of_cells("looking for motions", plane.cells()))?;
    let (_, curves) = of_map(map, args.max_period)?;
    if let Some(output) = output {
        curve_list::write_csv(&output, &curves, &plane)?;
        note(&format!("written: {}", output.path().display()));
    }
    let summaries = curve_list::summaries(&curves, &plane);
    if args.json { print_json(&summaries) } else { print(&curve_list::text(&summaries, &plane)) }
}

/// The curves of a map, which is handed back.
pub fn of_map(map: RegionMap, max_period: u32) -> Result<(RegionMap, Vec<Curve>), CliError> {
    let progress = Progress::of_curves();
    let (map, curves) = interrupt::abandonable(move || {
        let curves = curves::bifurcation_curves(&map, max_period);
        (map, curves)
    })?;
    drop(progress);
    let curves = curves.map_err(CliError::input)?;
    if curves.is_empty() {
        note(&format!("no motion with a period of up to {max_period} bifurcates on this plane"));
    }
    Ok((map, curves))
}
