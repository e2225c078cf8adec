//! `impact-atlas bifurcation`: a bifurcation diagram, computed, stored and drawn.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use impact_atlas::analysis::{Probe, Reading, Section};
use impact_atlas::backend::{self, Backend, Choice};
use impact_atlas::diagram::{Diagram, DiagramSpec, ExponentUnit, Sweep};
use impact_atlas::figure::{Figure, Size};
use impact_atlas::plane::{Axis, Start};
use impact_atlas::render::diagram_figure;
use impact_atlas::store::write_diagram;
use impact_atlas::sweep::diagram;

use super::bifurcation_summary::Summary;
use super::files::{self, Batch, Kind};
use super::options::{BackendArgs, OverwriteArgs, SystemArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::{count, parse, parse_size};
use super::{CliError, Result, defaults, note, wrong};

/// How many entries of a key stand side by side, about.
const KEY_IN_A_ROW: u32 = 5;

/// Computes a bifurcation diagram over any parameter or component of the start, as a picture and as data
///
/// Every column is one trajectory, observed after a transient that is never cut short. What it settles on stands along
/// the top; chatter and sticking are shaded. Columns that begin by themselves are computed in one batch; a state that
/// is carried along shows hysteresis, and is computed on the CPU.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas bifurcation --x omega=5:0.2:2000 --set delta=0.1 --out fig6a.png
  impact-atlas bifurcation --x omega=2.6:4:700 --set delta=0.6 --sweep both --start symmetric --out both.svg
  impact-atlas bifurcation --x omega=5:0.2:1000 --set delta=0.6 --sweep symmetric --spectrum=iterate --out fig6d.svg
  impact-atlas bifurcation --x delta=0.02:0.6:800 --set omega=2 --section strobe --record x2 --out d.png
  impact-atlas bifurcation --x v1=-1:1:500 --set omega=2.5 --set delta=0.6 --sweep rest --out v1.png --json
  impact-atlas bifurcation --system bouncing-ball --x Gamma=1:5:800 --set r=0.5 --section A --record tau --out ball.png")]
pub struct BifurcationArgs {
    /// The axis, ends included; FIRST may be greater than LAST
    ///
    /// NAME is any of the parameters (see --set) or a component of the start: x1 … xn, v1 … vn. With :log behind COUNT, as
    /// in delta=0.01:1:400:log, values have equal ratios.
    #[arg(long, value_name = "NAME=FIRST:LAST:COUNT[:log]")]
    x: String,

    #[command(flatten)]
    system: SystemArgs,

    /// How columns begin: rest, symmetric, a state X1,X2,V1,V2 (x1 … xn, v1 … vn), or down, up, both
    ///
    /// `rest`, `symmetric` (the stable-branch 1-1-1 motion, nudged; rest where there is none) and a state at forcing
    /// phase 0 start every column by itself. `down` and `up` carry the state along with falling and with rising values;
    /// `both` does either, and says where the two differ.
    #[arg(long, value_name = "SWEEP", value_parser = parse::<Sweep>, default_value = "rest",
        allow_hyphen_values = true)]
    sweep: Sweep,

    /// How the first column of a carried sweep begins [default: rest]
    #[arg(long, value_name = "START", value_parser = parse::<Start>, allow_hyphen_values = true)]
    start: Option<Start>,

    /// Where the motion is read: the name of a stop (just after impacts there) or strobe (forcing phase 0)
    /// [default: the system's first stop]
    ///
    /// The paper's stops are A, x1 = +delta, and B, x1 = -delta.
    #[arg(long, value_name = "SECTION")]
    section: Option<String>,

    /// What is read: v_before, v_after, x1 … xn, v1 … vn, tau, or of a stop A gap.A and speed.A [default: v_before, on the
    /// strobe section the displacement of the first coordinate that meets no stop; the paper's x2]
    ///
    /// v_before and v_after are velocities along the stop's direction (of the first stop on the same line, where there are
    /// two). gap.A is the distance left to stop A, speed.A the velocity towards it.
    #[arg(long, value_name = "NAME")]
    record: Option<String>,

    /// Forcing periods before a column is observed
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRAJECTORY_TRANSIENT)]
    transient: u32,

    /// Forcing periods for which a column is observed
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::DIAGRAM_OBSERVE)]
    observe: u32,

    /// Largest N looked for in N-p-q
    #[arg(long, value_parser = count, value_name = "N", default_value_t = defaults::MAX_PERIOD)]
    max_period: u32,

    /// Points kept of each column at most, the first ones [default: 16 for every period observed]
    #[arg(long, value_parser = count, value_name = "K")]
    points: Option<u32>,

    /// Computes all 2n Lyapunov exponents of every column, on the CPU, and draws them below, per forcing period, per
    /// iterate of the impact map (returns to the stop of --section, to the first on the strobe section; at A the paper's unit) or per unit of time
    #[arg(long, value_enum, value_name = "UNIT", num_args = 0..=1, default_missing_value = "period",
        require_equals = true)]
    spectrum: Option<ExponentUnit>,

    #[command(flatten)]
    backend: BackendArgs,

    /// The picture, a PNG, SVG or PDF file
    #[arg(long, value_name = "FILE", default_value = defaults::DIAGRAM)]
    out: PathBuf,

    /// The data, an npz file [default: beside the picture, with its name]
    #[arg(long, value_name = "FILE.npz")]
    data: Option<PathBuf>,

    /// The picture's size in pixels [default: as the diagram needs]
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = parse_size)]
    size: Option<Size>,

    #[command(flatten)]
    overwrite: OverwriteArgs,

    /// Prints JSON: columns, branches, points, left_out, failed, seconds, coexistence, backend, adapter
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &BifurcationArgs) -> Result<()> {
    let spec = args.spec()?;
    let npz = files::data_beside(&args.out, args.data.as_deref());
    let wanted = [Kind::Picture.at(Some(&args.out)), Kind::Archive.at(npz.as_deref())];
    let [picture, data] = files::prepare(args.overwrite, wanted)?;
    if let Some(size) = args.size {
        // A picture without room is refused before anything is computed, as far as that can be known.
        diagram_figure(&Diagram::blank(&spec)).draw(size, "{}").map_err(CliError::input)?;
    }
    let backend = args.open()?;
    let began = Instant::now();
    let branches = spec.sweep.branches().len() as u64;
    let work = u64::from(spec.x.count) * branches * (1 + u64::from(spec.spectrum.is_some()));
    let diagram = diagram(&spec, &*backend, &Progress::of_cells("computing", work))?;
    let summary = Summary::new(&diagram, began.elapsed().as_secs_f64());
    let figure = diagram_figure(&diagram);
    let size = args.size.unwrap_or_else(|| diagram_size(&diagram, &figure));
    let mut batch = Batch::default();
    batch.add(&data, |file| write_diagram(&diagram, file))?;
    batch.show_with(&picture, figure.draw(size, &diagram.config()))?;
    if args.json { print_json(&summary) } else { print(&summary.text(&diagram)) }
}

