//! `impact-atlas map`: a plane, computed, stored and drawn.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use impact_atlas::plane::RegionMap;
use impact_atlas::render::Size;
use impact_atlas::sweep::sweep;
use serde::{Serialize, Serializer};

use super::control_map::{self, ControlMapArgs};
use super::options::{BackendArgs, PlaneArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::parse_size;
use super::{CliError, defaults, files, note, pictures};

/// Computes what every cell of a parameter plane settles on, as a picture and as data
///
/// The data (NumPy's npz) hold every cell's regime, label, Lyapunov exponent and end state.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas map
  impact-atlas map --x omega=2.4:3.8:400 --y r=0.5:0.95:300 --set delta=0.1 --out r.png
  impact-atlas map --x x1=-0.1:0.1:400 --y v1=-2:2:400 --set omega=1.65 --out basins.png
  impact-atlas map --control delay --x omega=2.6:3:200 --y gain=0:1:150 --out delay.png --times times.png
  impact-atlas map --control pulse --x target_v1=-0.5:-0.1:200 --y target_tau=1:3:150 --set omega=2.83")]
pub struct MapArgs {
    #[command(flatten)]
    plane: PlaneArgs,

    #[command(flatten)]
    backend: BackendArgs,

    #[command(flatten)]
    control: ControlMapArgs,

    /// The picture, a PNG or SVG file
    #[arg(long, value_name = "FILE", default_value = defaults::PICTURE)]
    out: PathBuf,

    /// The data, an npz file [default: beside the picture, with its name]
    #[arg(long, value_name = "FILE.npz")]
    data: Option<PathBuf>,

    /// The picture's size in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = parse_size, default_value = defaults::PICTURE_SIZE)]
    size: Size,

    /// Prints JSON: cells, impacts, seconds, impacts_per_second, regimes, backend, adapter
    #[arg(long)]
    json: bool,
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
    backend: &'a str,
    adapter: &'a str,
}

pub fn in_order<S: Serializer>(regimes: &[(&str, u64); 8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(regimes.iter().copied())
}

/// Runs the command.
pub fn run(args: &MapArgs) -> Result<(), CliError> {
    if let Some(method) = args.control.control {
        let data = args.data.clone().unwrap_or_else(|| args.out.with_extension("npz"));
        let MapArgs { plane, backend, control, size, json, .. } = args;
        return control_map::run(method, control, plane, backend, [args.out.clone(), data], *size, *json);
    }
    args.control.refuse_settings()?;
    let plane = args.plane.plane()?;
    pictures::format_of(&args.out)?;
    let npz = args.data.clone().unwrap_or_else(|| args.out.with_extension("npz"));
    let [Some(picture), Some(data)] = files::prepare([Some(args.out.as_path()), Some(npz.as_path())])? else {
        unreachable!("two paths give two outputs")
    };
    let backend = args.backend.open()?;
    let began = Instant::now();
    let map = sweep(&plane, &*backend, &Progress::of_cells("computing", plane.cells()))?;
    let summary = Summary::new(&map, began.elapsed().as_secs_f64());
    files::write_map(&map, args.size, &data, &picture)?;
    note(&format!("written: {} and {}", picture.path().display(), data.path().display()));
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
        lines.join("\n")
    }
}
