//! A system: a plant at one place of its parameters, with the steps in which it is followed.

use std::any::Any;
use std::sync::Arc;

use super::of_flow::OfFlow;
use super::parameters::Parameters;
use super::system_error::{MOST_STEPS, Stiff, SystemError};
use crate::system::{Mirror, Plant, Setting};

/// A system whose parameters are in their physical range, ready to be followed.
///
/// Any μm, μk, μc and ζ are covered: proportional or not, under- or overdamped, no modes are formed.
/// Everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// The setting it was made from, if it was made from one.
    setting: Option<Setting>,
    plant: Plant,
    label_order: Vec<usize>,
    rate: f64,
    steps: u32,
    pub(super) of_flow: Kept,
}

/// What follows from a plant, found when it is first asked for: equal plants have equal ones.
#[derive(Clone, Debug, Default)]
pub(super) struct Kept(pub(super) Arc<OfFlow>);

impl PartialEq for Kept {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl System {
    /// rate·h is kept below this: large enough for few steps, small enough for low orders.
    pub(crate) const STEP: f64 = 1.0;
    /// The most steps of one forcing period that are accepted.
    pub const MOST_STEPS: u32 = MOST_STEPS;

    /// A system with checked parameters.
    ///
    /// # Errors
    /// The first parameter that is out of its range, what the family cannot make of the values, and
    /// [`SystemError::TooStiff`] where ω is so slow, or the damping so strong, that one forcing period holds more than
    /// [`System::MOST_STEPS`] steps of the fastest motion.
    pub fn new(setting: impl Into<Setting>) -> Result<Self, SystemError> {
        let setting = setting.into();
        let plant = setting.plant()?;
        let rate = rate(&plant);
        let label_order = setting.family().label_order().to_vec();
        let mut system =
            System { setting: Some(setting), plant, label_order, rate, steps: 0, of_flow: Kept::default() };
        system.divide()?;
        Ok(system)
    }

    /// The system of a plant.
    ///
    /// # Errors
    /// What is wrong with the plant, and [`SystemError::TooStiff`] where one forcing period holds too many steps of the
    /// fastest motion.
    pub fn of_plant(plant: Plant) -> Result<Self, SystemError> {
        plant.check()?;
        let rate = rate(&plant);
        let label_order = (0..plant.stops.len()).collect();
        let mut system =
            System { setting: None, plant, label_order, rate, steps: 0, of_flow: Kept::default() };
        system.divide()?;
        Ok(system)
    }

    /// The system of a setting of the same family with the same flow: its plant differs from this one's in gaps and
    /// restitutions alone. None where all of the plant has to be looked at.
    pub(super) fn restopped(&self, setting: Setting) -> Option<Self> {
        let plant = setting.restopped(&self.plant)?;
        let label_order = self.label_order.clone();
        let of_flow = Kept(Arc::clone(&self.of_flow.0));
        Some(System { setting: Some(setting), plant, label_order, of_flow, ..*self })
    }

    /// The system of another plant with the same stops, its labels in the same order.
    ///
    /// # Errors
    /// As [`System::of_plant`].
    pub fn with_plant(&self, plant: Plant) -> Result<Self, SystemError> {
        let label_order = self.label_order.clone();
        System::of_plant(plant).map(|system| System { label_order, ..system })
    }

