//! A family of plants: a file with named parameters and expressions in them.

use nalgebra::{DMatrix, DVector};

use super::block::Block;
use super::error::{CellError, CellFault, CellProblem};
use super::parameter::{Parameter, ParameterError, ParameterId, named};
use super::plant::Plant;
use super::plant_error::{Part, PlantError};
use super::stop_place::StopPlace;
use super::stops::PlantStop;

/// A linear oscillator with rigid stops whose numbers are expressions in named parameters, as its file gives it.
#[derive(Clone, Debug)]
pub struct Family {
    /// What the family is called in titles.
    pub name: String,
    /// Where the system is from, where the file says so.
    pub source: Option<String>,
    /// The file that the family was read from, or the name of a built-in one.
    pub origin: String,
    /// The file, as it was read.
    pub text: String,
    /// The SHA-256 of the text, 64 hexadecimal digits.
    pub hash: String,
    /// The parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    pub(super) equations: Equations,
    pub(super) stops: Vec<FamilyStop>,
    pub(super) label_order: Vec<usize>,
    /// The parameters on which more depends than gaps and restitutions.
    pub(super) of_flow: Vec<ParameterId>,
    /// The others.
    pub(super) of_stops: Vec<ParameterId>,
    /// The axes of a map where none are given.
    pub plane: Option<DefaultPlane>,
}

/// The expressions of the equations of motion.
#[derive(Clone, Debug)]
pub(super) struct Equations {
    pub n: usize,
    pub frequency: Block,
    pub mass: Block,
    pub damping: Block,
    pub stiffness: Block,
    pub force_sin: Block,
    pub force_cos: Block,
    pub load: Block,
}

/// A stop of a family.
#[derive(Clone, Debug)]
pub struct FamilyStop {
    /// The name in results.
    pub name: String,
    /// Another name by which it can be asked for, where the first is hard to type.
    pub alias: Option<String>,
    pub(super) direction: Block,
    pub(super) gap: Block,
    pub(super) restitution: Block,
}

/// The axes of a map where none are given, each `NAME=FIRST:LAST:COUNT`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DefaultPlane {
    /// The horizontal axis.
    pub x: String,
    /// The vertical axis.
    pub y: String,
}

impl FamilyStop {
    /// The name that is easy to type: the alias where there is one.
    pub fn plain_name(&self) -> &str {
        self.alias.as_deref().unwrap_or(&self.name)
    }
}

impl Family {
    /// The coordinates, 1 to [`Plant::MOST_COORDINATES`].
    pub fn n(&self) -> usize {
        self.equations.n
    }

    /// Every parameter, in the order of the file.
    pub fn ids(&self) -> impl Iterator<Item = ParameterId> + use<> {
        (0..self.parameters.len()).map(ParameterId)
    }

    /// The parameter of a name.
    pub fn parameter(&self, name: &str) -> Option<ParameterId> {
        self.parameters.iter().position(|parameter| parameter.name == name).map(ParameterId)
    }

    /// The parameter of a name that someone wrote.
    ///
    /// # Errors
    /// [`ParameterError::Unknown`] with the parameters that there are.
    pub fn find(&self, name: &str) -> Result<ParameterId, ParameterError> {
        let known = || self.parameters.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
        self.parameter(name).ok_or_else(|| ParameterError::Unknown { name: name.to_owned(), known: known() })
    }

    /// What the file says about a parameter.
    ///
    /// # Panics
    /// Where the parameter is of another family, of more parameters.
    pub fn about(&self, id: ParameterId) -> &Parameter {
        &self.parameters[id.0]
    }

    /// The stops, in the order of the file, which is that of [`Plant::stops`].
    pub fn stops(&self) -> &[FamilyStop] {
        &self.stops
    }

    /// Where a stop stands in the order of the file, given its name or its alias.
    pub fn stop(&self, name: &str) -> Option<usize> {
        self.stops.iter().position(|stop| stop.name == name || stop.alias.as_deref() == Some(name))
    }

    /// The same, or where no stop has the name exactly, the only one that has it but for the case of its letters.
    pub fn stop_like(&self, name: &str) -> Option<usize> {
        let lower = name.to_lowercase();
        let alike = |stop: &FamilyStop| {
            stop.name.to_lowercase() == lower || stop.plain_name().to_lowercase() == lower
        };
        let all: Vec<usize> = (0..self.stops.len()).filter(|&i| alike(&self.stops[i])).collect();
        self.stop(name).or(if let [only] = all[..] { Some(only) } else { None })
    }

