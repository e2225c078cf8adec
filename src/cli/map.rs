//! `impact-atlas map`: a plane, computed, stored and drawn.

use std::time::Instant;

use impact_atlas::backend::Backend;
use impact_atlas::plane::fields::Extras;
use impact_atlas::plane::{Plane, RegionMap, Window};
use impact_atlas::store;
use impact_atlas::sweep::{Certification, certify, measure_extents, sweep};
use serde::Serialize;

use super::census::{self, Census};
use super::drawing::CurveSource;
use super::files::{self, Batch, Kind};
use super::map_args::MapArgs;
use super::options::BackendArgs;
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, Result, cell, control_map, curve_table, defaults, estimate, stored, wrong};

/// What is printed.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    cells: u64,
    impacts: u64,
    seconds: f64,
    impacts_per_second: f64,
    #[serde(serialize_with = "census::in_order")]
    regimes: Census,
    /// With --certify: how that went.
    certified: Option<Certified>,
    backend: &'a str,
    adapter: &'a str,
}

/// How certifying went.
#[derive(Debug, Serialize)]
struct Certified {
    #[serde(flatten)]
    cells: Certification,
    seconds: f64,
}

impl Certified {
    fn text(&self) -> String {
        let Certification { periodic, confirmed, relabelled, reexamined, unresolved } = self.cells;
        format!(
            "certified: of {periodic} periodic cells {confirmed} confirmed and {relabelled} relabelled by their exact orbit, \
             {reexamined} looked at for longer, {unresolved} unresolved, in {:.2} s",
            self.seconds
        )
    }
}

/// Certifies a map.
fn certified(map: &mut RegionMap, backend: &dyn Backend) -> Result<Certified> {
    let began = Instant::now();
    let cells = certify(map, backend, &Progress::of_cells("certifying", map.plane.cells()))?;
    Ok(Certified { cells, seconds: began.elapsed().as_secs_f64() })
}

/// Runs the command.
pub fn run(args: &MapArgs) -> Result<()> {
    if let Some(method) = args.control.cells.control {
        return control_map::run(method, args);
    }
    args.control.cells.refuse_settings(args.control.times.as_ref().map(|_| "times"))?;
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
    match args.data.as_deref().filter(|path| files::is_store(path)) {
        Some(path) => stored::run(args, &plane, path, &options, extras),
        None => in_memory(args, &plane, &options, extras),
    }
}

/// A plane whose cells are all held at once, and written into one file.
fn in_memory(args: &MapArgs, plane: &Plane, options: &BackendArgs, extras: Extras) -> Result<()> {
    if args.part.is_some() || args.tile.is_some() {
        return Err(wrong!(
            "--part and --tile are for stores: give --data DATA.zarr in place of an npz file"
        ));
    }
    if plane.cells() > Plane::LARGEST_AT_ONCE {
        return Err(wrong!(
            "a plane of {} cells is too large for one file: at most {} cells are accepted; give --data DATA.zarr",
            plane.cells(),
            Plane::LARGEST_AT_ONCE
        ));
    }
    let out = args.out.clone().unwrap_or_else(|| defaults::PICTURE.into());
    let npz = files::data_beside(&out, args.data.as_deref());
    let wanted = [
        Kind::Picture.at(Some(&out)),
        Kind::Plane.at(npz.as_deref()),
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
    let archived = || {
        let mut archive = Batch::default();
        archive.add(&data, |file| store::write_map(&map, file)).map(|()| archive)
    };
    // Curves take their time: what was computed is kept whatever becomes of them.
    let found = match args.curves.map(CurveSource::Computed) {
        None => None,
        Some(source) => {
            archived()?.show()?;
            Some(args.drawing.curves(&map, whole, source)?)
        }
    };
    let mut batch = Batch::default();
    let (drawn, archive) = rayon::join(
        || batch.picture(&picture, &args.drawing.draw_under(&map, whole, found.as_ref())?),
        || found.is_none().then(archived).transpose(),
    );
    drawn?;
    batch.append(archive?.unwrap_or_default());
    let curves = found.map(|found| found.curves).unwrap_or_default();
    curve_table::add(&mut batch, &table, &curves, plane)?;
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
        lines.extend(census::lines(self.regimes, self.cells));
        lines.extend(self.certified.as_ref().map(Certified::text));
        lines.join("\n")
    }
}