    /// The same system with another order in which labels count the impacts at its stops, each of them once.
    ///
    /// # Panics
    /// If a stop is missing or named twice.
    #[must_use]
    pub fn labelled(self, label_order: Vec<usize>) -> Self {
        let mut sorted = label_order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..self.plant.stops.len()), "each stop once: {label_order:?}");
        System { label_order, ..self }
    }

    /// Cuts the forcing period into steps short enough for the fastest motion.
    fn divide(&mut self) -> Result<(), SystemError> {
        let half_steps = (0.5 * self.rate * self.period() / Self::STEP).ceil();
        if half_steps.is_nan() || half_steps > f64::from(Self::MOST_STEPS / 2) {
            return Err(SystemError::TooStiff(Box::new(Stiff {
                setting: self.setting,
                omega: self.plant.omega,
                rate: self.rate,
            })));
        }
        self.steps = 2 * half_steps as u32;
        Ok(())
    }

    /// The system of another plant that is known to be sound, with the same setting and its labels in the same order.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where one forcing period would hold too many steps.
    pub(super) fn with_sound_plant(&self, plant: Plant) -> Result<Self, SystemError> {
        let (rate, label_order, of_flow) = (rate(&plant), self.label_order.clone(), Kept::default());
        let mut system = System { plant, rate, label_order, of_flow, ..*self };
        system.divide()?;
        Ok(system)
    }

    /// The same system forced at another frequency ω: its setting's omega, where it was made from one that has it.
    ///
    /// # Errors
    /// As [`System::new`] and [`System::of_plant`].
    pub fn at_frequency(&self, omega: f64) -> Result<Self, SystemError> {
        match self.setting.filter(|setting| setting.named("omega").is_some()) {
            Some(setting) => System::new(setting.with_named("omega", omega)),
            None => System::of_plant(Plant { omega, ..self.plant.clone() }),
        }
    }

    /// The same system without forcing; ω stays as the clock that counts periods.
    #[must_use]
    pub fn unforced(mut self) -> Self {
        self.of_flow = Kept::default();
        self.plant.force_sin.fill(0.0);
        self.plant.force_cos.fill(0.0);
        self
    }

    /// The same system under a unit load of sin φ on one coordinate and no other.
    ///
    /// # Panics
    /// If there is no such coordinate.
    #[must_use]
    pub fn loaded_alone(&self, coordinate: usize) -> Self {
        let mut alone = self.clone().unforced();
        alone.plant.load.fill(0.0);
        alone.plant.force_sin[coordinate] = 1.0;
        alone
    }

    /// The same system with other loads of sin φ on its coordinates.
    #[must_use]
    pub fn loaded(mut self, force_sin: &[f64]) -> Self {
        self.of_flow = Kept::default();
        self.plant.force_sin.copy_from_slice(force_sin);
        self
    }

    /// The stops in the order in which labels count their impacts: the family's, or that of the plant.
    pub fn label_order(&self) -> &[usize] {
        &self.label_order
    }

    /// The same system, which shares nothing with others.
    #[must_use]
    pub(super) fn alone(self) -> Self {
        System { of_flow: Kept::default(), ..self }
    }

    /// The setting that the system was made from; none where it was made from a plant.
    pub fn setting(&self) -> Option<&Setting> {
        self.setting.as_ref()
    }

    /// Whether it is the paper's oscillator, of which the exact theory speaks.
    pub fn is_paper(&self) -> bool {
        self.setting.as_ref().is_some_and(|setting| setting.family().is_paper())
    }

    /// The parameters of the paper's oscillator.
    ///
    /// # Panics
    /// If it is another system.
    pub fn parameters(&self) -> Parameters {
        self.setting.as_ref().and_then(Parameters::of).expect("the system is the paper's oscillator")
    }

    /// The numbers of its equations of motion.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// A state (x1 … xn, v1 … vn) whose displacements lie beyond a stop, moved onto it along the stop's direction; any other
    /// as it is.
    #[must_use]
    pub fn between_stops<S: std::ops::DerefMut<Target = [f64]>>(&self, mut state: S) -> S {
        for stop in &self.plant.stops {
            let along =
                |state: &[f64]| -> f64 { stop.direction.iter().zip(state.iter()).map(|(d, x)| d * x).sum() };
            let beyond = along(&state) - stop.gap;
            if beyond > 0.0 {
                let square = stop.direction.norm_squared();
                for (value, d) in state.iter_mut().zip(stop.direction.iter()) {
                    *value -= beyond * d / square;
                }
            }
        }
        state
    }

    /// The mirror P, P² = 1, under which the system half a forcing period later is itself, if there is one.
    pub fn mirror(&self) -> Option<&Mirror> {
        self.of_flow.0.mirror(|| self.plant.mirror())
    }

    /// What follows from its flow alone.
    pub(crate) fn of_flow(&self) -> &Arc<OfFlow> {
        &self.of_flow.0
    }

    /// What follows from its flow and its coefficients of restitution, whatever its gaps: found once for all systems that
    /// share the flow.
    pub(crate) fn whatever_gaps<C: Any + Send + Sync>(&self, compute: impl FnOnce() -> C) -> Arc<C> {
        let stops = &self.plant.stops;
        let bits = |i: usize| stops.get(i).map_or(0, |stop| stop.restitution.to_bits());
        self.of_flow.0.of_restitutions(std::array::from_fn(bits), compute)
    }

    /// Which stops have the same gap, per length of their direction, and the same restitution, within a few ulps: one value
    /// for each pair. Systems with the same flow and the same values have the same mirror.
    pub(super) fn mirrored_stops(&self) -> impl Iterator<Item = u64> + '_ {
        let stops = &self.plant.stops;
        let measures: [_; Plant::MOST_STOPS] = std::array::from_fn(|i| {
            stops.get(i).map_or([0.0; 2], |stop| [stop.gap / stop.direction.norm(), stop.restitution])
        });
        let alike = move |i: usize, j: usize| {
            let near = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * a.abs().max(b.abs());
            near(measures[i][0], measures[j][0]) && near(measures[i][1], measures[j][1])
        };
        let count = self.plant.stops.len();
        (0..count).flat_map(move |i| (0..i).map(move |j| (i, j))).map(move |(i, j)| u64::from(alike(i, j)))
    }

    /// tr(M⁻¹C), the rate at which free flight contracts volumes of phase space.
    pub fn contraction(&self) -> f64 {
        let inverse = self.plant.mass.clone().try_inverse();
        (inverse.expect("a plant's mass matrix was checked to be invertible") * &self.plant.damping).trace()
    }

    /// The forcing period T = 2π/ω, non-dimensional.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.plant.omega
    }

    /// The fastest rate of the flow: ω, or ‖A⁸‖^(1/8) of the unforced generator A, which lies just above the
    /// modulus of its largest eigenvalue. Taylor terms of a flight of length s shrink like (rate·s)ᵏ/k!.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// M, the steps in one forcing period: even, so that phases 0 and π fall on steps.
    pub fn steps(&self) -> u32 {
        self.steps
    }
}

/// See [`System::rate`].
fn rate(plant: &Plant) -> f64 {
    match plant.n {
        1 => super::Equations::<1>::new(plant).rate(),
        2 => super::Equations::<2>::new(plant).rate(),
        3 => super::Equations::<3>::new(plant).rate(),
        4 => super::Equations::<4>::new(plant).rate(),
        _ => super::Equations::<5>::new(plant).rate(),
    }
}
