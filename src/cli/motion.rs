//! `impact-atlas motion`: a periodic motion, solved exactly.

use anyhow::anyhow;
use clap::Args;
use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Cpu, Job, decide};
use impact_atlas::model::{StateVector, System};
use impact_atlas::plane::Start;
use impact_atlas::theory::{
    Label, PeriodicMotion, Search, SettledMotion, StrobeMotion, labelled_motion, section_names,
};
use serde::Serialize;

use super::interrupt::{Interruptible, abandonable};
use super::multipliers::{self, note_cpu, pairs};
use super::options::{Trajectory, TrajectoryArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::count;
use super::{CliError, Result, defaults};

/// Solves for a periodic motion, stable or not, with its Floquet multipliers
///
/// Without --label, the trajectory is followed until it is periodic, and its motion is refined by Newton's method.
/// With --label, a motion of that label is searched for: the one that --start lies on, then among the close returns of the
/// trajectory and of others from scattered starts, then at neighbouring parameters (those of the system's default plane;
/// the paper's are omega and delta), from where it is followed to
/// the parameters given; it need not be stable. A motion with sticking is solved as a
/// fixed point of the strobe map (the state at forcing phase 0 to that N periods later): the directions that sticking
/// forgets have multiplier 0.
///
/// The section is (v1+, x2, v2, tau) just after an impact at the paper's stop A, x1 = +delta (the hardest one where the
/// motion sticks), or at stop B where A is never struck; tau is the forcing phase. Of other systems it is the velocity along
/// the stop's own coordinate at the first stop that is struck, the other displacements, the other velocities and tau (see
/// section_names). Computed in double precision on the CPU.
/// Exit code 1 if the trajectory leads to no periodic motion, or no motion of the label is found.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas motion --set omega=1.65
  impact-atlas motion --set omega=2.83 --label 1-2-1 --json
  impact-atlas motion --set omega=0.25 --set delta=0.545
  impact-atlas motion --from map.png --at omega=1.65,delta=0.1
  impact-atlas motion --system bouncing-ball --set Gamma=1.6 --label 1-1")]
pub struct MotionArgs {
    #[command(flatten)]
    asked: TrajectoryArgs,

    /// Searches for a motion of this label: N forcing periods, then the impacts at each stop in the order of the system's
    /// labels; the paper's are p impacts at x1 = -delta and q impacts at x1 = +delta
    #[arg(long, value_name = "N-p-q", allow_hyphen_values = true)]
    label: Option<String>,

    /// Forcing periods before the observation, or the search
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRAJECTORY_TRANSIENT)]
    transient: u32,

    /// Forcing periods of the observation, or the search
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRAJECTORY_OBSERVE)]
    observe: u32,

    /// Largest N looked for in N-p-q
    #[arg(long, value_parser = count, value_name = "N", default_value_t = defaults::MAX_PERIOD, conflicts_with = "label")]
    max_period: u32,

    /// Prints JSON; impacts_per_stop counts in the order of the system's stops, p and q are the first two counts of the
    /// label; all are 65535 for infinitely many impacts (complete chatter), multipliers null where an impact grazes
    #[arg(long)]
    json: bool,
}

/// What is printed; every quantity non-dimensional.
#[derive(Debug, Serialize)]
struct Motion {
    label: String,
    n: u32,
    p: u32,
    q: u32,
    impacts_per_stop: Vec<u32>,
    symmetric: bool,
    /// Whether symmetry means anything: only where the system has a mirror.
    #[serde(skip)]
    has_mirror: bool,
    stable: Option<bool>,
    sticking: bool,
    section: Option<Vec<f64>>,
    #[serde(skip)]
    section_text: Option<String>,
    section_stop: Option<&'static str>,
    section_names: Option<Vec<String>>,
    /// The stop at which the section would be if it were struck.
    #[serde(skip)]
    first_stop: &'static str,
    multipliers: Option<Vec<[f64; 2]>>,
    half_multipliers: Option<Vec<[f64; 2]>>,
    state: Vec<f64>,
    residual: f64,
    method: &'static str,
}

