//! Options that several subcommands share, and what becomes of them once they are checked.

use anyhow::anyhow;
use clap::{Args, ValueEnum};
use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{self, Backend, BackendError, Choice};
use impact_atlas::control::{ControlQuantity, ControlSchedule};
use impact_atlas::model::{Parameter, Setting, StateVector, System};
use impact_atlas::plane::{Axis, ControlPlane, Plane, Provenance, Quantity, Start};
use impact_atlas::system::Family;
use impact_atlas::theory::symmetric_start;

use super::method::{MethodArgs, MethodName};
use super::system::{Chosen, parse_system};
use super::values::{Assignment, count, parse};
use super::{CliError, defaults, note};

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
    ///
    /// Those not given have the system's defaults; the paper's are omega=3.7, delta=0.1, zeta=0.1, r=0.8,
    /// mu_m=mu_k=mu_c=0.5, f20=0. Under control it sets what the method has, too: gain, delay; amplitude, alpha, dead_band,
    /// gamma, phase; period, noise; target_v1 … target_vn, target_x1 … target_xn, target_tau.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    assignments: Vec<String>,
}

impl SystemArgs {
    /// The family of the system.
    pub fn family(&self) -> &'static Family {
        self.family.map_or_else(|| Family::builtin(defaults::SYSTEM), |chosen| chosen.0)
    }

    /// The same options for the system of a plane that was computed before.
    fn of_family_of(&self, plane: &Plane) -> Result<SystemArgs, CliError> {
        let family = plane.parameters.family();
        if self.family.is_some_and(|chosen| chosen.0.hash() != family.hash()) {
            return Err(CliError::Input(anyhow!(
                "the plane of --from is of the system {}: drop --system, or --from",
                family.origin()
            )));
        }
        Ok(SystemArgs { family: Some(Chosen(family)), assignments: self.assignments.clone() })
    }

    /// An axis of the system, given as `option`.
    pub fn axis(&self, option: &str, text: &str) -> Result<Axis, CliError> {
        Axis::of_family(text, self.family()).map_err(|error| invalid(text, option, error))
    }

    /// What an option names by the words of the system: a section, a quantity, a panel, a label.
    pub fn named<T, E>(
        &self,
        option: &str,
        text: &str,
        read: impl Fn(&str, &'static Family) -> Result<T, E>,
    ) -> Result<T, CliError>
    where
        E: std::error::Error + Send + Sync + 'static,
    {
        read(text, self.family()).map_err(|error| invalid(text, option, error))
    }

    /// The parameters as set; those of `axes` are left to the axes.
    pub fn parameters(&self, axes: &[(&str, Axis)]) -> Result<Setting, CliError> {
        for (option, axis) in axes {
            self.check_beside(option, &axis.to_string(), axis.quantity)?;
        }
        self.assigned()
    }

    /// The parameters as set; the quantity that `axis`, given as `option`, varies is left to it.
    pub fn parameters_beside(
        &self,
        option: &str,
        axis: &str,
        quantity: Quantity,
    ) -> Result<Setting, CliError> {
        self.check_beside(option, axis, quantity)?;
        self.assigned()
    }

    fn assignments(&self) -> Result<Vec<Assignment>, CliError> {
        let read = |text: &String| {
            Assignment::of_family(text, self.family())
                .map_err(|error| invalid(text, "--set <NAME=VALUE>", error))
        };
        self.assignments.iter().map(read).collect()
    }

    fn check_beside(&self, option: &str, axis: &str, quantity: Quantity) -> Result<(), CliError> {
        match self.assignments()?.iter().find(|set| set.quantity == quantity) {
            Some(set) => Err(CliError::Input(anyhow!(
                "--set {set} has no effect, since {option} {axis} varies {}: drop one of the two",
                quantity.name()
            ))),
            None => Ok(()),
        }
    }

    /// The parameters of the system alone, and the settings of a control method that were set beside them.
    pub fn split(&self) -> Result<(SystemArgs, Vec<Assignment>), CliError> {
        let of_method = |set: &Assignment| matches!(set.quantity, Quantity::Control(_));
        let all = self.assignments()?;
        let texts = self.assignments.iter().zip(&all).filter(|(_, set)| !of_method(set));
        let assignments = texts.map(|(text, _)| text.clone()).collect();
        let settings = all.iter().copied().filter(of_method).collect();
        Ok((SystemArgs { family: self.family, assignments }, settings))
    }

    fn assigned(&self) -> Result<Setting, CliError> {
        self.assigned_to(Setting::defaults(self.family()))
    }

    /// A setting with what is assigned in place of its own values.
    fn assigned_to(&self, mut setting: Setting) -> Result<Setting, CliError> {
        let assignments = self.assignments()?;
        for (i, set) in assignments.iter().enumerate() {
            if let Some(other) = assignments[..i].iter().find(|other| other.quantity == set.quantity) {
                return Err(CliError::Input(anyhow!(
                    "{} is set twice, by --set {other} and --set {set}: drop one of the two",
                    set.quantity.name()
                )));
            }
            let Quantity::Parameter(parameter) = set.quantity else {
                let known: Vec<&str> = Parameter::all(self.family()).map(Parameter::name).collect();
                return Err(CliError::Input(anyhow!(
                    "--set {set} has no effect without control: {} is a setting of a control method (see `control` \
                     and `map --control`); the parameters are {}",
                    set.quantity.name(),
                    known.join(", ")
                )));
            };
            setting = setting.with(parameter, set.value);
        }
        Ok(setting)
    }

    /// The system, with a start that lies between its stops.
    pub fn system_and_start(&self, start: Start) -> Result<(System, StateVector), CliError> {
        let system = System::new(self.parameters(&[])?).map_err(CliError::input)?;
        start.check(system.plant(), self.family()).map_err(CliError::input)?;
        let state = start_state(&system, start);
        Ok((system, state))
    }
}

