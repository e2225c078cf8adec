//! `impact-atlas orbit`: the impacts and the trajectory of one orbit.

use std::path::PathBuf;

use clap::Args;
use impact_atlas::analysis::Schedule;
use impact_atlas::dynamics::{self, Recording};
use impact_atlas::figure::{Picture, Size, TooSmall};
use impact_atlas::model::{Number, Setting};
use impact_atlas::plane::Start;
use impact_atlas::plane::written::WrittenSystem;
use impact_atlas::render::{Orbit, orbit_figure};
use impact_atlas::system::Family;
use serde::Serialize;

use super::files::{self, Batch, Kind};
use super::options::{OverwriteArgs, SystemArgs, Trajectory, TrajectoryArgs};
use super::orbit_shown::Shown;
use super::orbit_table::Columns;
use super::progress::Progress;
use super::terminal::print;
use super::values::{counted, parse_size};
use super::{CliError, Result, defaults, interrupt, multipliers, wrong};

/// The most points of a trajectory.
const LARGEST: u64 = 20_000_000;

/// The most forcing periods that sections show.
const MOST_SECTION_PERIODS: u32 = 1_000_000;

/// Records one orbit: as a figure, and its impacts and its trajectory as CSV
///
/// Computed in double precision on the CPU. Times are non-dimensional and count from the start of the trajectory,
/// transient included; the phase is that of the forcing, from 0 to 2π. The stops have the names of the system: the paper's
/// are A, x1 = +delta, and B, x1 = -delta. Masses that no spring and no stop ties to the ground drift as they
/// do; all other commands follow them in a frame that moves with them as a whole, or goes after them where dampers
/// resist.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas orbit --set omega=3.7 --impacts impacts.csv
  impact-atlas orbit --set omega=0.5 --set r=0.6 --periods 3 --samples 2000 --trajectory trajectory.csv
  impact-atlas orbit --set omega=3.7 --periods 3 --out orbit.png
  impact-atlas orbit --from map.png --at omega=1.65,delta=0.1 --out cell.png
  impact-atlas orbit --set omega=3.03 --panel section:x2,v2 --panel strobe --section-periods 5000 --out o.svg
  impact-atlas orbit --set omega=0.25 --set delta=0.545 --periods 2 --panel time --zoom t=0.1:0.4 --out z.png
  impact-atlas orbit --system impact-damper --periods 4 --panel time:gap.A --panel portrait:x1,v1 --out damper.svg")]
pub struct OrbitArgs {
    #[command(flatten)]
    asked: TrajectoryArgs,

