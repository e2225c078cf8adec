//! The plane to compute: two axes over fixed parameters, a start, and what is asked of every cell.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::axis::Axis;
use super::axis_error::AxisError;
use super::error::PlaneError;
use super::quantity::Quantity;
use super::some_cells::some_cells;
use super::start::Start;
use super::task::{Control, LARGEST_AT_ONCE, Task};
use super::written::{WrittenAxis, WrittenParameters, WrittenSystem, parameters, setting};
use crate::analysis::Schedule;
use crate::control::Scheme;
use crate::model::{Setting, StateVector};
use crate::system::Family;

/// Of so many columns and rows it is looked first whether any start lies between the stops …
const FEW_ALONG: u32 = 16;
/// … then of so many; of larger planes it is found out when they are computed.
const MOST_ALONG: u32 = 1024;

/// A plane of parameter pairs (or of start components, or of settings of a control method), cell by cell in rows of equal y,
/// of each of which the same is asked: a [`Task`], or nothing (`()`) where only the plane itself matters.
///
/// Together with the version, back end and adapter this is everything needed to compute a map again.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane<T = Schedule> {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis; its first value is the first row.
    pub y: Axis,
    /// The parameters that no axis varies (those of an axis are overridden cell by cell).
    pub parameters: Setting,
    /// How every cell begins; an axis over a start component overrides that component.
    pub start: Start,
    /// What is asked of every cell.
    pub task: T,
}

impl Plane {
    /// The largest number of cells whose results are held at once; more go into a store.
    pub const LARGEST_AT_ONCE: u64 = LARGEST_AT_ONCE;
}

impl Plane<Control> {
    /// The scheme of the cell in column `column` of row `row`.
    pub fn scheme_at(&self, column: u32, row: u32) -> Scheme {
        self.values_at(column, row).into_iter().fold(self.task.scheme, |scheme, (quantity, value)| {
            match quantity {
                Quantity::Control(setting) => scheme.with(setting, value).unwrap_or(scheme),
                Quantity::Parameter(_) | Quantity::Start(_) => scheme,
            }
        })
    }
}

impl<T: Task> Plane<T> {
    /// Checks that the plane can be computed: what [`Plane::check_ranges`] does, and that something begins on it.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    pub fn check(&self) -> Result<(), PlaneError> {
        self.check_ranges()?;
        self.check_starts()
    }

    /// Checks ranges, distinct axes, size, and what is asked.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    pub fn check_ranges(&self) -> Result<(), PlaneError> {
        if self.x.quantity == self.y.quantity {
            return Err(PlaneError::SameAxis(self.x.quantity.name()));
        }
        for axis in [&self.x, &self.y] {
            axis.check(self.parameters.family())?;
        }
        if self.cells() > T::LARGEST {
            return Err(PlaneError::TooLarge { x: self.x.count, y: self.y.count, most: T::LARGEST });
        }
        self.task.check([&self.x, &self.y])?;
        self.parameters.check()?;
        if self.start == Start::Symmetric && self.varies_start() {
            return Err(PlaneError::SymmetricStartVaried);
        }
        Ok(self.start.fits(self.parameters.family())?)
    }
}

impl<T> Plane<T> {
    /// A plane of the paper's oscillator over two axes, NAME=FIRST:LAST:COUNT; the parameters that they leave are the paper's.
    ///
    /// # Errors
    /// What is wrong with an axis.
    pub fn of_paper(x: &str, y: &str, start: Start, task: T) -> Result<Self, AxisError> {
        let parameters = Setting::defaults(Family::paper());
        Ok(Plane { x: x.parse()?, y: y.parse()?, parameters, start, task })
    }

    /// The same plane, of whose cells something else is asked.
    pub fn asking<U>(&self, task: U) -> Plane<U> {
        let Plane { x, y, parameters, start, .. } = *self;
        Plane { x, y, parameters, start, task }
    }

    fn varies_start(&self) -> bool {
        [&self.x, &self.y].iter().any(|axis| matches!(axis.quantity, Quantity::Start(_)))
    }

