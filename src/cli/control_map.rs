//! `impact-atlas map --control`: a plane whose cells are all controlled.

use std::time::Instant;

use impact_atlas::control::{Method, NEVER};
use impact_atlas::plane::{Control, RegionMap};
use impact_atlas::render;
use impact_atlas::store;
use impact_atlas::sweep::sweep;
use serde::Serialize;

use super::census::{self, Census};
use super::drawing::DrawingArgs;
use super::files::{self, Batch, Kind};
use super::map_args::MapArgs;
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{Result, defaults, estimate, wrong};

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
    #[serde(serialize_with = "census::in_order")]
    regimes: Census,
    backend: &'a str,
    adapter: &'a str,
}

/// Runs the command.
pub fn run(method: &Method, args: &MapArgs) -> Result<()> {
    let of_motions = args.drawing.given().find(|&option| option != DrawingArgs::SIZE);
    if let Some(option) = of_motions.or(args.curves_out.as_ref().map(|_| "curves-out")) {
        return Err(wrong!(
            "--{option} has no effect on a map under control, which shows what is reached: drop it"
        ));
    }
    let plane = args.control.cells.plane(method, &args.plane)?;
    if let Some(store) = args.data.as_deref().filter(|path| files::is_store(path)) {
        return Err(wrong!(
            "a map under control has no store, which holds motions and not the outcomes of control: name `{}` with .npz, or \
             compute parts of its plane into files of their own",
            store.display()
        ));
    }
    let out = args.out.clone().unwrap_or_else(|| defaults::PICTURE.into());
    let npz = files::data_beside(&out, args.data.as_deref());
    let wanted = [
        Kind::Picture.at(Some(&out)),
        Kind::Archive.at(npz.as_deref()),
        Kind::Picture.at(args.control.times.as_deref()),
    ];
    let [picture, data, times] = files::prepare(args.overwrite, wanted)?;
    let backend = args.backend.open()?;
    estimate::of_plane("the map", &plane, &*backend)?;
    let began = Instant::now();
    let progress = Progress::of_cells("controlling", plane.cells());
    let map = sweep(&plane, &*backend, &progress)?;
    drop(progress);
    let summary = Summary::new(&map, began.elapsed().as_secs_f64());
    let mut batch = Batch::default();
    batch.picture(&picture, &render::control_map(&map, args.drawing.size))?;
    batch.add(&data, |file| store::write_control_map(&map, file))?;
    if times.is_some() {
        batch.picture(&times, &render::convergence_map(&map, args.drawing.size))?;
    }
    batch.show()?;
    if args.json { print_json(&summary) } else { print(&summary.text()) }
}

impl<'a> Summary<'a> {
    fn new(map: &'a RegionMap<Control>, seconds: f64) -> Self {
        let mut times: Vec<u32> =
            map.verdicts.iter().map(|o| o.converged_at).filter(|&time| time != NEVER).collect();
        times.sort_unstable();
        Summary {
            method: map.plane.task.scheme.method().name,
            cells: map.verdicts.len() as u64,
            converged: times.len() as u64,
            median_time: times.get(times.len() / 2).copied(),
            runaway: map.verdicts.iter().filter(|o| o.runaway).count() as u64,
            escapes: map.verdicts.iter().map(|o| u64::from(o.escapes)).sum(),
            seconds,
            regimes: map.census().map(|(regime, cells)| (regime.name(), cells)),
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
            self.median_time
                .map(|n| format!(", half of them within {n} iterate{}", if n == 1 { "" } else { "s" }))
                .unwrap_or_default()
        )];
        lines.extend(census::lines(self.regimes, self.cells));
        if self.runaway > 0 {
            lines.push(format!("control drove {} of the unresolved cells beyond all bounds", self.runaway));
        }
        lines.join("\n")
    }
}
