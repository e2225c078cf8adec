//! A system: a plant at one place of its parameters, with the steps in which it is followed.

use std::any::Any;
use std::sync::Arc;

use nalgebra::DVector;

use super::common::{Common, LabelOrder};
use super::equations::stretch;
use super::of_flow::OfFlow;
use super::parameters::Parameters;
use super::restopped::Restopped;
use super::system_error::{MOST_STEPS, SystemError};
use crate::system::{Family, Mirror, Plant, Setting, StopParameters, StopValues};

/// A system whose parameters are in their physical range, ready to be followed.
///
/// Any μm, μk, μc and ζ are covered: proportional or not, under- or overdamped, no modes are formed.
/// Everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    pub(super) plant: Restopped,
    /// What its setting has of its own.
    pub(super) own: StopParameters,
}

impl System {
    /// The most steps of one forcing period that are accepted.
    pub const MOST_STEPS: u32 = MOST_STEPS;

    /// A system with checked parameters; it is held where it may drift, see [`System::moored`].
    ///
    /// # Errors
    /// The first parameter that is out of its range, what the family cannot make of the values, and
    /// [`SystemError::TooStiff`] where ω is so slow, or the damping so strong, that one forcing period holds more than
    /// [`System::MOST_STEPS`] steps of the fastest motion.
    pub fn new(setting: impl Into<Setting>) -> Result<Self, SystemError> {
        let setting = setting.into();
        let plant = setting.plant()?;
        let label_order = setting.family().label_order().iter().copied().collect();
        System::divided(Some(setting), plant, label_order)?.moored()
    }

    /// The system of a plant. Where that may drift, so does it: see [`System::moored`].
    ///
    /// # Errors
    /// What is wrong with the plant, and [`SystemError::TooStiff`] where one forcing period holds too many steps of the
    /// fastest motion.
    pub fn of_plant(plant: Plant) -> Result<Self, SystemError> {
        plant.check()?;
        let label_order = (0..plant.stops.len()).collect();
        System::divided(None, plant, label_order)
    }

    /// The system of a setting of the same family with the same flow: its plant differs from this one's in gaps and
    /// restitutions alone. None where all of the plant has to be looked at.
    pub(super) fn restopped(&self, setting: &Setting) -> Option<Self> {
        let plant = self.plant.with_stops(setting.stop_values()?);
        Some(System { plant, own: setting.stop_parameters() })
    }

    /// The system of a setting that has its flow in common with this one, which is that of its own setting: the same as
    /// [`Flows::system`](super::Flows::system) has it, if it is known at once to be.
    pub(crate) fn neighbour(&self, setting: &Setting) -> Option<Self> {
        if !self.common().like.as_ref()?.has_flow_of(setting) {
            return None;
        }
        let found = self.restopped(setting)?;
        if found.mirrored_stops() != self.mirrored_stops() {
            return None;
        }
        self.of_flow().share();
        Some(found)
    }

    /// The system of another plant with the same stops, its labels in the same order.
    ///
    /// # Errors
    /// As [`System::of_plant`].
    pub fn with_plant(&self, plant: Plant) -> Result<Self, SystemError> {
        System::of_plant(plant).map(|system| system.ordered(self.common().label_order.clone()))
    }

