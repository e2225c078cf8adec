//! `impact-atlas map`: a plane, computed, stored and drawn.

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use impact_atlas::analysis::Schedule;
use impact_atlas::backend::Backend;
use impact_atlas::plane::RegionMap;
use impact_atlas::render::{Shown, Size, region_map, region_map_with_curves};
use impact_atlas::store;
use impact_atlas::sweep::{Certification, certify, sweep};
use serde::{Serialize, Serializer};

use super::control_map::{self, ControlMapArgs};
use super::files::{self, Batch, Kind};
use super::options::{BackendArgs, OverwriteArgs, PlaneArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::{counted, parse_size};
use super::{CliError, curve_list, curves, defaults, estimate};

/// Computes what every cell of a parameter plane settles on, as a picture and as data
///
/// The data (NumPy's npz) hold every cell's regime, label, Lyapunov exponent and end state.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas map
  impact-atlas map --x omega=2.4:3.8:400 --y r=0.5:0.95:300 --set delta=0.1 --out r.png
  impact-atlas map --curves --curves-out curves.csv
  impact-atlas map --certify
  impact-atlas map --x x1=-0.1:0.1:400 --y v1=-2:2:400 --set omega=1.65 --out basins.png
  impact-atlas map --control delay --x omega=2.6:3:200 --y gain=0:1:150 --out delay.png --times times.png
  impact-atlas map --control pulse --x target_v1=-0.5:-0.1:200 --y target_tau=1:3:150 --set omega=2.83")]
pub struct MapArgs {
    #[command(flatten)]
    pub plane: PlaneArgs,

    #[command(flatten)]
    pub backend: BackendArgs,

    #[command(flatten)]
    pub control: ControlMapArgs,

    /// The picture, a PNG or SVG file
    #[arg(long, value_name = "FILE", default_value = defaults::PICTURE)]
    pub out: PathBuf,

    /// The data, an npz file [default: beside the picture, with its name]
    #[arg(long, value_name = "FILE.npz")]
    pub data: Option<PathBuf>,

    /// The picture's size in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = parse_size, default_value = defaults::PICTURE_SIZE)]
    pub size: Size,

    /// Certifies every periodic cell: its motion is solved by Newton's method
    ///
    /// Label, symmetry, exponent, state and multipliers are then those of the exact orbit, which must be stable and must be
    /// what the trajectory approaches. What is not confirmed is looked at for longer, and is unresolved if that does not
    /// help. The data then hold the Floquet multipliers too.
    #[arg(long, conflicts_with = "control")]
    certify: bool,

    /// Draws bifurcation curves over the map, and names them: those that bound what can be observed, or all of them
    #[arg(long, value_name = "WHICH", value_enum, num_args = 0..=1, require_equals = true,
        default_missing_value = "bounding")]
    curves: Option<Which>,

    /// Largest N, in forcing periods, of the motions whose curves are computed
    #[arg(long, value_name = "N", default_value_t = defaults::CURVES_MAX_PERIOD, requires = "curves",
        value_parser = counted(1, Schedule::LARGEST_PERIOD))]
    curves_max_period: u32,

    /// Writes every point of every curve, as `curves` does
    #[arg(long, value_name = "FILE.csv", requires = "curves")]
    curves_out: Option<PathBuf>,

    #[command(flatten)]
    pub overwrite: OverwriteArgs,

    /// Prints JSON: cells, impacts, seconds, impacts_per_second, regimes, certified, backend, adapter
    #[arg(long)]
    pub json: bool,
}

/// Which parts of the curves are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Which {
    /// Those of motions that fill 0.3 % of the plane, and the paper's, where the motion is stable on one side of the curve
    Bounding,
    /// All of every curve
    All,
}

impl Which {
    fn shown(self) -> Shown {
        match self {
            Which::Bounding => Shown::Bounding,
            Which::All => Shown::All,
        }
    }
}

