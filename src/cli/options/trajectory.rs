//! The trajectory that a command follows: of a system from a start, or that of a cell of a map.

use std::path::{Path, PathBuf};

use clap::Args;
use impact_atlas::model::{StateVector, System};
use impact_atlas::plane::{Made, Start};

use super::system::{SystemArgs, begun};
use crate::cli::cell::{Cell, Place, made};
use crate::cli::values::parse;
use crate::cli::{Result, note};

/// The system and its start, or a cell of a map that has both.
#[derive(Clone, Debug, Args)]
pub struct TrajectoryArgs {
    #[command(flatten)]
    system: SystemArgs,

    /// Follows a cell of this map, its system from its start: a picture or the data that `map` wrote
    #[arg(long, value_name = "FILE", requires = "at", conflicts_with_all = ["family", "assignments", "start"])]
    from: Option<PathBuf>,

    /// Where on the map: the cell that holds these values of its axes
    #[arg(long, value_name = "NAME=VALUE,NAME=VALUE", value_parser = parse::<Place>, requires = "from")]
    at: Option<Place>,

    /// How the trajectory begins: rest, symmetric, or a state X1,X2,V1,V2 (x1 … xn, v1 … vn) at forcing phase 0 [default: rest;
    /// of `classify`, as of `map`, symmetric]
    ///
    /// `symmetric` is the stable-branch 1-1-1 motion where there is one, nudged so that an unstable one is left, and rest
    /// elsewhere. A system may have several motions: which one is reached depends on the start.
    #[arg(long, value_name = "START", value_parser = parse::<Start>, allow_hyphen_values = true)]
    start: Option<Start>,
}

/// A trajectory that is asked for.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// The options of its system, by whose words other options are named.
    pub options: SystemArgs,
    /// The system.
    pub system: System,
    /// How it begins.
    pub start: Start,
    /// The state that this means.
    pub state: StateVector,
    /// The map it is from, and its cell there.
    pub of_map: Option<(Made, Cell)>,
}

impl TrajectoryArgs {
    /// The trajectory; it begins by `default` where nothing else is given.
    pub fn trajectory(&self, default: Start) -> Result<Trajectory> {
        if let (Some(from), Some(at)) = (&self.from, &self.at) {
            return of_map(from, at);
        }
        let (options, start) = (self.system.clone(), self.start.unwrap_or(default));
        let (system, state) = options.system_and_start(start)?;
        Ok(Trajectory { options, system, start, state, of_map: None })
    }
}

/// That of a cell of a map that was computed before.
fn of_map(from: &Path, at: &Place) -> Result<Trajectory> {
    let made = made(from)?;
    let cell = Cell::holding(at, &made.plane)?;
    let Cell { column, row, .. } = cell;
    let (x, y) = (made.plane.x.quantity.name(), made.plane.y.quantity.name());
    note(&format!("column {column}, row {row} of `{}`: {x} = {}, {y} = {}", from.display(), cell.x, cell.y));
    let start = made.plane.start_at(column, row);
    let elsewhere = "no motion begins in this cell: choose another by --at";
    let (system, state) = begun(made.plane.parameters_at(column, row), start, elsewhere)?;
    let options = SystemArgs::of_family(made.plane.parameters.family());
    Ok(Trajectory { options, system, start, state, of_map: Some((made, cell)) })
}
