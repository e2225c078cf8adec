//! `impact-atlas classify`: what one trajectory settles on.

use anyhow::anyhow;
use clap::Args;
use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Job, decide};
use impact_atlas::model::StateVector;
use impact_atlas::plane::{Plane, Start, Window};
use impact_atlas::sweep::certify_window;
use serde::Serialize;

use super::cell::Cell;
use super::interrupt::{Interruptible, abandonable};
use super::options::{BackendArgs, Trajectory, TrajectoryArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::count;
use super::{CliError, Result, defaults, multipliers};

/// Follows one trajectory and says what it settles on
///
/// Start and schedule are by default those of `map`. With --from and --at it answers for exactly one cell of a map that was
/// computed before: parameters, start, schedule and back end are the map's.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas classify --set omega=3.7 --set delta=0.1
  impact-atlas classify --set omega=2.83 --json
  impact-atlas classify --from map.png --at omega=2.83,delta=0.1
  impact-atlas classify --set omega=2.6 --set delta=0.6 --start rest --transient 8000")]
pub struct ClassifyArgs {
    #[command(flatten)]
    asked: TrajectoryArgs,

    /// Forcing periods before the observation
    ///
    /// Where the verdict is in doubt the trajectory goes on. Chaos may be transient: it runs up to 320 periods more. What is
    /// still undecided or neutral runs as long again and is observed four times as long: beside a Neimark-Sacker curve spirals
    /// are slow. What even that leaves undecided runs eight times as long. What returns without having settled is held against
    /// the exact motion beside it.
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRANSIENT, conflicts_with = "from")]
    transient: u32,

    /// Forcing periods of the observation
    ///
    /// Chaos that is plain after half of it, and no less than 64 periods, is not observed any longer, unless the periods are fixed;
    /// what is observed of it when it is looked at for longer counts, too.
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::OBSERVE, conflicts_with = "from")]
    observe: u32,

    /// Largest N looked for in N-p-q
    #[arg(long, value_parser = count, value_name = "N", default_value_t = defaults::MAX_PERIOD, conflicts_with = "from")]
    max_period: u32,

    /// Runs transient + observe periods, settled or not
    #[arg(long, conflicts_with = "from")]
    fixed_periods: bool,

    #[command(flatten)]
    backend: BackendArgs,

    /// Prints JSON; impacts_per_stop counts in the order of the system's stops, p and q in that of its labels; they are 65535 for infinitely many impacts (complete chatter), lyapunov null where it was not
    /// measured, or is minus infinity
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
    impacts_per_stop: Vec<u16>,
    state: StateVector,
    peak_impact_velocity: f32,
    periods: u32,
    start: String,
    start_state: StateVector,
    /// The start that was taken in place of the one asked for, where that does not exist.
    #[serde(skip)]
    taken: String,
    /// Whether symmetry means anything: only where the plant has a mirror.
    #[serde(skip)]
    has_mirror: bool,
    /// With --from: where the cell is on its map.
    #[serde(skip_serializing_if = "Option::is_none")]
    cell: Option<Cell>,
    backend: &'static str,
    adapter: String,
}

/// What is to be followed.
#[derive(Clone, Debug)]
struct Asked {
    job: Job,
    start: Start,
    schedule: Schedule,
    cell: Option<Cell>,
    /// Of a certified map: its plane, which certifies the cell.
    certified: Option<Plane>,
    backend: BackendArgs,
}

/// Runs the command.
pub fn run(args: &ClassifyArgs) -> Result<()> {
    let asked = args.asked()?;
    let progress = Progress::of_trajectory();
    let classification = abandonable(move || -> Result<_> {
        let backend = asked.backend.open()?;
        let jobs = [asked.job.clone()];
        let mut verdicts = decide(&*backend, &jobs, &asked.schedule, &Interruptible)?;
        if let (Some(plane), Some(Cell { column, row, .. })) = (&asked.certified, asked.cell) {
            let window = Window { column, row, columns: 1, rows: 1 };
            certify_window(plane, window, &mut verdicts, &*backend, &Interruptible)?;
        }
        let verdict = verdicts.first().ok_or_else(|| anyhow!("the back end gave no verdict"));
        Ok(Classification::new(verdict.map_err(CliError::Machine)?, &asked, &*backend))
    })??;
    drop(progress);
    if args.json { print_json(&classification) } else { print(&classification.text()) }
}

impl ClassifyArgs {
    /// The schedule and the back end of a cell are those of its map.
    fn asked(&self) -> Result<Asked> {
        let schedule = Schedule {
            transient: self.transient,
            observe: self.observe,
            max_period: self.max_period,
            fixed_periods: self.fixed_periods,
        };
        schedule.check().map_err(CliError::input)?;
        let Trajectory { system, start, state, of_map, .. } = self.asked.trajectory(defaults::START)?;
        let job = Job { system, start: state };
        Ok(match of_map {
            None => {
                Asked { job, start, schedule, cell: None, certified: None, backend: self.backend.clone() }
            }
            Some((made, cell)) => Asked {
                job,
                start,
                schedule: made.plane.task,
                cell: Some(cell),
                backend: self.backend.or_those_of(&made.provenance),
                certified: made.certified.then_some(made.plane),
            },
        })
    }
}

impl Classification {
    fn new(verdict: &Verdict, asked: &Asked, backend: &dyn Backend) -> Self {
        Classification {
            label: verdict.label(),
            regime: verdict.regime.name(),
            n: verdict.n,
            p: verdict.p(),
            q: verdict.q(),
            impacts_per_stop: verdict.counts.per_stop(asked.job.system.label_order()),
            symmetric: verdict.symmetric,
            lyapunov: verdict.lyapunov,
            state: verdict.state,
            peak_impact_velocity: verdict.peak_impact_velocity,
            periods: verdict.periods,
            start: asked.start.to_string(),
            start_state: asked.job.start,
            taken: asked.start.taken(&asked.job.system).to_string(),
            has_mirror: asked.job.system.mirror().is_some(),
            cell: asked.cell,
            backend: backend.name(),
            adapter: backend.adapter(),
        }
    }

    fn text(&self) -> String {
        let symmetric = match (self.n, self.symmetric) {
            (0, _) => "",
            _ if !self.has_mirror => "",
            (_, true) => ", symmetric",
            (_, false) => ", unsymmetric",
        };
        let sticking = if self.regime == Regime::PeriodicSticking.name() { ", with sticking" } else { "" };
        let exponent = match self.lyapunov {
            exponent if exponent.is_nan() => "not measured".to_owned(),
            f32::NEG_INFINITY => "minus infinity: every deviation is forgotten".to_owned(),
            exponent => format!("{exponent:.6} per forcing period"),
        };
        let given_up = match self.regime == Regime::Failed.name() {
            true if self.state.is_bounded() => ": given up, with too many impacts to go on",
            true => ": the motion grows without bounds",
            false => "",
        };
        format!(
            "{}{symmetric}{sticking}{given_up}\n\
             largest Lyapunov exponent   {exponent}\n\
             largest impact velocity     {}\n\
             state at forcing phase 0    {}\n\
             start                       {}: {}\n\
             forcing periods             {}",
            self.label,
            multipliers::velocity(self.peak_impact_velocity.into()),
            multipliers::state(&self.state),
            self.taken,
            multipliers::state(&self.start_state),
            self.periods
        )
    }
}
