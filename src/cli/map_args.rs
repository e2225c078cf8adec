//! The options of `impact-atlas map`.

use std::path::PathBuf;

use clap::Args;
use impact_atlas::plane::{Part, Tiling};
use impact_atlas::render::Shown;

use super::controlled::ControlledArgs;
use super::drawing::DrawingArgs;
use super::options::{BackendArgs, OverwriteArgs, PlaneArgs, counts_iterates, sets_control};
use super::values::{counted, parse};

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
  impact-atlas map --x x1=-0.1:0.1:400 --y v1=-2:2:400 --set omega=1.65 --layer state.v1 --out basins.png
  impact-atlas map --control delay --x omega=2.6:3:200 --y gain=0:1:150 --out delay.png --times times.png
  impact-atlas map --control pulse --x target_v1=-0.5:-0.1:200 --y target_tau=1:3:150 --set omega=2.83")]
#[command(mut_arg("assignments", sets_control), mut_arg("max_period", counts_iterates))]
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

    /// Computes the K-th of M parts of a store; the parts cost about the same, and are computed independently
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
    pub curves: Option<Shown>,

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

/// Control of every cell of a map, and what is drawn of it.
#[derive(Debug, Args)]
pub struct ControlMapArgs {
    #[command(flatten)]
    pub cells: ControlledArgs,

    /// Draws how many iterates control took, a PNG, SVG or PDF file
    #[arg(long, value_name = "FILE", requires = "control", help_heading = "Control")]
    pub times: Option<PathBuf>,
}
