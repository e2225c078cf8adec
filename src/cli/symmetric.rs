//! `impact-atlas symmetric`: the symmetric 1-1-1 motion in closed form.

use clap::Args;
use impact_atlas::model::System;
use impact_atlas::theory::{SymmetricMotion, symmetric_motions};
use serde::Serialize;

use super::CliError;
use super::interrupt::abandonable;
use super::multipliers::{self, note_cpu, pairs};
use super::options::SystemArgs;
use super::terminal::{print, print_json};

/// Computes the symmetric 1-1-1 motion in closed form, with its Floquet multipliers
///
/// Over half a forcing period it flies from one stop to the other and is its own mirror image there. These conditions
/// have two solutions or none, and a solution need not be physical: it may leave its stop outwards, or pass through
/// one. The section is (v1+, x2, v2, tau) just after the impact at stop A, x1 = +delta; tau is the forcing phase. The
/// half multipliers are those of half a period followed by the mirror: −1 is the symmetry-breaking pitchfork, +1 a
/// saddle-node, a complex pair on the unit circle Neimark–Sacker. The multipliers are their squares.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas symmetric --set omega=3.7
  impact-atlas symmetric --set omega=2.582 --set delta=0.6 --json")]
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
pub fn run(args: &SymmetricArgs) -> Result<(), CliError> {
    args.system.of_paper("symmetric")?;
    let system = System::new(args.system.parameters(&[])?).map_err(CliError::input)?;
    note_cpu();
    let result = abandonable(move || Solutions::of(&system))?;
    if args.json { print_json(&result) } else { print(&result.text()) }
}

impl Solutions {
    fn of(system: &System) -> Self {
        match symmetric_motions(system) {
            Ok(solutions) => Solutions {
                solutions: solutions.iter().map(|solution| Solution::new(system, solution)).collect(),
                reason: None,
            },
            Err(reason) => Solutions { solutions: Vec::new(), reason: Some(reason.to_string()) },
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
        Solution {
            section_text: multipliers::section(system, motion.pattern.stops[0], &motion.section()),
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
            None => format!("1-1-1 symmetric, {}", multipliers::stability(self.stable)),
            Some(reason) => format!("not physical: {reason}"),
        };
        let half = multipliers::text(self.half_multipliers.as_ref());
        let whole = multipliers::text(self.multipliers.as_ref());
        let section = &self.section_text;
        let mut text = format!(
            "{what}\n\
             section at stop A           {section}\n\
             half multipliers            {half}\n\
             multipliers                 {whole}"
        );
        if let Some(state) = &self.state {
            text += &format!("\nstate at forcing phase 0    {}", multipliers::state(state));
        }
        text
    }
}