/// Runs the command.
pub fn run(args: &MotionArgs) -> Result<()> {
    let schedule = Schedule {
        transient: args.transient,
        observe: args.observe,
        max_period: args.max_period,
        fixed_periods: false,
    };
    schedule.check().map_err(CliError::input)?;
    let Trajectory { options, system, state, of_map, .. } = args.asked.trajectory(Start::Rest)?;
    // Periods as long as the map itself looked for.
    let of_map = of_map.map_or(0, |(made, _)| made.plane.task.max_period);
    let schedule = Schedule { max_period: schedule.max_period.max(of_map), ..schedule };
    let label = args.label.as_ref().map(|text| options.named("--label <N-p-q>", text, Label::of_family));
    let label = label.transpose()?;
    note_cpu();
    let progress = Progress::of_trajectory();
    let motion = abandonable(move || match label {
        Some(label) => named(&system, state, &schedule, label),
        None => reached(&system, state, &schedule),
    })??;
    drop(progress);
    if args.json { print_json(&motion) } else { print(&motion.text()) }
}

/// The motion of a label.
fn named(system: &System, start: StateVector, schedule: &Schedule, label: Label) -> Result<Motion> {
    if system.is_clamped() && system.normals() == 1 {
        let closed = system.closed();
        return Err(CliError::NotFound(format!("there is no {label} motion: {closed}; open the gap")));
    }
    let search = Search { start: start.to_vec(), transient: schedule.transient, observe: schedule.observe };
    let motion =
        labelled_motion(system, label, &search).map_err(|error| CliError::NotFound(error.to_string()))?;
    Ok(Motion::of_impacts(system, &motion))
}

/// The motion that a start leads to.
fn reached(system: &System, start: StateVector, schedule: &Schedule) -> Result<Motion> {
    let verdicts = decide(&Cpu, &[Job { system: system.clone(), start }], schedule, &Interruptible)?;
    let verdict =
        verdicts.first().ok_or_else(|| CliError::Machine(anyhow!("the back end gave no verdict")))?;
    if let Some(elsewhere) = elsewhere(verdict) {
        return Err(CliError::NotFound(elsewhere));
    }
    let settled = SettledMotion::of(system, verdict).map_err(|error| {
        CliError::NotFound(format!(
            "the trajectory settles on a {} motion, but {error}: raise --transient, so that it comes closer",
            verdict.label()
        ))
    })?;
    Ok(match settled {
        SettledMotion::Impacts(motion) => Motion::of_impacts(system, &motion),
        SettledMotion::Strobe(motion) => Motion::of_strobe(system, &motion),
    })
}

/// What a trajectory leads to instead of a periodic motion, and what can be done about it.
fn elsewhere(verdict: &Verdict) -> Option<String> {
    let exponent = verdict.lyapunov;
    let other = "ask for a motion by its --label, stable or not, or try another --start";
    Some(match verdict.regime {
        Regime::Periodic | Regime::PeriodicSticking => return None,
        Regime::Chaotic => format!(
            "this start leads to chaos (largest Lyapunov exponent {exponent:.4} per forcing period), not to a \
             periodic motion: {other}"
        ),
        Regime::QuasiPeriodic => {
            format!("this start leads to a quasi-periodic motion, not to a periodic one: {other}")
        }
        Regime::NoImpact => format!(
            "this start leads to a motion without impact, of which there is nothing to \
             solve: {other}"
        ),
        Regime::AperiodicSticking => {
            "this start leads to sticking without a period: raise --transient, --observe or \
             --max-period, or try another --start"
                .to_owned()
        }
        Regime::Unresolved => format!(
            "no period was found from this start in {} forcing periods: raise --transient, --observe or \
             --max-period, or {other}",
            verdict.periods
        ),
        Regime::Failed if !verdict.state.is_bounded() => format!(
            "the motion grows without bounds: {} forcing periods take it out of all reach; try more damping, or another --start",
            verdict.periods
        ),
        Regime::Failed => format!(
            "the trajectory was given up after {} forcing periods, with more impacts in one of them than can be \
             followed: try less restitution or a faster forcing, or another --start",
            verdict.periods
        ),
        Regime::Inadmissible => format!("this start lies beyond a stop: {other}"),
    })
}

