//! `impact-atlas orbit`: the impacts and the trajectory of one orbit.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::{Args, value_parser};
use impact_atlas::analysis::Schedule;
use impact_atlas::dynamics::{self, Recording, Stop};
use impact_atlas::plane::Start;

use super::options::SystemArgs;
use super::progress::Progress;
use super::terminal::print;
use super::values::parse;
use super::{CliError, defaults, files, interrupt};

/// The most points of a trajectory.
const LARGEST: u64 = 20_000_000;

const IMPACT_COLUMNS: [&str; 7] = ["time", "stop", "velocity_before", "velocity_after", "x2", "v2", "phase"];

const TRAJECTORY_COLUMNS: [&str; 5] = ["time", "x1", "x2", "v1", "v2"];

/// Records one orbit: its impacts and its trajectory as CSV
///
/// Computed in double precision on the CPU. Times are non-dimensional and count from the start of the trajectory,
/// transient included; the phase is that of the forcing, from 0 to 2π. Stop A is x1 = +delta, stop B is x1 = -delta.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas orbit --set omega=3.7 --impacts impacts.csv
  impact-atlas orbit --set omega=0.5 --set r=0.6 --periods 3 --samples 2000 --trajectory trajectory.csv")]
pub struct OrbitArgs {
    #[command(flatten)]
    system: SystemArgs,

    /// How the trajectory begins: rest, symmetric, or X1,X2,V1,V2 at forcing phase 0
    #[arg(long, value_name = "START", value_parser = parse::<Start>, default_value_t = Start::Rest,
        allow_hyphen_values = true)]
    start: Start,

    /// Forcing periods before the recording
    #[arg(long, value_name = "P", default_value_t = defaults::TRAJECTORY_TRANSIENT,
        value_parser = value_parser!(u32).range(0..=i64::from(Schedule::LONGEST)))]
    transient: u32,

    /// Forcing periods of the recording
    #[arg(long, value_name = "P", default_value_t = defaults::ORBIT_PERIODS,
        value_parser = value_parser!(u32).range(1..=i64::from(Schedule::LONGEST)))]
    periods: u32,

    /// Points of the trajectory in each forcing period
    #[arg(long, value_name = "S", default_value_t = defaults::ORBIT_SAMPLES,
        value_parser = value_parser!(u32).range(1..=1_000_000))]
    samples: u32,

    /// Writes every impact: time, stop, velocity_before, velocity_after, x2, v2, phase
    #[arg(long, value_name = "FILE.csv")]
    impacts: Option<PathBuf>,

    /// Writes the trajectory: time, x1, x2, v1, v2
    #[arg(long, value_name = "FILE.csv")]
    trajectory: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &OrbitArgs) -> Result<(), CliError> {
    let (system, start) = args.system.system_and_start(args.start)?;
    let (transient, periods) = (args.transient, args.periods);
    let samples = if args.trajectory.is_some() { args.samples } else { 0 };
    if u64::from(periods) * u64::from(samples) > LARGEST {
        return Err(CliError::Input(anyhow!(
            "{periods} periods with {samples} points each are too many: at most {LARGEST} points are accepted"
        )));
    }
    let impacts = args.impacts.as_deref();
    let trajectory = args.trajectory.as_deref();
    let [impacts, trajectory] = files::prepare([impacts, trajectory])?;
    let progress = Progress::of_trajectory();
    let recording =
        interrupt::abandonable(move || dynamics::record(&system, start, transient, periods, samples))?;
    drop(progress);
    if let Some(output) = impacts {
        let rows = recording.impacts.iter().map(|impact| {
            (
                impact.time,
                impact.stop.to_string(),
                impact.velocity_before,
                impact.velocity_after,
                impact.x2,
                impact.v2,
                impact.phase,
            )
        });
        files::write_csv(&output, IMPACT_COLUMNS, rows)?;
    }
    if let Some(output) = trajectory {
        let rows = recording.samples.iter().map(|s| (s.time, s.x1, s.x2, s.v1, s.v2));
        files::write_csv(&output, TRAJECTORY_COLUMNS, rows)?;
    }
    print(&summary(&recording, periods))
}

fn summary(recording: &Recording, periods: u32) -> String {
    let impacts = &recording.impacts;
    let at_a = impacts.iter().filter(|impact| impact.stop == Stop::A).count();
    let fastest = impacts.iter().map(|impact| impact.velocity_before.abs()).fold(0.0, f64::max);
    format!(
        "{} impacts in {periods} forcing periods: {at_a} at stop A (x1 = +delta), {} at stop B (x1 = -delta)\n\
         largest impact velocity {fastest:.6}",
        impacts.len(),
        impacts.len() - at_a
    )
}
