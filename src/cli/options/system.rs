//! The system and its fixed parameters.

use clap::{Arg, Args};
use impact_atlas::model::{Parameter, Setting, StateVector, System};
use impact_atlas::plane::{Axis, Plane, Quantity, Start, StartError};
use impact_atlas::system::Family;
use impact_atlas::theory::symmetric_start;

use crate::cli::method::varied;
use crate::cli::system::{Chosen, parse_system};
use crate::cli::values::Assignment;
use crate::cli::{CliError, Result, defaults, note, wrong};

/// The system and its fixed parameters.
#[derive(Clone, Debug, Args)]
pub struct SystemArgs {
    /// The system: one that comes with the program (see `impact-atlas systems`), or a file that describes one
    ///
    /// With --help beside it, its parameters, stops and labels are listed below.
    /// [default: luo-ma-lv]
    #[arg(long = "system", value_name = "NAME|FILE", value_parser = parse_system)]
    family: Option<Chosen>,

    /// Sets a parameter of the system; may be given for each of them
    #[arg(long = "set", value_name = "NAME=VALUE", long_help = HELP_OF_SET)]
    assignments: Vec<String>,
}

impl SystemArgs {
    /// The family of the system.
    pub fn family(&self) -> &'static Family {
        self.family.map_or_else(|| Family::builtin(defaults::SYSTEM), |chosen| chosen.0)
    }

    /// Those that name a family alone.
    pub(super) fn of_family(family: &'static Family) -> SystemArgs {
        SystemArgs { family: Some(Chosen(family)), assignments: Vec::new() }
    }

    /// The same options for the system of a plane that was computed before.
    pub(super) fn of_family_of(&self, plane: &Plane) -> Result<SystemArgs> {
        let family = plane.parameters.family();
        if self.family.is_some_and(|chosen| chosen.0.hash != family.hash) {
            return Err(wrong!(
                "the plane of --from is of the system {}: drop --system, or --from",
                family.origin
            ));
        }
        Ok(SystemArgs { family: Some(Chosen(family)), assignments: self.assignments.clone() })
    }

    /// What an option names by the words of the system: an axis, a section, a quantity, a panel, a label.
    pub fn named<T, E>(
        &self,
        option: &str,
        text: &str,
        read: impl Fn(&str, &'static Family) -> Result<T, E>,
    ) -> Result<T>
    where
        E: std::error::Error + Send + Sync + 'static,
    {
        read(text, self.family()).map_err(|error| invalid(text, option, error))
    }

    /// The parameters as set; those that `axes` vary, each with the option that gives it, are left to them.
    pub fn parameters(&self, axes: &[(&str, Axis)]) -> Result<Setting> {
        self.check_beside(axes)?;
        self.assigned_to(Setting::defaults(self.family()))
    }

    pub fn assignments(&self) -> Result<Vec<Assignment>> {
        let read = |text: &String| {
            Assignment::of_family(text, self.family())
                .map_err(|error| invalid(text, "--set <NAME=VALUE>", error))
        };
        self.assignments.iter().map(read).collect()
    }

    /// Refuses to set what an axis varies.
    pub(super) fn check_beside(&self, axes: &[(&str, Axis)]) -> Result<()> {
        for (option, axis) in axes {
            if let Some(set) = self.assignments()?.iter().find(|set| set.quantity == axis.quantity) {
                return Err(wrong!(
                    "--set {set} has no effect, since {option} {axis} varies {}: drop one of the two",
                    axis.quantity.name()
                ));
            }
        }
        Ok(())
    }

    /// The parameters of the system alone, and the settings of a control method that were set beside them.
    pub fn split(&self) -> Result<(SystemArgs, Vec<Assignment>)> {
        let of_method = |set: &Assignment| matches!(set.quantity, Quantity::Control(_));
        let all = self.assignments()?;
        let texts = self.assignments.iter().zip(&all).filter(|(_, set)| !of_method(set));
        let assignments = texts.map(|(text, _)| text.clone()).collect();
        let settings = all.iter().copied().filter(of_method).collect();
        Ok((SystemArgs { family: self.family, assignments }, settings))
    }

    /// A setting with what is assigned in place of its own values.
    pub(super) fn assigned_to(&self, mut setting: Setting) -> Result<Setting> {
        let assignments = self.assignments()?;
        Assignment::refuse_twice(&assignments)?;
        for set in assignments {
            let Quantity::Parameter(parameter) = set.quantity else {
                let known: Vec<&str> = Parameter::all(self.family()).map(Parameter::name).collect();
                return Err(wrong!(
                    "--set {set} has no effect without control: {} is a setting of a control method (see `control` \
                     and `map --control`); the parameters are {}",
                    set.quantity.name(),
                    known.join(", ")
                ));
            };
            setting = setting.with(parameter, set.value);
        }
        Ok(setting)
    }

    /// The system, with a start that lies between its stops.
    pub fn system_and_start(&self, start: Start) -> Result<(System, StateVector)> {
        begun(self.parameters(&[])?, start, "choose it within the gap")
    }
}

/// The system of a setting, with the state of a start that lies between its stops; `remedy` is what helps where it does not.
pub(super) fn begun(setting: Setting, start: Start, remedy: &str) -> Result<(System, StateVector)> {
    let system = System::new(setting).map_err(CliError::input)?;
    start.check(system.plant(), setting.family()).map_err(|error| match error {
        StartError::OutsideStops { .. } => wrong!("{error}; {remedy}"),
        error => CliError::input(error),
    })?;
    let state = start_state(&system, start);
    Ok((system, state))
}

/// What is said of the option that sets parameters.
const HELP_OF_SET: &str = "\
Sets a parameter of the system; may be given for each of them

Those not given have the system's defaults; the paper's are omega=3.7, delta=0.1, zeta=0.1, r=0.8, mu_m=mu_k=mu_c=0.5, f20=0.";

/// The option that sets parameters, of a command that sets what a control method has by it, too.
pub fn sets_control(set: Arg) -> Arg {
    set.long_help(format!(
        "{HELP_OF_SET} Under control it sets what the method has, too: {}; target_v1 … target_vn, target_x1 … target_xn, target_tau.",
        varied()
    ))
}

/// An option whose value cannot be used.
fn invalid(text: &str, option: &str, error: impl std::error::Error + Send + Sync + 'static) -> CliError {
    wrong!("invalid value '{text}' for '{option}': {:#}", anyhow::Error::new(error))
}

/// The state that a start means for a system, which is told where it is not the one named.
fn start_state(system: &System, start: Start) -> StateVector {
    let is_sought = system.mirror().is_some() && system.plant().stops.len() == 2;
    if start == Start::Symmetric && is_sought && symmetric_start(system).is_none() {
        note("there is no physical symmetric 1-1-1 motion here: starting from rest");
    }
    start.state(system)
}
