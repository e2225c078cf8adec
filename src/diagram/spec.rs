//! The bifurcation diagram to compute: an axis, how its columns begin, and what is read where.

use super::error::{DiagramError, MOST_READINGS};
use super::sweep::{Direction, Sweep};
use super::unit::ExponentUnit;
use crate::analysis::{Probe, Schedule};
use crate::model::{Setting, StateVector};
use crate::plane::{Axis, Component, Quantity, Start, StartError};

/// A bifurcation diagram to compute.
///
/// Together with the version, back end and adapter this is everything needed to compute it again.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramSpec {
    /// The horizontal axis: a parameter, or a component of the start.
    pub x: Axis,
    /// The parameters that the axis does not vary.
    pub parameters: Setting,
    /// How columns begin.
    pub sweep: Sweep,
    /// How the first column of a carried sweep begins.
    pub start: Start,
    /// What is read where.
    pub probe: Probe,
    /// Forcing periods before and while the section is read; never cut short.
    pub schedule: Schedule,
    /// The most readings that are kept of one column.
    pub capacity: u32,
    /// The unit of the Lyapunov spectrum, if that is computed as well.
    pub spectrum: Option<ExponentUnit>,
}

impl DiagramSpec {
    /// The most readings that a diagram may have to hold.
    pub const LARGEST: u64 = MOST_READINGS;

    /// A schedule that is never cut short, so that early settling does not change what is drawn.
    pub fn schedule(transient: u32, observe: u32, max_period: u32) -> Schedule {
        Schedule { transient, observe, max_period, fixed_periods: true }
    }

    /// Checks that every column can be computed.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    pub fn check(&self) -> Result<(), DiagramError> {
        self.x.check(self.parameters.family())?;
        self.schedule.check()?;
        if !self.probe.fits(self.parameters.family()) {
            return Err(DiagramError::Probe(&self.parameters.family().name));
        }
        let branches = self.sweep.branches().len() as u64;
        let readings = branches * u64::from(self.x.count) * u64::from(self.capacity);
        if self.capacity == 0 || readings > Self::LARGEST {
            return Err(DiagramError::Capacity { columns: self.x.count, capacity: self.capacity });
        }
        self.parameters.check()?;
        if let Quantity::Control(setting) = self.x.quantity {
            return Err(DiagramError::Control(setting.name));
        }
        let varies_start = matches!(self.x.quantity, Quantity::Start(_));
        if varies_start && self.sweep.is_carried() {
            return Err(DiagramError::CarriedStart {
                axis: self.x.to_string(),
                sweep: self.sweep.to_string(),
            });
        }
        if varies_start && self.sweep == Sweep::Each(Start::Symmetric) {
            return Err(DiagramError::SymmetricStartVaried);
        }
        self.start_at(0).fits(self.parameters.family())?;
        if self.sweep.is_carried() { self.check_first_columns() } else { self.check_starts() }
    }

    /// Checks that the columns that carried sweeps begin with begin between their stops.
    fn check_first_columns(&self) -> Result<(), DiagramError> {
        for &direction in self.sweep.branches() {
            let column = self.x.order(direction == Direction::Down)[0];
            let (axis, value) = (self.x.quantity.name(), self.x.value(column));
            self.check_start(column).map_err(|why| DiagramError::Beyond {
                direction: direction.name(),
                axis,
                value,
                why,
            })?;
        }
        Ok(())
    }

    /// Checks that some column begins between its stops: others are inadmissible.
    fn check_starts(&self) -> Result<(), DiagramError> {
        let first = self.check_start(0);
        if first.is_ok() || (1..self.x.count).any(|column| self.check_start(column).is_ok()) {
            return Ok(());
        }
        first.map_err(DiagramError::Nowhere)
    }

    fn check_start(&self, column: u32) -> Result<(), StartError> {
        let Ok(plant) = self.parameters_at(column).plant() else { return Ok(()) };
        self.start_at(column).check(&plant, self.parameters.family())
    }

    /// The parameters of a column.
    pub fn parameters_at(&self, column: u32) -> Setting {
        match self.x.quantity {
            Quantity::Parameter(parameter) => self.parameters.with(parameter, self.x.value(column)),
            Quantity::Start(_) | Quantity::Control(_) => self.parameters,
        }
    }

    /// The start of a column that begins by itself.
    pub fn start_at(&self, column: u32) -> Start {
        let start = match self.sweep {
            Sweep::Each(start) => start,
            Sweep::Down | Sweep::Up | Sweep::Both => self.start,
        };
        match self.x.quantity {
            Quantity::Parameter(_) | Quantity::Control(_) => start,
            Quantity::Start(component) => {
                start_with(start, component, self.x.value(column), self.parameters.family().n())
            }
        }
    }
}

fn start_with(start: Start, component: Component, value: f64, coordinates: usize) -> Start {
    let mut state = if let Start::State(state) = start { state } else { StateVector::zeros(coordinates) };
    state[component.index()] = value;
    Start::State(state)
}
