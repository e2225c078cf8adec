//! `impact-atlas curves`: the bifurcation curves of a plane.

use std::path::PathBuf;

use clap::Args;
use impact_atlas::analysis::Schedule;
use impact_atlas::curves::{self, PlaneCurves};
use impact_atlas::plane::{Plane, RegionMap, Start};
use impact_atlas::sweep::sweep;

use super::files::{self, Batch, Kind};
use super::options::{AxesArgs, BackendArgs, OverwriteArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::{count, counted};
use super::{CliError, Result, curve_list, curve_table, defaults, estimate, interrupt, note};

/// Computes the bifurcation curves of a plane of two parameters
///
/// A map of the plane, coarser than that of `map`, shows which motions there are. Each is refined and followed to
/// where it loses its stability or grazes a stop, and from there the curve is followed through the plane: folds, period
/// doublings, pitchforks, Neimark-Sacker bifurcations and grazing of any stop. The map only says where to begin: a curve is as
/// exact for a coarse map as for a fine one, but a motion that no cell shows has no curve. Motions that the map does show
/// and that no curve bounds are listed, by the reason for it, with the number of their cells.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas curves
  impact-atlas curves --out curves.csv --json
  impact-atlas curves --x r=0.5:0.95:80 --y zeta=0.02:0.3:60 --set omega=2.4 --max-period 4
  impact-atlas curves --system bouncing-ball --out ball.csv")]
pub struct CurvesArgs {
    #[command(flatten)]
    axes: AxesArgs,

    /// Looks for motions on about K cells, whatever COUNT the axes have [default: 19200 where no axis is given]
    #[arg(long, value_name = "K", value_parser = counted(4, Plane::LARGEST_AT_ONCE as u32))]
    cells: Option<u32>,

    /// Largest N, in forcing periods, of the motions whose curves are computed
    #[arg(long, value_name = "N", default_value_t = defaults::CURVES_MAX_PERIOD,
        value_parser = counted(1, Schedule::LARGEST_PERIOD))]
    max_period: u32,

    /// Forcing periods before a cell is observed
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRANSIENT)]
    transient: u32,

    /// Forcing periods for which a cell is observed
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::OBSERVE)]
    observe: u32,

    #[command(flatten)]
    backend: BackendArgs,

    /// Writes every point: curve, kind, motion, x, y, criticality, point, symmetric, bounding
    ///
    /// A curve has a number, or on the paper's plane its name (L1 to L7); `point` is ordinary or the name of a special
    /// point.
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,

    #[command(flatten)]
    overwrite: OverwriteArgs,

    /// Prints JSON: [{number, name, kind, motion, symmetric, points, ends, criticality, bounding, special_points}], with
    /// the stop that is grazed where stops have no mirror images; the motions without a curve are listed on standard error
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &CurvesArgs) -> Result<()> {
    let schedule = Schedule {
        transient: args.transient,
        observe: args.observe,
        max_period: defaults::MAX_PERIOD.max(args.max_period),
        fixed_periods: false,
    };
    let plane = args.axes.resized(args.axes.plane(schedule)?, args.cells, defaults::CURVES_CELLS);
    curves::check(&plane).map_err(CliError::input)?;
    let [output] = files::prepare(args.overwrite, [Kind::Table.at(args.out.as_deref())])?;
    let backend = args.backend.open()?;
    estimate::of_plane("looking for motions", &plane, &*backend)?;
    let map = sweep(&plane, &*backend, &Progress::of_cells("looking for motions", plane.cells()))?;
    tell_of_rest(&plane);
    let (_, PlaneCurves { curves, left_out }) = of_map(map, args.max_period)?;
    let mut batch = Batch::default();
    curve_table::add(&mut batch, &output, &curves, &plane)?;
    batch.show()?;
    let summaries = curve_list::summaries(&curves, &plane);
    if args.json {
        curve_list::note_left_out(&left_out);
        return print_json(&summaries);
    }
    let left_out = curve_list::left_out(&left_out).map(|text| format!("\n{text}")).unwrap_or_default();
    print(&format!("{}{left_out}", curve_list::text(&summaries, &plane)))
}

/// Says that motions were looked for from rest alone, where the default start comes to that.
fn tell_of_rest(plane: &Plane) {
    let plant = plane.parameters_at(plane.x.count / 2, plane.y.count / 2).plant();
    if plane.start == Start::Symmetric && plant.is_ok_and(|plant| plant.mirror().is_none()) {
        note(
            "a system without a mirror begins at rest: motions to which rest does not lead have no curve; look for \
             them from another start, --start X1,V1 (x1 … xn, v1 … vn)",
        );
    }
}

/// The curves of a map, which is handed back.
pub fn of_map(map: RegionMap, max_period: u32) -> Result<(RegionMap, PlaneCurves)> {
    let progress = Progress::of_unknown("following the bifurcation curves");
    let (map, found) = interrupt::abandonable(move || {
        let found = curves::bifurcation_curves(&map, max_period);
        (map, found)
    })?;
    drop(progress);
    let found = found.map_err(CliError::input)?;
    if found.curves.is_empty() {
        note(&format!("no motion with a period of up to {max_period} bifurcates on this plane"));
    }
    Ok((map, found))
}
