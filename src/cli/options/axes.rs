//! The axes of a plane, what is fixed on it, and how its cells begin.

use clap::Args;
use impact_atlas::analysis::Schedule;
use impact_atlas::figure::Steps;
use impact_atlas::plane::{Axis, Plane, Quantity, Start};

use super::system::SystemArgs;
use crate::cli::values::parse;
use crate::cli::{CliError, Result, defaults, wrong};

/// What the options of the axes take.
const AXIS: &str = "<NAME=FIRST:LAST:COUNT[:log]>";

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
    /// is left, and rest elsewhere. The plane is multistable: what a map shows depends on its start. Where an axis varies a
    /// component, the others are those of the state given, or 0. A cell whose start lies beyond a stop is `inadmissible start`.
    #[arg(long, value_name = "START", value_parser = parse::<Start>, allow_hyphen_values = true)]
    pub(super) start: Option<Start>,
}

impl AxesArgs {
    /// The checked plane whose cells run by `schedule`.
    pub fn plane(&self, schedule: Schedule) -> Result<Plane> {
        let [x, y] = self.axes()?;
        let plane = Plane {
            x,
            y,
            parameters: self.system.parameters(&[("--x", x), ("--y", y)])?,
            start: self.start.unwrap_or_else(|| default_start(&[x, y])),
            task: schedule,
        };
        plane.check().map_err(CliError::input)?;
        Ok(plane)
    }

    /// A plane that was computed before, with the axes, parameters and the start that are given in place of its own.
    pub(super) fn again(&self, plane: &Plane, schedule: Schedule) -> Result<Plane> {
        let system = self.system.of_family_of(plane)?;
        let axis = |option: &str, given: &Option<String>, own: Axis| match given {
            Some(text) => system.named(&format!("{option} {AXIS}"), text, Axis::of_family),
            None => Ok(own),
        };
        let (x, y) = (axis("--x", &self.x, plane.x)?, axis("--y", &self.y, plane.y)?);
        system.check_beside(&[("--x", x), ("--y", y)])?;
        let start = match self.start {
            Some(start) => start,
            None if plane.start == Start::Symmetric => default_start(&[x, y]),
            None => plane.start,
        };
        let parameters = system.assigned_to(plane.parameters)?;
        let plane = Plane { x, y, parameters, start, task: schedule };
        plane.check().map_err(CliError::input)?;
        Ok(plane)
    }

    /// The axes as given, or those of the system's default plane.
    pub(super) fn axes(&self) -> Result<[Axis; 2]> {
        let plane = self.system.family().plane.as_ref();
        let axis =
            |option: &str, given: &Option<String>, default: Option<&String>| match given.as_ref().or(default)
            {
                Some(text) => self.system.named(&format!("{option} {AXIS}"), text, Axis::of_family),
                None => Err(wrong!(
                    "the system {} has no default plane: give {option} NAME=FIRST:LAST:COUNT",
                    self.system.family().origin
                )),
            };
        Ok([
            axis("--x", &self.x, plane.map(|plane| &plane.x))?,
            axis("--y", &self.y, plane.map(|plane| &plane.y))?,
        ])
    }

    /// The plane with about `cells` cells; where there is no such number and no axis is given, with `default` ones.
    pub fn resized<T>(&self, plane: Plane<T>, cells: Option<u32>, default: u32) -> Plane<T> {
        let cells = cells.or((self.x.is_none() && self.y.is_none()).then_some(default));
        let Some(cells) = cells else { return plane };
        let [x, y] = with_cells([plane.x, plane.y], cells);
        Plane { x, y, ..plane }
    }
}

/// The same axes with about so many cells, in about the same proportion; one of one value, or of whole numbers, keeps
/// its values.
fn with_cells([x, y]: [Axis; 2], cells: u32) -> [Axis; 2] {
    let kept = |axis: Axis| axis.count == 1 || axis.control().is_some_and(|setting| setting.is_whole);
    let resized = |axis: Axis, count: f64| match kept(axis) {
        true => axis,
        false => {
            let count = (count.round() as u32).clamp(2, Axis::LARGEST);
            Axis { steps: Steps { count, ..axis.steps }, ..axis }
        }
    };
    let (cells, columns) = (f64::from(cells), f64::from(x.count));
    let rows = if kept(x) { cells / columns } else { (cells * f64::from(y.count) / columns).sqrt() };
    let y = resized(y, rows);
    [resized(x, cells / f64::from(y.count)), y]
}

pub(super) fn default_start(axes: &[Axis]) -> Start {
    let varied = axes.iter().any(|axis| matches!(axis.quantity, Quantity::Start(_)));
    if varied { Start::Rest } else { defaults::START }
}