/// An option whose value cannot be used.
fn invalid(text: &str, option: &str, error: impl std::error::Error + Send + Sync + 'static) -> CliError {
    CliError::Input(anyhow!("invalid value '{text}' for '{option}': {:#}", anyhow::Error::new(error)))
}

/// What becomes of files that are there.
#[derive(Clone, Copy, Debug, Args)]
pub struct OverwriteArgs {
    /// Replaces result files that are there; without it they are left alone, and nothing is computed
    #[arg(long)]
    pub force: bool,
}

/// The state that a start means for a system, which is told where it is not the one named.
pub fn start_state(system: &System, start: Start) -> StateVector {
    let is_sought = system.mirror().is_some() && system.plant().stops.len() == 2;
    if start == Start::Symmetric && is_sought && symmetric_start(system).is_none() {
        note("there is no physical symmetric 1-1-1 motion here: starting from rest");
    }
    start.state(system)
}

/// What computes.
#[derive(Clone, Debug, Args)]
pub struct BackendArgs {
    /// What computes: the GPU (f32) or the CPU (f64)
    ///
    /// `auto` takes a hardware GPU where there is one, or the adapter that --adapter names, and otherwise the CPU: a
    /// software adapter is slower on the same cores.
    #[arg(long, value_enum, default_value_t = BackendName::Auto)]
    pub backend: BackendName,

    /// Uses the adapter of an address on the PCI bus or an index, or one whose name contains TEXT (see `impact-atlas adapters`)
    #[arg(long, value_name = "PCI|#INDEX|TEXT")]
    pub adapter: Option<String>,
}

/// A back end by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendName {
    /// A hardware GPU, otherwise the CPU
    Auto,
    /// A hardware GPU, otherwise a software adapter
    Gpu,
    /// Double precision on all cores; the reference
    Cpu,
}

impl BackendArgs {
    /// The same options, or where none was given those of what computed a plane before.
    pub fn or_those_of(&self, provenance: &Provenance) -> Self {
        if self.backend != BackendName::Auto || self.adapter.is_some() {
            return self.clone();
        }
        let backend = if provenance.backend == "gpu" { BackendName::Gpu } else { BackendName::Cpu };
        BackendArgs { backend, adapter: None }
    }

    /// Opens the back end anew, after it failed, without a word.
    pub fn reopen(&self) -> Result<Box<dyn Backend>, BackendError> {
        backend::open(self.choice(), self.adapter.as_deref())
    }

    fn choice(&self) -> Choice {
        match self.backend {
            BackendName::Auto => Choice::Auto,
            BackendName::Gpu => Choice::Gpu,
            BackendName::Cpu => Choice::Cpu,
        }
    }

    /// Opens the back end and says which one it is.
    pub fn open(&self) -> Result<Box<dyn Backend>, CliError> {
        if let (BackendName::Cpu, Some(adapter)) = (self.backend, &self.adapter) {
            return Err(CliError::Input(anyhow!(
                "--adapter {adapter} chooses an adapter of the GPU back end: drop it or --backend cpu"
            )));
        }
        let backend = self.reopen()?;
        let fallback = self.backend == BackendName::Auto && backend.name() == "cpu";
        let why = if fallback { "; no hardware GPU was found" } else { "" };
        note(&format!("computing on {}: {}{why}", backend.name(), backend.adapter()));
        Ok(backend)
    }
}

