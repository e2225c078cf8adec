//! `impact-atlas control`: one trajectory under control.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;
use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Job, follow};
use impact_atlas::control::{ControlSchedule, History, LONGEST, Method, Scheme, control};
use impact_atlas::figure::Size;
use impact_atlas::model::{Setting, StateVector, System};
use impact_atlas::plane::Start;
use impact_atlas::plane::written::WrittenSystem;
use impact_atlas::render::ControlPicture;
use impact_atlas::store;
use serde::Serialize;

use super::control_report::{Ran, Report};
use super::files::{self, Batch, Kind};
use super::method::{MethodArgs, method};
use super::options::{OverwriteArgs, SystemArgs, sets_control};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::{count, counted, parse, parse_range, parse_size};
use super::{CliError, Result, defaults, interrupt, note, wrong};

/// The most iterates of one run.
const MOST: u32 = 2_000_000;

/// Suppresses chaos by one of several methods, and says what is reached and at what cost
///
/// Computed in double precision on the CPU. Control acts at the returns to the impact Poincaré section of a stop (--stop):
/// just after an impact there; the paper's is that of stop A, x1 = +delta, with X = (v1+, x2, v2, tau). An iterate is one
/// return. A correction that would lead off the section (into its stop, or beyond another) is left out altogether and
/// counted as an escape. A corrected phase is a jump in time, so that N of a label is the flight time in forcing periods,
/// rounded.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas control delay --set omega=2.83 --gain 0.5 --out delay.png
  impact-atlas control delay --set omega=2.83 --gain 0.1 --json
  impact-atlas control pulse --set omega=2.83 --reference 3.7 --out pulse.png --data pulse.npz
  impact-atlas control sine --set omega=2.83 --alpha 0.1 --dead-band 0.0055 --iterates 12000 --out sine.png
  impact-atlas control sine --set omega=2.83 --convention force --alpha 0.05 --dead-band 0.0001 --iterates 8000 --json
  impact-atlas control ogy --set omega=2.6 --target=-0.418,-0.031,0.027,1.71 --window 0.05 --out kicks.png
  impact-atlas control delay --system bouncing-ball --set Gamma=1.6 --start 0,2 --gain 0.4 --out ball.png")]
#[command(mut_arg("assignments", sets_control))]
pub struct ControlArgs {
    /// The method
    #[arg(value_parser = method())]
    method: &'static Method,

    #[command(flatten)]
    system: SystemArgs,

    /// How the trajectory begins: rest, symmetric, or X1,X2,V1,V2 (x1 … xn, v1 … vn) at forcing phase 0
    #[arg(long, value_name = "START", value_parser = parse::<Start>, default_value_t = Start::Rest,
        allow_hyphen_values = true)]
    start: Start,

    /// The first iterate that is controlled
    #[arg(long, value_parser = count, value_name = "N", default_value_t = defaults::CONTROL_FROM)]
    from: u32,

    /// Iterates altogether
    #[arg(long, value_parser = count, value_name = "K", default_value_t = defaults::CONTROL_ITERATES)]
    iterates: u32,

    /// Most iterates looked for in one period of the motion; a longer period is none
    #[arg(long, value_name = "M", value_parser = counted(1, LONGEST as u32), default_value_t = ControlSchedule::MAX_PERIOD)]
    max_period: u32,

    /// How near the final points count as converged: τ within T, displacements and velocities within T of what is of order one
    #[arg(long, value_name = "T", default_value_t = 1e-6, allow_negative_numbers = true)]
    tolerance: f64,

    #[command(flatten)]
    settings: MethodArgs,

    /// Draws the time responses and the motion under control, a PNG, SVG or PDF file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    /// The iterates that the time responses show [default: all]
    #[arg(long, value_name = "FIRST:LAST", value_parser = parse_range, requires = "out")]
    range: Option<[u32; 2]>,

    /// The figure's size in pixels [default: as its plots need]
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = parse_size, requires = "out")]
    size: Option<Size>,

    /// Writes every return and the flight at the end, an npz file
    #[arg(long, value_name = "FILE.npz")]
    data: Option<PathBuf>,

    #[command(flatten)]
    overwrite: OverwriteArgs,

    /// Prints JSON: method, label_before, label_after, stop, section_names, fixed_point, converged_at, effort, period_two, escapes and more
    ///
    /// From converged_at on, the points stay within --tolerance of those at the end; that of `map --control` is where they began to
    /// return as closely as a period asks for, which is sooner.
    #[arg(long)]
    json: bool,
}