    /// Where a stop stands, by its place in the order of the file.
    ///
    /// # Panics
    /// If the family has no such stop.
    pub fn stop_place(&self, stop: usize) -> StopPlace {
        let FamilyStop { direction, gap, .. } = &self.stops[stop];
        StopPlace::of(direction.texts(), gap.texts().next().unwrap_or("0"))
    }

    /// The stops in the order in which labels count their impacts.
    pub fn label_order(&self) -> &[usize] {
        &self.label_order
    }

    /// The default value of every parameter.
    pub fn defaults(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.default).collect()
    }

    /// Checks every value against its parameter's range.
    ///
    /// # Errors
    /// The first parameter that is out of range, with its value.
    ///
    /// # Panics
    /// Where the values are not this family's.
    pub fn check(&self, values: &[f64]) -> Result<(), ParameterError> {
        assert_eq!(values.len(), self.parameters.len(), "the values are of another family");
        self.parameters.iter().zip(values).try_for_each(|(parameter, &value)| parameter.check(value))
    }

    /// The plant of one cell, checked.
    ///
    /// # Errors
    /// The first parameter out of its range; the first expression without a value; whatever [`Plant::check`] refuses;
    /// with the place in the file and the values at fault.
    ///
    /// # Panics
    /// Where the values are not this family's.
    pub fn plant(&self, values: &[f64]) -> Result<Plant, CellError> {
        self.check(values)?;
        Ok(self.assemble(values)?)
    }

    /// The plant of one cell whose values are within their ranges.
    pub(super) fn assemble(&self, values: &[f64]) -> Result<Plant, Box<CellFault>> {
        let n = self.n();
        let put = |block: &Block, places: &mut [f64]| block.evaluate(&self.parameters, values, places);
        let scalar = |block: &Block| {
            let mut number = [0.0];
            put(block, &mut number).map(|()| number[0])
        };
        let vector = |block: &Block| {
            let mut vector = DVector::zeros(n);
            put(block, vector.as_mut_slice()).map(|()| vector)
        };
        let matrix = |block: &Block| {
            let mut matrix = DMatrix::zeros(n, n);
            put(block, matrix.as_mut_slice())?;
            // The file goes row by row.
            matrix.transpose_mut();
            Ok::<_, Box<CellFault>>(matrix)
        };
        let stop = |stop: &FamilyStop| {
            Ok(PlantStop {
                direction: vector(&stop.direction)?,
                gap: scalar(&stop.gap)?,
                restitution: scalar(&stop.restitution)?,
            })
        };
        let Equations { frequency, mass, damping, stiffness, force_sin, force_cos, load, .. } =
            &self.equations;
        let plant = Plant {
            n,
            mass: matrix(mass)?,
            damping: matrix(damping)?,
            stiffness: matrix(stiffness)?,
            force_sin: vector(force_sin)?,
            force_cos: vector(force_cos)?,
            load: vector(load)?,
            omega: scalar(frequency)?,
            stops: self.stops.iter().map(stop).collect::<Result<_, Box<CellFault>>>()?,
        };
        plant.check().map_err(|error| self.blame(error, values))?;
        Ok(plant)
    }

    fn block(&self, part: Part) -> &Block {
        match part {
            Part::Frequency => &self.equations.frequency,
            Part::Mass => &self.equations.mass,
            Part::Damping => &self.equations.damping,
            Part::Stiffness => &self.equations.stiffness,
            Part::ForceSin => &self.equations.force_sin,
            Part::ForceCos => &self.equations.force_cos,
            Part::Load => &self.equations.load,
            Part::Direction(stop) => &self.stops[stop].direction,
            Part::Gap(stop) => &self.stops[stop].gap,
            Part::Restitution(stop) => &self.stops[stop].restitution,
        }
    }

    /// Every expression of the file.
    pub(super) fn blocks(&self) -> impl Iterator<Item = &Block> {
        let parts = [
            Part::Frequency,
            Part::Mass,
            Part::Damping,
            Part::Stiffness,
            Part::ForceSin,
            Part::ForceCos,
            Part::Load,
        ];
        let stops = (0..self.stops.len())
            .flat_map(|stop| [Part::Direction(stop), Part::Gap(stop), Part::Restitution(stop)]);
        parts.into_iter().chain(stops).map(|part| self.block(part))
    }

    /// Finds a refused plant's expressions in the file.
    fn blame(&self, error: PlantError, values: &[f64]) -> Box<CellFault> {
        let parts = error.parts();
        let first = parts.first().copied().unwrap_or(Part::Mass);
        let values = named(&self.parameters, parts.iter().flat_map(|&part| self.block(part).uses()), values);
        let place = self.block(first).place.clone();
        Box::new(CellFault { place, problem: CellProblem::Plant(error), values })
    }
}