/// The axes of a plane, what is fixed on it, and how its cells begin.
#[derive(Debug, Args)]
pub struct AxesArgs {
    /// Horizontal axis, ends included [default: that of the system; the paper's omega=0.2:5:800]
    ///
    /// NAME is any of the parameters (see --set) or a component of the start: x1 … xn, v1 … vn. FIRST may be greater than
    /// LAST. With :log behind COUNT, as in omega=0.1:10:400:log, values have equal ratios.
    #[arg(long, value_name = "NAME=FIRST:LAST:COUNT[:log]")]
    x: Option<String>,

    /// Vertical axis, ends included [default: that of the system; the paper's delta=0.02:0.8:600]
    #[arg(long, value_name = "NAME=FIRST:LAST:COUNT[:log]")]
    y: Option<String>,

    #[command(flatten)]
    pub system: SystemArgs,

    /// How cells begin: rest, symmetric, or a state X1,X2,V1,V2 (x1 … xn, v1 … vn) at forcing phase 0
    /// [default: symmetric, or rest where an axis varies the start]
    ///
    /// `symmetric` is the stable-branch 1-1-1 motion of the cell where there is one, nudged so that an unstable one
    /// is left, and rest elsewhere. The plane is multistable: what a map shows depends on its start.
    #[arg(long, value_name = "START", value_parser = parse::<Start>, allow_hyphen_values = true)]
    start: Option<Start>,
}

impl AxesArgs {
    /// The checked plane whose cells run by `schedule`.
    pub fn plane(&self, schedule: Schedule) -> Result<Plane, CliError> {
        let [x, y] = self.axes()?;
        let plane = Plane {
            x,
            y,
            parameters: self.system.parameters(&[("--x", x), ("--y", y)])?,
            start: self.start.unwrap_or_else(|| default_start(&[x, y])),
            schedule,
        };
        plane.check().map_err(CliError::input)?;
        Ok(plane)
    }

    /// A plane that was computed before, with the axes, parameters and the start that are given in place of its own.
    fn again(&self, plane: &Plane, schedule: Schedule) -> Result<Plane, CliError> {
        let system = self.system.of_family_of(plane)?;
        let axis = |option: &str, given: &Option<String>, own: Axis| match given {
            Some(text) => system.axis(&format!("{option} <NAME=FIRST:LAST:COUNT[:log]>"), text),
            None => Ok(own),
        };
        let (x, y) = (axis("--x", &self.x, plane.x)?, axis("--y", &self.y, plane.y)?);
        for (option, axis) in [("--x", x), ("--y", y)] {
            system.check_beside(option, &axis.to_string(), axis.quantity)?;
        }
        let start = match self.start {
            Some(start) => start,
            None if plane.start == Start::Symmetric => default_start(&[x, y]),
            None => plane.start,
        };
        let parameters = system.assigned_to(plane.parameters)?;
        let plane = Plane { x, y, parameters, start, schedule };
        plane.check().map_err(CliError::input)?;
        Ok(plane)
    }

    /// The axes as given, or those of the system's default plane.
    fn axes(&self) -> Result<[Axis; 2], CliError> {
        let plane = self.system.family().plane();
        let axis =
            |option: &str, given: &Option<String>, default: Option<&String>| match given.as_ref().or(default)
            {
                Some(text) => self.system.axis(&format!("{option} <NAME=FIRST:LAST:COUNT[:log]>"), text),
                None => Err(CliError::Input(anyhow!(
                    "the system {} has no default plane: give {option} NAME=FIRST:LAST:COUNT",
                    self.system.family().origin()
                ))),
            };
        Ok([
            axis("--x", &self.x, plane.map(|plane| &plane.x))?,
            axis("--y", &self.y, plane.map(|plane| &plane.y))?,
        ])
    }

    /// The plane with about `cells` cells; where there is no such number and no axis is given, with `default` ones.
    pub fn plane_of(&self, schedule: Schedule, cells: Option<u32>, default: u32) -> Result<Plane, CliError> {
        let plane = self.plane(schedule)?;
        Ok(match self.cells(cells, default) {
            Some(cells) => {
                let [x, y] = with_cells([plane.x, plane.y], cells);
                Plane { x, y, ..plane }
            }
            None => plane,
        })
    }

    /// How many cells are wanted, if not those of the axes.
    fn cells(&self, cells: Option<u32>, default: u32) -> Option<u32> {
        cells.or((self.x.is_none() && self.y.is_none()).then_some(default))
    }
}