/// What it takes to make the results again.
#[derive(Debug, Serialize)]
struct Config<'a> {
    version: &'a str,
    system: WrittenSystem,
    parameters: &'a Setting,
    start: Start,
    control: &'a Scheme,
    schedule: ControlSchedule,
}

/// Runs the command.
pub fn run(args: &ControlArgs) -> Result<()> {
    let (system_args, set) = args.system.split()?;
    MethodArgs::note_shadowed(args.method, system_args.assignments()?.into_iter().map(|set| set.quantity));
    let scheme = args.settings.scheme(args.method, &set, &system_args.parameters(&[])?)?;
    let schedule = ControlSchedule {
        from: args.from,
        iterates: args.iterates,
        fixed: true,
        max_period: args.max_period,
    };
    check_lengths(args)?;
    schedule.check().map_err(CliError::input)?;
    let (system, start) = system_args.system_and_start(args.start)?;
    let family = args.system.family();
    if system.is_clamped() {
        return Err(CliError::Input(match family.is_paper() {
            true => anyhow!("with delta = 0 there are no impacts to control at: raise delta"),
            false => anyhow!(
                "two stops leave no room between them, so that there are no impacts to control at: part them"
            ),
        }));
    }
    let controller = scheme.resolve(&system).map_err(CliError::input)?;
    controller.flown(&system).map_err(CliError::input)?;
    let wanted = [Kind::Picture.at(args.out.as_deref()), Kind::Archive.at(args.data.as_deref())];
    let [out, data] = files::prepare(args.overwrite, wanted)?;
    note("computing on cpu: f64");
    let progress = Progress::of_trajectory();
    let followed = system.clone();
    let (history, outcome, before) = interrupt::abandonable(move || {
        let system = followed;
        let last = schedule.iterates.saturating_sub(defaults::CONTROL_PORTRAIT);
        let mut history = History::new(last, system.period() / f64::from(defaults::DRAWN_SAMPLES));
        let outcome = control::<f64, _>(&system, &start[..], &controller, &schedule, &mut history);
        (history, outcome, label_before(&system, start))
    })?;
    drop(progress);
    let outcome = outcome.map_err(CliError::input)?;
    if history.returns.len() <= args.from as usize {
        return Err(wrong!(
            "control from iterate {} was never switched on: the motion ({before}) reaches stop {} only {} times",
            args.from,
            family.stops()[scheme.stop().index()].name,
            history.returns.len()
        ));
    }
    let report = Report::of(Ran {
        method: args.method,
        from: args.from,
        tolerance: args.tolerance,
        system: &system,
        controller: &controller,
        history: &history,
        outcome: &outcome,
        before,
    })?;
    let config = Config {
        version: env!("CARGO_PKG_VERSION"),
        system: WrittenSystem::of(family),
        parameters: &system.setting().expect("a system that is asked for is made of a setting"),
        start: args.start,
        control: &scheme,
        schedule,
    };
    let config = serde_json::to_string(&config).map_err(CliError::machine)?;
    let picture = ControlPicture {
        system: &system,
        start: args.start,
        scheme: &scheme,
        schedule,
        history: &history,
        labels: [&report.label_before, &report.label_after],
    };
    let mut batch = Batch::default();
    batch.add(&data, |file| store::write_control(&history, &config, file))?;
    if out.is_some() {
        let figure = picture.figure(args.range);
        let size = args.size.unwrap_or_else(|| figure.natural_size(defaults::WIDE_FIGURE));
        batch.show_with(&out, figure.draw(size, &config))?;
    } else {
        batch.show()?;
    }
    if args.json { print_json(&report) } else { print(&report.text()) }
}

fn check_lengths(args: &ControlArgs) -> Result<()> {
    if args.iterates > MOST {
        return Err(wrong!(
            "{} iterates are too many for one recorded run: at most {MOST} are accepted",
            args.iterates
        ));
    }
    if !(args.tolerance > 0.0 && args.tolerance < 1.0) {
        return Err(wrong!("--tolerance {} is out of range: it must be between 0 and 1", args.tolerance));
    }
    match args.range {
        Some([_, last]) if last >= args.iterates => Err(wrong!(
            "--range ends at iterate {last}, but the run has only iterates 0 to {}",
            args.iterates - 1
        )),
        _ => Ok(()),
    }
}

/// What the trajectory is without control.
fn label_before(system: &System, start: StateVector) -> String {
    let schedule = Schedule {
        transient: defaults::TRAJECTORY_TRANSIENT,
        observe: defaults::TRAJECTORY_OBSERVE,
        max_period: defaults::MAX_PERIOD,
        fixed_periods: false,
    };
    let job = Job { system: system.clone(), start };
    follow::<f64>(&job, &schedule).label()
}