    fn check_starts(&self) -> Result<(), PlaneError> {
        let Start::State(_) = self.start_at(0, 0) else { return Ok(()) };
        // Cells that begin beyond a stop are inadmissible; a plane of nothing else is a mistake.
        let varies_plant =
            [&self.x, &self.y].iter().any(|axis| matches!(axis.quantity, Quantity::Parameter(_)));
        let same = if varies_plant { None } else { self.parameters.plant().ok() };
        let begins = |(column, row): (u32, u32)| match &same {
            Some(plant) => self.start_at(column, row).begins(plant),
            None => {
                let plant = self.parameters_at(column, row).plant();
                plant.map_or(true, |plant| self.start_at(column, row).begins(&plant))
            }
        };
        let some = |along: u32| some_cells(0..self.x.count, 0..self.y.count, along);
        if some(FEW_ALONG).chain(some(MOST_ALONG)).any(begins) || self.x.count.max(self.y.count) > MOST_ALONG
        {
            return Ok(());
        }
        let Ok(plant) = self.parameters_at(0, 0).plant() else { return Ok(()) };
        self.start_at(0, 0).check(&plant, self.parameters.family()).map_err(PlaneError::Nowhere)
    }

    /// The cells on its border; corners come twice.
    pub(crate) fn border(&self) -> impl Iterator<Item = (u32, u32)> + use<T> {
        let (columns, rows) = (self.x.count, self.y.count);
        let horizontal = (0..columns).flat_map(move |column| [(column, 0), (column, rows - 1)]);
        horizontal.chain((0..rows).flat_map(move |row| [(0, row), (columns - 1, row)]))
    }

    /// Whether the system in the middle of the plane has a mirror.
    pub fn has_mirror(&self) -> bool {
        self.parameters_at(self.x.count / 2, self.y.count / 2).has_mirror()
    }

    /// How many cells the plane has.
    pub fn cells(&self) -> u64 {
        u64::from(self.x.count) * u64::from(self.y.count)
    }

    /// What the axes vary, with its values in the cell in column `column` of row `row`.
    fn values_at(&self, column: u32, row: u32) -> [(Quantity, f64); 2] {
        [(self.x.quantity, self.x.value(column)), (self.y.quantity, self.y.value(row))]
    }

    /// The parameters of the cell in column `column` of row `row`.
    pub fn parameters_at(&self, column: u32, row: u32) -> Setting {
        let mut parameters = self.parameters;
        self.put_parameters(column, row, &mut parameters);
        parameters
    }

    /// Puts the parameters of the cell in column `column` of row `row` in the place of others of the plane.
    pub(crate) fn put_parameters(&self, column: u32, row: u32, parameters: &mut Setting) {
        for (quantity, value) in self.values_at(column, row) {
            if let Quantity::Parameter(parameter) = quantity {
                parameters.set(parameter, value);
            }
        }
    }

    /// The start of the cell in column `column` of row `row`.
    pub fn start_at(&self, column: u32, row: u32) -> Start {
        let mut start = self.start;
        for (quantity, value) in self.values_at(column, row) {
            if let Quantity::Start(component) = quantity {
                let n = self.parameters.family().n();
                let mut state = if let Start::State(state) = start { state } else { StateVector::zeros(n) };
                state[component.index()] = value;
                start = Start::State(state);
            }
        }
        start
    }
}

/// A plane as files carry it, with what is asked under names of its own.
#[derive(Serialize, Deserialize)]
struct Written<W> {
    x: WrittenAxis,
    y: WrittenAxis,
    #[serde(default)]
    system: Option<WrittenSystem>,
    parameters: WrittenParameters,
    start: Start,
    #[serde(flatten)]
    task: W,
}

impl<T: Task> Serialize for Plane<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let written = Written {
            x: WrittenAxis::of(&self.x),
            y: WrittenAxis::of(&self.y),
            system: Some(WrittenSystem::of(self.parameters.family())),
            parameters: parameters(&self.parameters),
            start: self.start,
            task: self.task.written(),
        };
        written.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Plane {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Followed {
            schedule: Schedule,
        }
        let written = Written::<Followed>::deserialize(deserializer)?;
        let read = || -> Result<Plane, String> {
            let family = WrittenSystem::read(written.system.as_ref())?;
            Ok(Plane {
                x: written.x.read(family)?,
                y: written.y.read(family)?,
                parameters: setting(family, &written.parameters)?,
                start: written.start,
                task: written.task.schedule,
            })
        };
        read().map_err(serde::de::Error::custom)
    }
}
