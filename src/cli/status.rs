//! `impact-atlas status`: how far a store is.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use impact_atlas::store::{Status, ZarrStore};

use super::terminal::{print, print_json};
use super::{Result, spans};

/// Says how far a plane in a store is: its tiles, those missing and failed, and the time left
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas status plane.zarr
  impact-atlas status plane.zarr --json")]
pub struct StatusArgs {
    /// The store
    #[arg(value_name = "DATA.zarr")]
    data: PathBuf,

    /// Prints JSON: {cells, cells_done, tiles, done, missing, failed: [{tile, message}], processes, cells_per_second,
    /// seconds_left, tile, backend, adapter, version}; the times are null where no process at work has finished a tile
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &StatusArgs) -> Result<()> {
    let status = ZarrStore::open(&args.data)?.status()?;
    if args.json { print_json(&status) } else { print(&text(&status)) }
}

fn text(status: &Status) -> String {
    let share = 100.0 * status.cells_done as f64 / status.cells as f64;
    let mut lines = vec![
        format!("{} of {} cells, {share:.1} %", status.cells_done, status.cells),
        format!(
            "{} of {} tiles of {side} × {side} cells are there, {} are missing, {} of them failed",
            status.done,
            status.tiles,
            status.missing,
            status.failed.len(),
            side = status.tile
        ),
    ];
    lines.extend(
        status.failed.iter().map(|failed| format!("  tile {} failed: {}", failed.tile, failed.message)),
    );
    match (status.missing, status.cells_per_second, status.seconds_left) {
        (0, ..) => lines.push("nothing is left to do".to_owned()),
        (_, Some(pace), Some(left)) => lines.push(format!(
            "{} at work, unless killed lately; {pace:.0} cells/s together, about {} left at that pace",
            processes(status.processes),
            spans::words(Duration::from_secs_f64(left.min(1e9)))
        )),
        _ if status.processes > 0 => {
            lines.push(format!(
                "{} at work, unless killed in the last {}; without a tile so far",
                processes(status.processes),
                spans::words(Status::SILENCE)
            ));
        }
        _ => lines.push(
            "no process is at work, as far as is known: `map` with the same options goes on".to_owned(),
        ),
    }
    lines.push(format!("computed by {} {}, impact-atlas {}", status.backend, status.adapter, status.version));
    lines.join("\n")
}

fn processes(count: u32) -> String {
    if count == 1 { "1 process".to_owned() } else { format!("{count} processes") }
}
