//! `impact-atlas classify`: what one trajectory settles on.

use anyhow::anyhow;
use clap::Args;
use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, Job, decide};
use impact_atlas::plane::Start;
use serde::Serialize;

use super::interrupt::{Interruptible, abandonable};
use super::options::{BackendArgs, SystemArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::{count, parse};
use super::{CliError, defaults};

/// Follows one trajectory and says what it settles on
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas classify --set omega=3.7 --set delta=0.1
  impact-atlas classify --set omega=2.83 --json
  impact-atlas classify --set omega=2.6 --set delta=0.6 --start symmetric --transient 8000")]
pub struct ClassifyArgs {
    #[command(flatten)]
    system: SystemArgs,

    /// How the trajectory begins: rest, symmetric, or X1,X2,V1,V2 at forcing phase 0
    #[arg(long, value_name = "START", value_parser = parse::<Start>, default_value_t = Start::Rest,
        allow_hyphen_values = true)]
    start: Start,

    /// Forcing periods before the observation
    ///
    /// A trajectory that is still undecided after the observation, or neutral, goes on for eight times as long and is
    /// observed again: beside a Neimark-Sacker curve spirals are slow.
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRAJECTORY_TRANSIENT)]
    transient: u32,

    /// Forcing periods of the observation
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRAJECTORY_OBSERVE)]
    observe: u32,

    /// Largest N looked for in N-p-q
    #[arg(long, value_parser = count, value_name = "N", default_value_t = defaults::MAX_PERIOD)]
    max_period: u32,

    /// Runs transient + observe periods, settled or not
    #[arg(long)]
    fixed_periods: bool,

    #[command(flatten)]
    backend: BackendArgs,

    /// Prints JSON; p and q are 65535 for infinitely many impacts (complete chatter)
    #[arg(long)]
    json: bool,
}

/// What is printed; every quantity non-dimensional.
#[derive(Debug, Serialize)]
struct Classification {
    label: String,
    regime: &'static str,
    n: u16,
    p: u16,
    q: u16,
    symmetric: bool,
    lyapunov: f32,
    state: [f64; 4],
    peak_impact_velocity: f32,
    periods: u32,
    backend: &'static str,
    adapter: String,
}

/// Runs the command.
pub fn run(args: &ClassifyArgs) -> Result<(), CliError> {
    let schedule = Schedule {
        transient: args.transient,
        observe: args.observe,
        max_period: args.max_period,
        fixed_periods: args.fixed_periods,
    };
    schedule.check().map_err(CliError::input)?;
    let (system, start) = args.system.system_and_start(args.start)?;
    let options = args.backend.clone();
    let progress = Progress::of_trajectory();
    let classification = abandonable(move || -> Result<_, CliError> {
        let backend = options.open()?;
        let verdicts = decide(&*backend, &[Job { system, start }], &schedule, &Interruptible)?;
        let verdict = verdicts.first().ok_or_else(|| anyhow!("the back end gave no verdict"));
        Ok(Classification::new(verdict.map_err(CliError::Machine)?, &*backend))
    })??;
    drop(progress);
    if args.json { print_json(&classification) } else { print(&classification.text()) }
}

impl Classification {
    fn new(verdict: &Verdict, backend: &dyn Backend) -> Self {
        Classification {
            label: verdict.label(),
            regime: verdict.regime.name(),
            n: verdict.n,
            p: verdict.p,
            q: verdict.q,
            symmetric: verdict.symmetric,
            lyapunov: verdict.lyapunov,
            state: verdict.state,
            peak_impact_velocity: verdict.peak_impact_velocity,
            periods: verdict.periods,
            backend: backend.name(),
            adapter: backend.adapter(),
        }
    }

    fn text(&self) -> String {
        let symmetric = match (self.n, self.symmetric) {
            (0, _) => "",
            (_, true) => ", symmetric",
            (_, false) => ", unsymmetric",
        };
        let [x1, x2, v1, v2] = self.state;
        format!(
            "{}{symmetric}\n\
             largest Lyapunov exponent   {:.6} per forcing period\n\
             largest impact velocity     {:.6}\n\
             state at forcing phase 0    x1 {x1:.9}, x2 {x2:.9}, v1 {v1:.9}, v2 {v2:.9}\n\
             forcing periods             {}",
            self.label, self.lyapunov, self.peak_impact_velocity, self.periods
        )
    }
}
