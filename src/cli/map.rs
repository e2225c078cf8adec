//! `impact-atlas map`: a plane, computed, stored and drawn.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::anyhow;
use clap::Args;
use impact_atlas::backend::Backend;
use impact_atlas::plane::fields::Extras;
use impact_atlas::plane::{Part, Plane, RegionMap, Tiling, Window};
use impact_atlas::store;
use impact_atlas::sweep::{Certification, certify, measure_extents, sweep};
use serde::{Serialize, Serializer};

use super::control_map::{self, ControlMapArgs};
use super::drawing::{CurveSource, DrawingArgs, Which};
use super::files::{self, Batch, Kind};
use super::options::{BackendArgs, OverwriteArgs, PlaneArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::{counted, parse};
use super::{CliError, cell, curve_list, defaults, estimate, stored};

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
  impact-atlas map --x omega=0.2:5:4000 --y delta=0.02:0.8:3000 --data plane.zarr --part 17/64
  impact-atlas map --layer settling --out settling.png
  impact-atlas map --from map.png --set r=0.7 --out softer.png
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

    /// The picture, a PNG, SVG or PDF file [default: map.png; none where the data are a store]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// The data, an npz file or a Zarr store [default: beside the picture, with its name and .npz]
    ///
    /// A store (DATA.zarr) is written tile by tile: the same command again computes what is missing and nothing else, and
    /// memory does not grow with the plane.
    #[arg(long, value_name = "FILE.npz|DATA.zarr")]
    pub data: Option<PathBuf>,

    /// Computes the K-th of M parts of a store; the parts cost about the same, and need no word with each other
    #[arg(long, value_name = "K/M", value_parser = parse::<Part>, requires = "data", conflicts_with = "control")]
    pub part: Option<Part>,

    /// Cells along a side of a store's tiles, the unit of its files [default: 16 to 128, by the plane's size]
    #[arg(long, value_name = "N", requires = "data", value_parser = counted(1, Tiling::LARGEST), conflicts_with = "control")]
    pub tile: Option<u32>,

    #[command(flatten)]
    pub drawing: DrawingArgs,

    /// Certifies every periodic cell: its motion is solved by Newton's method
    ///
    /// Label, symmetry, exponent, state and multipliers are then those of the exact orbit, which must be stable and must be
    /// what the trajectory approaches. What is not confirmed is looked at for longer, and is unresolved if that does not
    /// help. The data then hold the Floquet multipliers too.
    #[arg(long, conflicts_with = "control")]
    pub certify: bool,

    /// Also measures how far every coordinate goes: its root mean square and its peak, the fields `rms` and `peak` and the layers
    /// rms.x1, peak.x1 and so on
    ///
    /// Every trajectory is followed on for whole periods of its motion. A --layer that is one of these asks for it too.
    #[arg(long, conflicts_with = "control")]
    pub extents: bool,

    /// Draws bifurcation curves over the map, and names them: those that bound what can be observed, or all of them
    #[arg(long, value_name = "WHICH", value_enum, num_args = 0..=1, require_equals = true,
        default_missing_value = "bounding")]
    pub curves: Option<Which>,

    /// Writes every point of every curve, as `curves` does
    #[arg(long, value_name = "FILE.csv", requires = "curves")]
    pub curves_out: Option<PathBuf>,

    #[command(flatten)]
    pub overwrite: OverwriteArgs,

    /// Prints JSON: cells, impacts, seconds, impacts_per_second, regimes, certified, backend, adapter; of a store part,
    /// tiles_there, tiles_computed, tiles_failed, tiles_missing in place of regimes and certified
    #[arg(long)]
    pub json: bool,
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
    let made = args.control.cells.again().map(cell::made).transpose()?;
    let plane = match &made {
        Some(made) => args.plane.again(&made.plane)?,
        None => args.plane.plane()?,
    };
    let options =
        made.as_ref().map_or_else(|| args.backend.clone(), |made| args.backend.or_those_of(&made.provenance));
    let family = plane.parameters.family();
    if args.curves.is_some() {
        impact_atlas::curves::check(&plane).map_err(CliError::input)?;
    }
    let layer = args.drawing.check(family)?;
    let certified = args.certify || made.as_ref().is_some_and(|made| made.certified);
    let extents = args.extents || made.as_ref().is_some_and(|made| made.extents);
    let without = Extras { certified, extents };
    // A layer asks for what it shows.
    let extras = if layer.is_with(without) { without } else { Extras { extents: true, ..without } };
    match args.data.as_deref().filter(|path| stored::is_store(path)) {
        Some(path) => stored::run(args, &plane, path, &options, extras),
        None => in_memory(args, &plane, &options, extras),
    }
}

/// A plane whose cells are all held at once, and written into one file.
fn in_memory(args: &MapArgs, plane: &Plane, options: &BackendArgs, extras: Extras) -> Result<(), CliError> {
    if args.part.is_some() || args.tile.is_some() {
        return Err(CliError::Input(anyhow!(
            "--part and --tile are for stores: give --data DATA.zarr in place of an npz file"
        )));
    }
    if plane.cells() > Plane::LARGEST_AT_ONCE {
        return Err(CliError::Input(anyhow!(
            "a plane of {} cells is too large for one file: at most {} cells are accepted; give --data DATA.zarr",
            plane.cells(),
            Plane::LARGEST_AT_ONCE
        )));
    }
    let out = args.out.clone().unwrap_or_else(|| defaults::PICTURE.into());
    let npz = files::data_beside(&out, args.data.as_deref());
    let wanted = [
        Kind::Picture.at(Some(&out)),
        Kind::Archive.at(npz.as_deref()),
        Kind::Table.at(args.curves_out.as_deref()),
    ];
    let [picture, data, table] = files::prepare(args.overwrite, wanted)?;
    let backend = options.open()?;
    estimate::of_plane("the map", plane, &*backend)?;
    let began = Instant::now();
    let mut map = sweep(plane, &*backend, &Progress::of_cells("computing", plane.cells()))?;
    let seconds = began.elapsed().as_secs_f64();
    let certified = extras.certified.then(|| certified(&mut map, &*backend)).transpose()?;
    if extras.extents {
        let progress = Progress::of_cells("measuring", plane.cells());
        measure_extents(&mut map, &*backend, &progress)?;
    }
    let whole = Window::whole(plane);
    let curves = args.drawing.curves(&map, whole, args.curves.map(CurveSource::Computed))?;
    let drawn = args.drawing.draw(&map, whole, curves.as_ref())?;
    let mut batch = Batch::default();
    batch.picture(&picture, &drawn)?;
    batch.add(&data, |file| store::write_map(&map, file))?;
    if let Some(found) = &curves {
        curve_list::add_table(&mut batch, &table, &found.curves, plane)?;
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