    /// Forcing periods before the recording
    #[arg(long, value_name = "P", default_value_t = defaults::TRAJECTORY_TRANSIENT,
        value_parser = counted(0, Schedule::LONGEST))]
    transient: u32,

    /// Forcing periods of the recording
    #[arg(long, value_name = "P", default_value_t = defaults::ORBIT_PERIODS,
        value_parser = counted(1, Schedule::LONGEST))]
    periods: u32,

    /// Points of the trajectory in each forcing period [default: 200, with --out 400]
    #[arg(long, value_name = "S", value_parser = counted(1, 1_000_000))]
    samples: Option<u32>,

    /// Writes the impacts: time, stop, velocity_before, velocity_after, x2, v2, phase
    ///
    /// Velocities are along the direction of the first stop on the same line: positive where that is approached, negative where
    /// one that faces it is. Of complete chatter only the rebounds that are followed one by one are there; the rest ends at rest
    /// on the stop. Of other systems every component of the state that does not follow from the stop stands in place of x2 and v2.
    #[arg(long, value_name = "FILE.csv")]
    impacts: Option<PathBuf>,

    /// Writes the trajectory: time, x1 … xn, v1 … vn
    ///
    /// Where the rest of a complete chatter is not followed, masses stand at rest on the stop from the last rebound on that is.
    #[arg(long, value_name = "FILE.csv")]
    trajectory: Option<PathBuf>,

    /// Draws a figure, a PNG, SVG or PDF file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    /// A plot of the figure; may be repeated [default: portrait, time]
    ///
    /// portrait: displacement and velocity of the coordinate that meets the first stop, with the stops; portrait2: x2 and v2.
    /// time: the displacement over the time in forcing periods, impacts marked and sticking shaded. section, section-b: just
    /// after every impact at the first stop, at the stop named b or B. strobe: at forcing phase 0. Other quantities follow a
    /// colon: portrait:x1,x2, time:v1, section:x2,v2, strobe:x1,v1, and of a stop A gap.A, the distance left to it, and
    /// speed.A, the velocity towards it: portrait:gap.A,speed.A. Sections have v_before, v_after and tau, the forcing phase at
    /// the impact, too.
    #[arg(long = "panel", value_name = "NAME[:X,Y]", requires = "out")]
    panels: Vec<String>,

    /// The range that axes over a quantity show; may be repeated
    ///
    /// NAME is a quantity of the panels, or t, the time since the recording began in forcing periods.
    #[arg(long = "zoom", value_name = "NAME=LOW:HIGH", requires = "out", allow_hyphen_values = true)]
    zooms: Vec<String>,

    /// Forcing periods that sections show [default: 2000]
    #[arg(long, value_name = "P", value_parser = counted(1, MOST_SECTION_PERIODS))]
    section_periods: Option<u32>,

    /// The figure's size in pixels [default: as its plots need]
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = parse_size, requires = "out")]
    size: Option<Size>,

    #[command(flatten)]
    overwrite: OverwriteArgs,
}

/// What it takes to make the figure again.
#[derive(Debug, Serialize)]
struct Config<'a> {
    version: &'a str,
    command: &'a str,
    system: WrittenSystem,
    parameters: &'a Setting,
    start: Start,
    transient: u32,
    periods: u32,
    samples: u32,
    section_periods: u32,
    panels: Vec<String>,
    zooms: Vec<String>,
}

/// Runs the command.
pub fn run(args: &OrbitArgs) -> Result<()> {
    let Trajectory { options, system, start, state, .. } = args.asked.trajectory(Start::Rest)?;
    let shown = args.shown(&options)?;
    let (transient, periods) = (args.transient, args.periods);
    let samples = args.samples();
    if let (0, Some(samples)) = (samples, args.samples) {
        return Err(wrong!("--samples {samples} has no effect without --out or --trajectory: drop it"));
    }
    if u64::from(periods) * u64::from(samples) > LARGEST {
        return Err(wrong!(
            "{periods} periods with {samples} points each are too many: at most {LARGEST} points are accepted"
        ));
    }
    let wanted = [
        Kind::Picture.at(args.out.as_deref()),
        Kind::Table.at(args.impacts.as_deref()),
        Kind::Table.at(args.trajectory.as_deref()),
    ];
    let [out, impacts, trajectory] = files::prepare(args.overwrite, wanted)?;
    let section_periods = shown.section_periods;
    let progress = Progress::of_trajectory();
    let followed = system.adrift().map_err(CliError::input)?;
    let (recording, sections) = interrupt::abandonable(move || {
        let system = followed;
        let recording = dynamics::record(&system, state, transient, periods, samples);
        let sections = match section_periods {
            0 => Recording::default(),
            periods => dynamics::record(&system, state, transient, periods, 1),
        };
        (recording, sections)
    })?;
    drop(progress);
    if let Some(why) = recording.given_up.or(sections.given_up) {
        return Err(CliError::machine(why));
    }
    let mut batch = Batch::default();
    let family = options.family();
    let columns = Columns::of(family);
    batch.table(
        &impacts,
        &columns.of_impacts(),
        recording.impacts.iter().map(|i| columns.row(i, &system)),
    )?;
    let rows = recording.samples.iter().map(|sample| (sample.time, &sample.state));
    batch.table(&trajectory, &columns.of_trajectory(), rows)?;
    if out.is_some() {
        let orbit = Orbit { system: &system, recording: &recording, sections: &sections };
        batch.show_with(&out, args.picture(&orbit, start, &shown)?)?;
    } else {
        batch.show()?;
    }
    print(&summary(&recording, periods, family))
}