/// The same axes with about so many cells, in about the same proportion; one of one value, or of whole numbers, keeps
/// its values.
fn with_cells([x, y]: [Axis; 2], cells: u32) -> [Axis; 2] {
    let kept = |axis: Axis| axis.count == 1 || axis.control().is_some_and(ControlQuantity::is_whole);
    let resized = |axis: Axis, count: f64| match kept(axis) {
        true => axis,
        false => Axis { count: (count.round() as u32).clamp(2, Axis::LARGEST), ..axis },
    };
    let (cells, columns) = (f64::from(cells), f64::from(x.count));
    let rows = if kept(x) { cells / columns } else { (cells * f64::from(y.count) / columns).sqrt() };
    let y = resized(y, rows);
    [resized(x, cells / f64::from(y.count)), y]
}

/// A plane and how long its cells run.
#[derive(Debug, Args)]
pub struct PlaneArgs {
    #[command(flatten)]
    axes: AxesArgs,

    /// Forcing periods before the observation
    ///
    /// Where the verdict is in doubt a cell goes on. Chaos may be transient: it runs up to 320 periods more. What is still
    /// undecided or neutral runs eight times as long and is observed four times as long: beside a Neimark-Sacker curve
    /// spirals are slow. What returns without having settled is held against the exact motion beside it.
    /// [default: 300]
    #[arg(long, value_parser = count, value_name = "P")]
    transient: Option<u32>,

    /// Forcing periods of the observation [default: 150]
    #[arg(long, value_parser = count, value_name = "P")]
    observe: Option<u32>,

    /// Largest N looked for in N-p-q [default: 32]; under control, most iterates in one period [default: 8]
    ///
    /// A motion with a longer period has none: it is quasi-periodic, chaotic or unresolved. Under control at most 32, on the GPU 8.
    #[arg(long, value_parser = count, value_name = "N")]
    pub max_period: Option<u32>,

    /// Every cell runs transient + observe periods, settled or not
    #[arg(long)]
    fixed_periods: bool,
}

impl PlaneArgs {
    /// The checked plane.
    pub fn plane(&self) -> Result<Plane, CliError> {
        self.axes.plane(self.schedule())
    }

    /// A plane that was computed before, with what is given in place of its own.
    pub fn again(&self, plane: &Plane) -> Result<Plane, CliError> {
        let own = plane.schedule;
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
        method: MethodName,
        settings: &MethodArgs,
        iterates: ControlSchedule,
    ) -> Result<ControlPlane, CliError> {
        let [x, y] = self.axes.axes()?;
        let axes = [("--x", x), ("--y", y)];
        let varied = axes.map(|(option, axis)| (format!("{option} {axis} varies"), axis.quantity));
        settings.refuse_replaced(method, &varied)?;
        for (option, axis) in axes {
            self.axes.system.check_beside(option, &axis.to_string(), axis.quantity)?;
        }
        let (system, set) = self.axes.system.split()?;
        let parameters = system.parameters(&axes)?;
        let first = [x, y].iter().fold(parameters, |setting, axis| match axis.quantity {
            Quantity::Parameter(parameter) => setting.with(parameter, axis.first),
            Quantity::Start(_) | Quantity::Control(_) => setting,
        });
        let plane = ControlPlane {
            x,
            y,
            parameters,
            start: self.axes.start.unwrap_or_else(|| default_start(&[x, y])),
            control: settings.scheme(method, &set, &first)?,
            iterates,
        };
        plane.check().map_err(CliError::input)?;
        Ok(plane)
    }

    /// The plane under control with as many cells as [`AxesArgs::plane_of`] gives it.
    pub fn resized(&self, plane: ControlPlane, cells: Option<u32>, default: u32) -> ControlPlane {
        let Some(cells) = self.axes.cells(cells, default) else { return plane };
        let [x, y] = with_cells([plane.x, plane.y], cells);
        ControlPlane { x, y, ..plane }
    }

    /// See [`AxesArgs::plane_of`].
    pub fn plane_of(&self, cells: Option<u32>, default: u32) -> Result<Plane, CliError> {
        self.axes.plane_of(self.schedule(), cells, default)
    }

    fn schedule(&self) -> Schedule {
        Schedule {
            transient: self.transient.unwrap_or(defaults::TRANSIENT),
            observe: self.observe.unwrap_or(defaults::OBSERVE),
            max_period: self.max_period.unwrap_or(defaults::MAX_PERIOD),
            fixed_periods: self.fixed_periods,
        }
    }
}

fn default_start(axes: &[Axis]) -> Start {
    let varied = axes.iter().any(|axis| matches!(axis.quantity, Quantity::Start(_)));
    if varied { Start::Rest } else { defaults::START }
}