/// What is printed.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    cells: u64,
    impacts: u64,
    seconds: f64,
    impacts_per_second: f64,
    #[serde(serialize_with = "in_order")]
    regimes: [(&'static str, u64); 8],
    /// With --certify: how that went.
    certified: Option<Certified>,
    backend: &'a str,
    adapter: &'a str,
}

/// How certifying went.
#[derive(Clone, Copy, Debug, Serialize)]
struct Certified {
    periodic: u64,
    confirmed: u64,
    relabelled: u64,
    reexamined: u64,
    unresolved: u64,
    seconds: f64,
}

impl Certified {
    fn text(&self) -> String {
        format!(
            "certified: of {} periodic cells {} confirmed and {} relabelled by their exact orbit, {} looked at for longer, \
             {} unresolved, in {:.2} s",
            self.periodic, self.confirmed, self.relabelled, self.reexamined, self.unresolved, self.seconds
        )
    }
}

/// Certifies a map.
fn certified(map: &mut RegionMap, backend: &dyn Backend) -> Result<Certified, CliError> {
    let began = Instant::now();
    let progress = Progress::of_cells("certifying", map.plane.cells());
    let Certification { periodic, confirmed, relabelled, reexamined, unresolved } =
        certify(map, backend, &progress)?;
    let seconds = began.elapsed().as_secs_f64();
    Ok(Certified { periodic, confirmed, relabelled, reexamined, unresolved, seconds })
}

pub fn in_order<S: Serializer>(regimes: &[(&str, u64); 8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(regimes.iter().copied())
}

/// Runs the command.
pub fn run(args: &MapArgs) -> Result<(), CliError> {
    if let Some(method) = args.control.cells.control {
        return control_map::run(method, args);
    }
    args.control.cells.refuse_settings()?;
    let plane = args.plane.plane()?;
    if args.curves.is_some() {
        impact_atlas::curves::check(&plane).map_err(CliError::input)?;
    }
    let npz = files::data_beside(&args.out, args.data.as_deref());
    let wanted = [
        Kind::Picture.at(Some(&args.out)),
        Kind::Archive.at(npz.as_deref()),
        Kind::Table.at(args.curves_out.as_deref()),
    ];
    let [picture, data, table] = files::prepare(args.overwrite, wanted)?;
    let backend = args.backend.open()?;
    estimate::of_plane("the map", &plane, &*backend)?;
    let began = Instant::now();
    let mut map = sweep(&plane, &*backend, &Progress::of_cells("computing", plane.cells()))?;
    let seconds = began.elapsed().as_secs_f64();
    let certified = args.certify.then(|| certified(&mut map, &*backend)).transpose()?;
    let (map, curves) = match args.curves {
        None => (map, None),
        Some(which) => {
            let (map, found) = curves::of_map(map, args.curves_max_period)?;
            curve_list::note_left_out(&found.left_out);
            (map, Some((found.curves, which)))
        }
    };
    let drawn = match &curves {
        None => region_map(&map, args.size),
        Some((curves, which)) => {
            region_map_with_curves(&map, curves, which.shown(), args.curves_max_period, args.size)
        }
    };
    let mut batch = Batch::default();
    batch.picture(&picture, &drawn)?;
    batch.add(&data, |file| store::write_map(&map, file))?;
    if let Some((curves, _)) = &curves {
        curve_list::add_table(&mut batch, &table, curves, &plane)?;
    }
    batch.show()?;
    let summary = Summary { certified, ..Summary::new(&map, seconds) };
    if args.json { print_json(&summary) } else { print(&summary.text()) }
}

impl<'a> Summary<'a> {
    fn new(map: &'a RegionMap, seconds: f64) -> Self {
        let impacts = map.verdicts.iter().map(|verdict| u64::from(verdict.impacts_total)).sum();
        Summary {
            cells: map.plane.cells(),
            impacts,
            seconds,
            impacts_per_second: impacts as f64 / seconds,
            regimes: map.census().map(|(regime, cells)| (regime.name(), cells)),
            certified: None,
            backend: &map.provenance.backend,
            adapter: &map.provenance.adapter,
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![format!(
            "{} cells and {} impacts in {:.2} s, {:.3e} impacts/s",
            self.cells, self.impacts, self.seconds, self.impacts_per_second
        )];
        for (name, cells) in self.regimes.into_iter().filter(|(_, cells)| *cells > 0) {
            let share = 100.0 * cells as f64 / self.cells as f64;
            lines.push(format!("  {name:<24} {cells:>10}  {share:>6.2} %"));
        }
        lines.extend(self.certified.as_ref().map(Certified::text));
        lines.join("\n")
    }
}