impl OrbitArgs {
    fn samples(&self) -> u32 {
        let default = match (&self.out, &self.trajectory) {
            (Some(_), _) => defaults::DRAWN_SAMPLES,
            (None, Some(_)) => defaults::ORBIT_SAMPLES,
            (None, None) => return 0,
        };
        self.samples.unwrap_or(default)
    }

    fn shown(&self, options: &SystemArgs) -> Result<Shown> {
        let panels = self.out.as_ref().map(|_| &self.panels[..]);
        Shown::of(options, panels, &self.zooms, self.section_periods)
    }

    fn picture(&self, orbit: &Orbit<'_>, start: Start, shown: &Shown) -> Result<Result<Picture, TooSmall>> {
        let Shown { panels, zooms, section_periods } = shown;
        let parameters = &orbit.system.setting().expect("a system that is asked for is made of a setting");
        let family = parameters.family();
        let figure = orbit_figure(orbit, start, panels, zooms);
        let width = if panels.len() == 1 { defaults::NARROW_FIGURE } else { defaults::WIDE_FIGURE };
        let size = self.size.unwrap_or_else(|| figure.natural_size(width));
        let panels: Vec<String> = panels.iter().map(|panel| panel.name(family)).collect();
        let zooms: Vec<String> = zooms.iter().map(|zoom| zoom.name(family)).collect();
        let config = Config {
            version: env!("CARGO_PKG_VERSION"),
            command: &self.command(parameters, start, &panels, &zooms, *section_periods),
            system: WrittenSystem::of(family),
            parameters,
            start,
            transient: self.transient,
            periods: self.periods,
            samples: self.samples(),
            section_periods: *section_periods,
            panels,
            zooms,
        };
        let config = serde_json::to_string(&config).map_err(CliError::machine)?;
        Ok(figure.draw(size, &config))
    }

    /// The command that makes the figure again.
    fn command(
        &self,
        parameters: &Setting,
        start: Start,
        panels: &[String],
        zooms: &[String],
        section_periods: u32,
    ) -> String {
        let mut command = String::from("impact-atlas orbit");
        let family = parameters.family();
        if !family.is_paper() {
            command.push_str(&format!(" --system {}", family.origin));
        }
        for (parameter, value) in parameters.entries() {
            command.push_str(&format!(" --set {parameter}={}", Number(value)));
        }
        command.push_str(&format!(
            " --start {start} --transient {} --periods {} --samples {}",
            self.transient,
            self.periods,
            self.samples()
        ));
        if section_periods > 0 {
            command.push_str(&format!(" --section-periods {section_periods}"));
        }
        panels.iter().for_each(|panel| command.push_str(&format!(" --panel {panel}")));
        zooms.iter().for_each(|zoom| command.push_str(&format!(" --zoom {zoom}")));
        command
    }
}

fn summary(recording: &Recording, periods: u32, family: &Family) -> String {
    let impacts = &recording.impacts;
    let fastest = impacts.iter().map(|impact| impact.velocity_before.abs()).fold(0.0, f64::max);
    let stops = family.stops().iter().enumerate().map(|(i, stop)| {
        let count = impacts.iter().filter(|impact| impact.stop.index() == i).count();
        format!("{count} at stop {} ({})", stop.plain_name(), family.stop_place(i))
    });
    format!(
        "{} impacts in {periods} forcing periods: {}\nlargest impact velocity {}",
        impacts.len(),
        stops.collect::<Vec<_>>().join(", "),
        multipliers::velocity(fastest)
    )
}
