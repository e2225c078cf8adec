//! `impact-atlas map --control`: a plane whose cells are all controlled.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use impact_atlas::control::NEVER;
use impact_atlas::plane::ControlMap;
use impact_atlas::render::{self, Size};
use impact_atlas::store::{self, Output};
use impact_atlas::sweep::sweep_control;
use serde::Serialize;

use super::controlled::ControlledArgs;
use super::map::in_order;
use super::method::MethodName;
use super::options::{BackendArgs, PlaneArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, files, interrupt, note, pictures};

/// Control of every cell of a map, and what is drawn of it.
#[derive(Debug, Args)]
pub struct ControlMapArgs {
    #[command(flatten)]
    pub cells: ControlledArgs,

    /// Draws how many iterates control took, a PNG or SVG file
    #[arg(long, value_name = "FILE", requires = "control", help_heading = "Control")]
    times: Option<PathBuf>,
}

/// What is printed.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    method: &'static str,
    cells: u64,
    /// Cells that reach a motion whose points on the section keep returning.
    converged: u64,
    /// The median of their convergence times in iterates.
    median_time: Option<u32>,
    /// Cells that control drove beyond all bounds; they count as unresolved.
    runaway: u64,
    escapes: u64,
    seconds: f64,
    #[serde(serialize_with = "in_order")]
    regimes: [(&'static str, u64); 8],
    backend: &'a str,
    adapter: &'a str,
}

/// Runs the command.
pub fn run(
    method: MethodName,
    args: &ControlMapArgs,
    plane: &PlaneArgs,
    backend: &BackendArgs,
    [out, data]: [PathBuf; 2],
    size: Size,
    json: bool,
) -> Result<(), CliError> {
    let plane = args.cells.plane(method, plane)?;
    pictures::format_of(&out)?;
    if let Some(times) = &args.times {
        pictures::format_of(times)?;
    }
    let [Some(picture), Some(data), times] =
        files::prepare([Some(out.as_path()), Some(data.as_path()), args.times.as_deref()])?
    else {
        unreachable!("two paths give two outputs")
    };
    let backend = backend.open()?;
    let began = Instant::now();
    let progress = Progress::of_cells("controlling", plane.plane().cells());
    let map = sweep_control(&plane, &*backend, &progress)?;
    drop(progress);
    let summary = Summary::new(&map, began.elapsed().as_secs_f64());
    let bytes = pictures::encoded(&render::control_map(&map, size), pictures::format_of(picture.path())?)?;
    interrupt::check()?;
    files::write(&data, |file| store::write_control_map(&map, file))?;
    files::write(&picture, |file| file.write_all(&bytes))?;
    let mut written: Vec<&Output> = vec![&picture, &data];
    if let Some(times) = &times {
        pictures::write(&render::convergence_map(&map, size), times)?;
        written.push(times);
    }
    let names: Vec<String> = written.iter().map(|output| output.path().display().to_string()).collect();
    note(&format!("written: {}", names.join(", ")));
    if json { print_json(&summary) } else { print(&summary.text()) }
}

impl<'a> Summary<'a> {
    fn new(map: &'a ControlMap, seconds: f64) -> Self {
        let mut times: Vec<u32> =
            map.outcomes.iter().map(|o| o.converged_at).filter(|&time| time != NEVER).collect();
        times.sort_unstable();
        Summary {
            method: map.plane.control.method(),
            cells: map.outcomes.len() as u64,
            converged: times.len() as u64,
            median_time: times.get(times.len() / 2).copied(),
            runaway: map.outcomes.iter().filter(|o| o.runaway).count() as u64,
            escapes: map.outcomes.iter().map(|o| u64::from(o.escapes)).sum(),
            seconds,
            regimes: map.motions().census().map(|(regime, cells)| (regime.name(), cells)),
            backend: &map.provenance.backend,
            adapter: &map.provenance.adapter,
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![format!(
            "{} cells in {:.2} s; {} reach a periodic motion{}",
            self.cells,
            self.seconds,
            self.converged,
            self.median_time.map(|n| format!(", half of them within {n} iterates")).unwrap_or_default()
        )];
        for (name, cells) in self.regimes.into_iter().filter(|(_, cells)| *cells > 0) {
            let share = 100.0 * cells as f64 / self.cells as f64;
            lines.push(format!("  {name:<24} {cells:>10}  {share:>6.2} %"));
        }
        if self.runaway > 0 {
            lines.push(format!("control drove {} of the unresolved cells beyond all bounds", self.runaway));
        }
        lines.join("\n")
    }
}
