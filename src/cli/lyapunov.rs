//! `impact-atlas lyapunov`: all Lyapunov exponents of a trajectory.

use clap::Args;
use impact_atlas::analysis::Schedule;
use impact_atlas::dynamics::Stop;
use impact_atlas::model::System;
use impact_atlas::plane::Start;
use impact_atlas::theory::Spectrum;
use serde::Serialize;

use super::interrupt::abandonable;
use super::multipliers::note_cpu;
use super::options::{Trajectory, TrajectoryArgs};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::values::count;
use super::{CliError, Result, defaults};

/// Measures all 2n Lyapunov exponents of one trajectory of a system with n coordinates
///
/// Natural logarithm, largest first, in three units: per forcing period, per unit of (non-dimensional) time, and per
/// iterate of the impact map (one return to the system's first stop, just after an impact; the paper's is A, x1 = +delta),
/// which is the paper's unit.
/// The standard error is per forcing period, from the scatter of 16 batches. An exponent of minus infinity is a
/// direction that is lost: complete chatter and sticking forget the place and velocity along the contact (two
/// directions), an impact with r = 0 forgets one. The sum of all is known exactly, as the contraction of volume:
/// −T tr(M⁻¹C) + 2 ln r × (impacts per forcing period), stop by stop. Masses that no spring and no stop ties to the ground
/// have fewer: those of 0, of where they drift to, are left out. Computed in double precision on the CPU. Exit code 1 if the
/// trajectory cannot be followed.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas lyapunov --set omega=2.83
  impact-atlas lyapunov --set omega=3.03 --transient 5000 --observe 50000 --json
  impact-atlas lyapunov --from map.png --at omega=2.83,delta=0.1
  impact-atlas lyapunov --system three-mass-chain --set omega=1.5")]
pub struct LyapunovArgs {
    #[command(flatten)]
    asked: TrajectoryArgs,

    /// Forcing periods before the measurement
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::TRAJECTORY_TRANSIENT)]
    transient: u32,

    /// Forcing periods of the measurement, rounded up to a multiple of 16; a quarter as many go before it, in which
    /// the tangent vectors turn into their directions
    #[arg(long, value_parser = count, value_name = "P", default_value_t = defaults::SPECTRUM_OBSERVE)]
    observe: u32,

    /// Prints JSON; null for minus infinity (see lost_directions), and per iterate where there are no returns to the first
    /// stop or infinitely many; impacts_per_stop counts in the order of the system's stops
    #[arg(long)]
    json: bool,
}

/// What is printed; every quantity non-dimensional.
#[derive(Debug, Serialize)]
struct Exponents {
    exponents_per_period: Vec<Option<f64>>,
    exponents_per_iterate: Option<Vec<Option<f64>>>,
    exponents_per_time: Vec<Option<f64>>,
    /// Per forcing period.
    standard_error: Vec<Option<f64>>,
    standard_error_per_time: Vec<Option<f64>>,
    lost_directions: u32,
    /// What stops without room between them do, in words.
    #[serde(skip)]
    closed: Option<String>,
    /// The stop whose returns are iterates.
    #[serde(skip)]
    first_stop: &'static str,
    iterates: Option<u64>,
    impacts: u64,
    impacts_per_stop: Vec<u64>,
    periods: u32,
    period: f64,
    /// The sum of all per forcing period, and what it must be.
    sum_per_period: Option<f64>,
    sum_identity: Option<f64>,
}

/// Runs the command.
pub fn run(args: &LyapunovArgs) -> Result<()> {
    let (transient, observe) = (args.transient, args.observe);
    let schedule = Schedule { transient, observe, max_period: defaults::MAX_PERIOD, fixed_periods: true };
    schedule.check().map_err(CliError::input)?;
    let Trajectory { system, state, .. } = args.asked.trajectory(Start::Rest)?;
    note_cpu();
    let progress = Progress::of_trajectory();
    let spectrum = {
        let system = system.clone();
        abandonable(move || Spectrum::of(&system, &state[..], transient, observe))?
    };
    drop(progress);
    let spectrum = spectrum.map_err(|failed| CliError::NotFound(failed.to_string()))?;
    let exponents = Exponents::new(&system, &spectrum);
    if args.json { print_json(&exponents) } else { print(&exponents.text()) }
}

impl Exponents {
    fn new(system: &System, spectrum: &Spectrum) -> Self {
        let finite =
            |values: Vec<f64>| values.iter().map(|&value| value.is_finite().then_some(value)).collect();
        let kept = spectrum.per_period.len() - spectrum.lost as usize;
        let errors = |unit: f64| {
            let errors = spectrum.standard_error.iter().enumerate();
            errors.map(|(j, &error)| (j < kept).then_some(error / unit)).collect()
        };
        let whole = spectrum.lost == 0;
        Exponents {
            exponents_per_period: finite(spectrum.per_period.clone()),
            exponents_per_iterate: spectrum.per_iterate(Stop::A).map(finite),
            exponents_per_time: finite(spectrum.per_time()),
            standard_error: errors(1.0),
            standard_error_per_time: errors(spectrum.period),
            lost_directions: spectrum.lost,
            closed: system.is_clamped().then(|| system.closed()),
            first_stop: system.stop_name(0),
            iterates: spectrum.returns(Stop::A),
            impacts: spectrum.impacts,
            impacts_per_stop: spectrum.impacts_per_stop.clone(),
            periods: spectrum.periods,
            period: spectrum.period,
            sum_per_period: whole.then(|| spectrum.per_period.iter().sum()),
            sum_identity: whole.then(|| spectrum.sum_identity(system)),
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![format!(
            "{:<12}{:>16}{:>16}{:>16}{:>16}",
            "exponent", "per period", "± (period)", "per time", "per iterate"
        )];
        for j in 0..self.exponents_per_period.len() {
            let Some(per_period) = self.exponents_per_period[j] else {
                let why = match (&self.closed, self.lost_directions) {
                    (Some(closed), _) => format!("{closed}: place and velocity there do not count"),
                    (None, 1) => {
                        "an impact without rebound forgets the velocity along the contact".to_owned()
                    }
                    (None, _) => {
                        "complete chatter or sticking forgets place and velocity along the contact".to_owned()
                    }
                };
                lines.push(format!("{:<12}{:>16}  (minus infinity): {why}", j + 1, "lost"));
                continue;
            };
            let per_iterate = self.exponents_per_iterate.as_ref().and_then(|values| values[j]);
            let number = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.6}"));
            lines.push(format!(
                "{:<12}{per_period:>16.6}{:>16}{:>16}{:>16}",
                j + 1,
                self.standard_error[j].map_or("–".to_owned(), |error| format!("{error:.1e}")),
                number(self.exponents_per_time[j]),
                number(per_iterate)
            ));
        }
        lines.push(match (self.sum_per_period, self.sum_identity) {
            (Some(sum), Some(identity)) => format!(
                "sum per period              {sum:.9}\n\
                 -T tr(M^-1 C) + 2 ln r × impacts per period   {identity:.9}"
            ),
            _ => "sum per period              minus infinity".to_owned(),
        });
        let stop = self.first_stop;
        let returns = match self.iterates {
            Some(0) => format!("no return to stop {stop}, and so no exponent per iterate"),
            Some(iterates) => format!("{iterates} iterates of the impact map"),
            None => {
                format!(
                    "infinitely many returns to stop {stop} (complete chatter), and so no exponent per iterate"
                )
            }
        };
        lines.push(format!(
            "natural logarithm; {} forcing periods of {:.6}, {} impacts, {returns}",
            self.periods, self.period, self.impacts
        ));
        lines.join("\n")
    }
}