/// A diagram is wider than a phase portrait, and as high as its plots, strips and key need.
fn diagram_size(diagram: &Diagram, figure: &Figure) -> Size {
    let below = 480 * (figure.rows.len() as u32 - 1);
    let strips = 90 * (diagram.branches.len() as u32 - 1);
    let key = 52 * (figure.key.len() as u32).div_ceil(KEY_IN_A_ROW);
    let size = Size::new(defaults::WIDE_FIGURE, 1030 + below + strips + key);
    figure.at_least(size.expect("the sizes of diagrams are sizes"))
}

impl BifurcationArgs {
    /// The checked specification.
    fn spec(&self) -> Result<DiagramSpec> {
        if let (Some(start), false) = (self.start, self.sweep.is_carried()) {
            return Err(wrong!(
                "--start {start} has no effect, since --sweep {} starts every column by itself: drop it, or give the \
                 start to --sweep",
                self.sweep
            ));
        }
        let section = match &self.section {
            Some(name) => self.system.named("--section <SECTION>", name, Section::named)?,
            None => Section::A,
        };
        let reading = match &self.record {
            Some(name) => self.system.named("--record <NAME>", name, Reading::named)?,
            None => Reading::usual(section, self.system.family()),
        };
        let probe = Probe::new(section, reading).map_err(CliError::input)?;
        let x = self.system.named("--x <NAME=FIRST:LAST:COUNT>", &self.x, Axis::of_family)?;
        let spec = DiagramSpec {
            x,
            parameters: self.system.parameters(&[("--x", x)])?,
            sweep: self.sweep,
            start: self.start.unwrap_or(Start::Rest),
            probe,
            schedule: DiagramSpec::schedule(self.transient, self.observe, self.max_period),
            capacity: self.points.unwrap_or_else(|| self.observe.saturating_mul(defaults::POINTS_PER_PERIOD)),
            spectrum: self.spectrum,
        };
        spec.check().map_err(CliError::input)?;
        Ok(spec)
    }

    /// The back end; a carried sweep is computed on the CPU.
    fn open(&self) -> Result<Box<dyn Backend>> {
        if !self.sweep.is_carried() {
            return self.backend.open();
        }
        let asked = match (&self.backend.adapter, self.backend.backend) {
            (Some(adapter), _) => Some(format!("--adapter {adapter}")),
            (None, Choice::Gpu) => Some("--backend gpu".to_owned()),
            (None, Choice::Auto | Choice::Cpu) => None,
        };
        if let Some(asked) = asked {
            return Err(wrong!(
                "--sweep {} is a sequence and computed on the CPU: drop {asked}, or choose --sweep rest or symmetric",
                self.sweep
            ));
        }
        let cpu = backend::open(Choice::Cpu, None)?;
        note(&format!("computing on {}: {}; a carried sweep is a sequence", cpu.name(), cpu.adapter()));
        Ok(cpu)
    }
}