    /// The same system with another order in which labels count the impacts at its stops, each of them once.
    ///
    /// # Panics
    /// If a stop is missing or named twice.
    #[must_use]
    pub fn labelled(self, label_order: Vec<usize>) -> Self {
        let mut sorted = label_order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..self.stops().len()), "each stop once: {label_order:?}");
        self.ordered(label_order.into_iter().collect())
    }

    pub(super) fn ordered(mut self, label_order: LabelOrder) -> Self {
        self.common_mut().label_order = label_order;
        self
    }

    /// A system whose forcing period is cut into steps short enough for the fastest motion.
    fn divided(setting: Option<Setting>, plant: Plant, label_order: LabelOrder) -> Result<Self, SystemError> {
        let own = setting.map(|setting| setting.stop_parameters()).unwrap_or_default();
        Ok(System { plant: Restopped::new(Common::of(setting, plant, label_order)?), own })
    }

    /// The system of another plant that is known to be sound, with the same setting and its labels in the same order.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where one forcing period would hold too many steps.
    pub(super) fn with_sound_plant(&self, plant: Plant) -> Result<Self, SystemError> {
        System::divided(self.setting(), plant, self.common().label_order.clone())
    }

    /// The same system with another plant, as fast as its own and with the same stops.
    pub(super) fn changed(self, change: impl Fn(&mut Plant)) -> Self {
        let mut plant = self.plant().clone();
        change(&mut plant);
        let &Common { like, ref adrift, ref label_order, ref lengths, normals, rate, steps, .. } =
            self.common();
        let (mut adrift, label_order, lengths) = (adrift.clone(), label_order.clone(), lengths.clone());
        if let Some(adrift) = &mut adrift {
            change(Arc::make_mut(&mut adrift.plant));
        }
        let of_flow = Arc::default();
        let common = Common { like, plant, adrift, label_order, lengths, normals, rate, steps, of_flow };
        System { plant: Restopped::new(common), ..self }
    }

    /// The stops in the order in which labels count their impacts: the family's, or that of the plant.
    pub fn label_order(&self) -> &[usize] {
        &self.common().label_order
    }

    /// The same system, which shares nothing with others.
    #[must_use]
    pub(crate) fn alone(mut self) -> Self {
        let of_flow = &mut self.common_mut().of_flow;
        match Arc::get_mut(of_flow) {
            Some(own) => *own = OfFlow::default(),
            None => *of_flow = Arc::default(),
        }
        self
    }

    /// The same system, which has with others in common what follows from its flow.
    #[must_use]
    pub(super) fn sharing(mut self, of_flow: &Arc<OfFlow>) -> Self {
        of_flow.share();
        self.common_mut().of_flow = Arc::clone(of_flow);
        self
    }

    pub(super) fn common(&self) -> &Common {
        &self.plant.common
    }

    /// The same, which others do not have then.
    fn common_mut(&mut self) -> &mut Common {
        Arc::make_mut(&mut self.plant.common)
    }

    /// The setting that the system was made from; none where it was made from a plant.
    pub fn setting(&self) -> Option<Setting> {
        self.common().like.map(|like| like.with_stop_parameters(&self.own))
    }

    /// The family of that setting.
    pub fn family(&self) -> Option<&'static Family> {
        self.common().like.as_ref().map(Setting::family)
    }

    /// Whether it is the paper's oscillator, of which the exact theory speaks.
    pub fn is_paper(&self) -> bool {
        self.family().is_some_and(Family::is_paper)
    }

    /// The parameters of the paper's oscillator.
    ///
    /// # Panics
    /// If it is another system.
    pub fn parameters(&self) -> Parameters {
        self.setting().as_ref().and_then(Parameters::of).expect("the system is the paper's oscillator")
    }

    /// The numbers of its equations of motion.
    pub fn plant(&self) -> &Plant {
        self.plant.plant()
    }

    /// A plant with the same flow: its gaps and restitutions may be those of another cell. It is there already, as
    /// [`System::plant`] may not be.
    pub(crate) fn like(&self) -> &Plant {
        self.plant.like()
    }

    /// How many coordinates it has.
    pub fn coordinates(&self) -> usize {
        self.like().n
    }

    /// The gaps and restitutions of its stops, in the plant's order.
    pub(super) fn stop_values(&self) -> &[StopValues] {
        self.plant.stops()
    }

    /// The length of a stop's direction along a parallel one in units of that, with its sign.
    pub(super) fn stretch(&self, stop: usize, line: usize) -> f64 {
        let [own, line] = [stop, line].map(|i| self.like().stops[i].direction.as_slice());
        stretch(own, line)
    }

    /// Its stops in the plant's order, each with its direction.
    pub(crate) fn stops(&self) -> impl ExactSizeIterator<Item = (&DVector<f64>, StopValues)> {
        let directions = self.like().stops.iter().map(|stop| &stop.direction);
        directions.zip(self.plant.stops().iter().copied())
    }

    /// The mirror P, P² = 1, under which the system half a forcing period later is itself, if there is one.
    pub fn mirror(&self) -> Option<&Mirror> {
        self.of_flow().mirror(|| self.plant().mirror())
    }

    /// What follows from its flow alone.
    pub(crate) fn of_flow(&self) -> &Arc<OfFlow> {
        &self.common().of_flow
    }

    /// What follows from its flow and its coefficients of restitution, whatever its gaps: found once for all systems that
    /// share the flow.
    pub(crate) fn whatever_gaps<C: Any + Send + Sync>(&self, compute: impl FnOnce() -> C) -> Arc<C> {
        let stops = self.plant.stops();
        let bits = |i: usize| stops.get(i).map_or(0, |stop| stop.restitution.to_bits());
        self.of_flow().of_restitutions(std::array::from_fn(bits), compute)
    }

    /// [`Common::alike`] of its own stops. Systems with the same flow and the same bits have the same mirror.
    pub(super) fn mirrored_stops(&self) -> u64 {
        self.plant.alike
    }

    /// The forcing period T = 2π/ω, non-dimensional.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.like().omega
    }

    /// The fastest rate of the flow: ω, or ‖A⁸‖^(1/8) of the unforced generator A, which lies just above the
    /// modulus of its largest eigenvalue. Taylor terms of a flight of length s shrink like (rate·s)ᵏ/k!.
    pub fn rate(&self) -> f64 {
        self.common().rate
    }

    /// M, the steps in one forcing period: even, so that phases 0 and π fall on steps.
    pub fn steps(&self) -> u32 {
        self.common().steps
    }
}
