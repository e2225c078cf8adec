//! A plane, and how long its cells run.

use clap::{Arg, Args};
use impact_atlas::analysis::Schedule;
use impact_atlas::control::{ControlSchedule, Method};
use impact_atlas::plane::{Control, Plane, Quantity};

use super::axes::{AxesArgs, default_start};
use crate::cli::method::MethodArgs;
use crate::cli::values::count;
use crate::cli::{CliError, Result, defaults};

/// A plane and how long its cells run.
#[derive(Debug, Args)]
pub struct PlaneArgs {
    #[command(flatten)]
    pub axes: AxesArgs,

    /// Forcing periods before the observation
    ///
    /// Where the verdict is in doubt a cell goes on. Chaos may be transient: it runs up to 320 periods more. What is still
    /// undecided or neutral runs as long again and is observed four times as long: beside a Neimark-Sacker curve spirals are
    /// slow. What even that leaves undecided runs eight times as long. What returns without having settled is held against
    /// the exact motion beside it.
    /// [default: 300]
    #[arg(long, value_parser = count, value_name = "P")]
    transient: Option<u32>,

    /// Forcing periods of the observation [default: 150]
    ///
    /// Chaos that is plain after half of it, and no less than 64 periods, is not observed any longer, unless the periods are fixed;
    /// what is observed of it when it is looked at for longer counts, too.
    #[arg(long, value_parser = count, value_name = "P")]
    observe: Option<u32>,

    /// Largest N looked for in N-p-q [default: 32]
    ///
    /// A motion with a longer period has none: it is quasi-periodic, chaotic or unresolved.
    #[arg(long, value_parser = count, value_name = "N")]
    pub max_period: Option<u32>,

    /// Every cell runs transient + observe periods, settled or not
    #[arg(long)]
    fixed_periods: bool,
}

/// The option of the largest period, of a command that counts the iterates of control by it, too.
pub fn counts_iterates(max_period: Arg) -> Arg {
    max_period
        .help("Largest N looked for in N-p-q [default: 32]; under control, most iterates in one period [default: 8]")
        .long_help(
            "Largest N looked for in N-p-q [default: 32]; under control, most iterates in one period [default: 8]\n\nA motion \
             with a longer period has none: it is quasi-periodic, chaotic or unresolved. Under control at most 32, on the GPU 8.",
        )
}

impl PlaneArgs {
    /// The checked plane.
    pub fn plane(&self) -> Result<Plane> {
        self.axes.plane(Schedule {
            transient: self.transient.unwrap_or(defaults::TRANSIENT),
            observe: self.observe.unwrap_or(defaults::OBSERVE),
            max_period: self.max_period.unwrap_or(defaults::MAX_PERIOD),
            fixed_periods: self.fixed_periods,
        })
    }

    /// A plane that was computed before, with what is given in place of its own.
    pub fn again(&self, plane: &Plane) -> Result<Plane> {
        let own = plane.task;
        let schedule = Schedule {
            transient: self.transient.unwrap_or(own.transient),
            observe: self.observe.unwrap_or(own.observe),
            max_period: self.max_period.unwrap_or(own.max_period),
            fixed_periods: self.fixed_periods || own.fixed_periods,
        };
        self.axes.again(plane, schedule)
    }

    /// The checked plane under control.
    pub fn control_plane(
        &self,
        method: &Method,
        settings: &MethodArgs,
        schedule: ControlSchedule,
    ) -> Result<Plane<Control>> {
        let [x, y] = self.axes.axes()?;
        let axes = [("--x", x), ("--y", y)];
        let varied = axes.map(|(option, axis)| (format!("{option} {axis} varies"), axis.quantity));
        settings.refuse_replaced(method, &varied)?;
        self.axes.system.check_beside(&axes)?;
        let (system, set) = self.axes.system.split()?;
        let of_system = system.assignments()?.into_iter().map(|set| set.quantity);
        MethodArgs::note_shadowed(method, of_system.chain([x.quantity, y.quantity]));
        let parameters = system.parameters(&axes)?;
        let first = [x, y].iter().fold(parameters, |setting, axis| match axis.quantity {
            Quantity::Parameter(parameter) => setting.with(parameter, axis.first),
            Quantity::Start(_) | Quantity::Control(_) => setting,
        });
        let plane = Plane {
            x,
            y,
            parameters,
            start: self.axes.start.unwrap_or_else(|| default_start(&[x, y])),
            task: Control { scheme: settings.scheme(method, &set, &first)?, schedule },
        };
        plane.check().map_err(CliError::input)?;
        Ok(plane)
    }
}
