//! `impact-atlas symmetric`: the symmetric motion of period one in closed form.

use clap::Args;
use impact_atlas::model::System;
use impact_atlas::theory::{NoSymmetricMotion, SymmetricMotion, section_names, symmetric_motions};
use serde::Serialize;

use super::interrupt::abandonable;
use super::multipliers::{self, note_cpu, pairs};
use super::options::SystemArgs;
use super::terminal::{print, print_json};
use super::{CliError, Result, wrong};

/// Computes the symmetric 1-1-1 motion in closed form, with its Floquet multipliers
///
/// It exists where the system has a mirror that exchanges two stops. Over half a forcing period it flies from one of them to
/// the other and is its own mirror image there. These conditions
/// have two solutions or none, and a solution need not be physical: it may leave its stop outwards, or pass through
/// one. The section is (v1+, x2, v2, tau) just after the impact at the paper's stop A, x1 = +delta; of other systems it is
/// the velocity along the stop's own coordinate at the first stop that the mirror exchanges, the other displacements, the
/// other velocities and tau (see section_names). tau is the forcing phase. The
/// half multipliers are those of half a period followed by the mirror: −1 is the symmetry-breaking pitchfork, +1 a
/// saddle-node, a complex pair on the unit circle Neimark–Sacker. The multipliers are their squares.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas symmetric --set omega=3.7
  impact-atlas symmetric --set omega=2.582 --set delta=0.6 --json
  impact-atlas symmetric --system impact-pair --set nu=2")]
pub struct SymmetricArgs {
    #[command(flatten)]
    system: SystemArgs,

    /// Prints JSON; null where multipliers do not exist (an impact grazes) and for the stability of what is not
    /// physical
    #[arg(long)]
    json: bool,
}

/// What is printed; every quantity non-dimensional.
#[derive(Debug, Serialize)]
struct Solutions {
    solutions: Vec<Solution>,
    reason: Option<String>,
}

#[derive(Debug, Serialize)]
struct Solution {
    label: String,
    impacts_per_stop: Vec<u32>,
    section_stop: &'static str,
    section_names: Vec<String>,
    section: Vec<f64>,
    #[serde(skip)]
    section_text: String,
    physical: bool,
    reason: Option<String>,
    half_multipliers: Option<Vec<[f64; 2]>>,
    multipliers: Option<Vec<[f64; 2]>>,
    stable: Option<bool>,
    state: Option<Vec<f64>>,
    residual: f64,
}

/// Runs the command.
pub fn run(args: &SymmetricArgs) -> Result<()> {
    let system = System::new(args.system.parameters(&[])?).map_err(CliError::input)?;
    note_cpu();
    let result = abandonable(move || Solutions::of(&system))??;
    if args.json { print_json(&result) } else { print(&result.text()) }
}

impl Solutions {
    fn of(system: &System) -> Result<Self> {
        match symmetric_motions(system) {
            Ok(solutions) => Ok(Solutions {
                solutions: solutions.iter().map(|solution| Solution::new(system, solution)).collect(),
                reason: None,
            }),
            Err(reason @ NoSymmetricMotion::NoMirror) => Err(wrong!(
                "the symmetric motion {reason}: choose a system whose stops and matrices are their own mirror image, or \
                 `motion --label` for any other motion"
            )),
            Err(reason) => Ok(Solutions { solutions: Vec::new(), reason: Some(reason.to_string()) }),
        }
    }

    fn text(&self) -> String {
        if let Some(reason) = &self.reason {
            return format!("no symmetric 1-1-1 motion: it {reason}");
        }
        let texts: Vec<String> = self.solutions.iter().map(Solution::text).collect();
        texts.join("\n\n")
    }
}

impl Solution {
    fn new(system: &System, solution: &SymmetricMotion) -> Self {
        let motion = &solution.motion;
        let physical = solution.at_phase_zero.is_ok();
        let stop = motion.pattern.stops[0];
        Solution {
            label: motion.label(),
            impacts_per_stop: motion.pattern.counts(),
            section_stop: system.stop_name(stop.index()),
            section_names: section_names(system, stop),
            section_text: multipliers::section(system, stop, &motion.section()),
            section: motion.section().into_iter().map(|value| value + 0.0).collect(),
            physical,
            reason: solution.at_phase_zero.as_ref().err().map(|reason| reason.to_string()),
            half_multipliers: motion.half_multipliers(system).map(pairs),
            multipliers: motion.multipliers(system).map(pairs),
            stable: motion.is_stable(system).filter(|_| physical),
            state: solution.at_phase_zero.clone().ok(),
            residual: motion.residual,
        }
    }

    fn text(&self) -> String {
        let what = match &self.reason {
            None => format!("{} symmetric, {}", self.label, multipliers::stability(self.stable)),
            Some(reason) => format!("not physical: {reason}"),
        };
        let half = multipliers::text(self.half_multipliers.as_ref());
        let whole = multipliers::text(self.multipliers.as_ref());
        let section = &self.section_text;
        let at = format!("section at stop {}", self.section_stop);
        let mut text = format!(
            "{what}\n\
             {at:<28}{section}\n\
             half multipliers            {half}\n\
             multipliers                 {whole}"
        );
        if let Some(state) = &self.state {
            text += &format!("\nstate at forcing phase 0    {}", multipliers::state(state));
        }
        text
    }
}