/// The count of a label at one of its places, 0 beyond the last.
fn labelled(system: &System, per_stop: &[u32], place: usize) -> u32 {
    system.label_order().get(place).map_or(0, |&stop| per_stop[stop])
}

impl Motion {
    fn of_impacts(system: &System, motion: &PeriodicMotion) -> Self {
        let stop = motion.pattern.stops[0];
        Motion {
            label: motion.label(),
            n: motion.pattern.n(),
            p: labelled(system, &motion.pattern.counts(), 0),
            q: labelled(system, &motion.pattern.counts(), 1),
            impacts_per_stop: motion.pattern.counts(),
            has_mirror: system.mirror().is_some(),
            first_stop: system.stop_name(0),
            symmetric: motion.is_symmetric(),
            stable: motion.is_stable(system),
            sticking: false,
            section: Some(motion.section().into_iter().map(|value| value + 0.0).collect()),
            section_text: Some(multipliers::section(system, stop, &motion.section())),
            section_stop: Some(system.stop_name(stop.index())),
            section_names: Some(section_names(system, stop)),
            multipliers: motion.multipliers(system).map(pairs),
            half_multipliers: motion.half_multipliers(system).map(pairs),
            state: motion.at_phase_zero(system),
            residual: motion.residual,
            method: "impact sequence",
        }
    }

    fn of_strobe(system: &System, motion: &StrobeMotion) -> Self {
        let section = motion.section.as_ref();
        let impacts: Vec<u32> = motion.impacts.iter().map(|&count| count.into()).collect();
        Motion {
            label: motion.label(),
            n: motion.n,
            p: labelled(system, &impacts, 0),
            q: labelled(system, &impacts, 1),
            impacts_per_stop: impacts,
            has_mirror: system.mirror().is_some(),
            first_stop: system.stop_name(0),
            symmetric: motion.symmetric,
            stable: motion.is_stable(),
            sticking: motion.sticking,
            section: section.map(|(_, section)| section.clone()),
            section_text: section.map(|(stop, section)| multipliers::section(system, *stop, section)),
            section_stop: section.map(|(stop, _)| system.stop_name(stop.index())),
            section_names: section.map(|(stop, _)| section_names(system, *stop)),
            multipliers: motion.multipliers().map(pairs),
            half_multipliers: motion.half_multipliers().map(pairs),
            state: motion.state.clone(),
            residual: motion.residual,
            method: "strobe map",
        }
    }

    fn text(&self) -> String {
        let symmetry = match (self.has_mirror, self.symmetric) {
            (false, _) => "",
            (true, true) => ", symmetric",
            (true, false) => ", unsymmetric",
        };
        let sticking = if self.sticking { ", with sticking" } else { "" };
        let stability = multipliers::stability(self.stable);
        let stop = self.section_stop.unwrap_or(self.first_stop);
        let never = match stop == self.first_stop {
            true => String::new(),
            false => format!(" (stop {} is never struck)", self.first_stop),
        };
        let at = format!("section at stop {stop}");
        let section = self.section_text.as_deref().unwrap_or("none: there is no impact");
        let mut text = format!(
            "{}{symmetry}{sticking}, {stability}\n\
             {at:<28}{section}{never}\n\
             multipliers                 {}",
            self.label,
            multipliers::text(self.multipliers.as_ref())
        );
        if let Some(half) = &self.half_multipliers {
            text += &format!("\nhalf multipliers            {}", multipliers::text(Some(half)));
        }
        text += &format!(
            "\nstate at forcing phase 0    {}\n\
             solved by                   Newton's method on the {}, residual {:.1e}",
            multipliers::state(&self.state),
            self.method,
            self.residual
        );
        text
    }
}
