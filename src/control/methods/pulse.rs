//! Period pulses that bring every P-th point back to the target: Eqs. (26) to (29).

use serde::{Deserialize, Serialize};

use crate::control::action::{Action, Seen};
use crate::control::components::Components;
use crate::control::error::ControlError;
use crate::control::law::{
    Aim, CORRECTION, Constant, Law, Member, Method, Settings, Shown, bits, check_ranges,
};
use crate::control::option::OptionKind::{Count, Number};
use crate::control::option::{Arguments, GivenOptions, MethodOption};
use crate::control::quantity::ControlQuantity;
use crate::control::section_point::SectionPoint;
use crate::control::site::Site;
use crate::control::target::Target;
use crate::control::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::{Real, System};
use crate::system::Family;

/// Settings of the period pulse; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PulseSetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// P ≥ 1, iterates from one pulse to the next.
    pub period: u32,
    /// X0.
    pub target: Target,
    /// E ≥ 0, the largest error of a measured component.
    pub noise: f64,
    /// What the errors are drawn from.
    pub seed: u32,
}

const PERIOD: ControlQuantity = ControlQuantity::whole("period", "P", "pulse period in iterates");
const NOISE: ControlQuantity = ControlQuantity::new("noise", "E", "largest error of measurement");

const METHOD: Method = Method {
    name: "pulse",
    about: "Period pulses that bring every P-th point back to the target",
    options: (
        "Pulse",
        &[
            MethodOption::new(Count, ["period", "P"], "the period P of the pulses in iterates [default: 1]"),
            MethodOption::new(
                Number,
                ["noise", "E"],
                "the largest error E of a measured component [default: 0]",
            ),
            MethodOption::new(Count, ["seed", "SEED"], "what the errors are drawn from [default: 1]"),
        ],
    ),
    aim: Aim::Point,
    varied: &[PERIOD, NOISE],
    signal: CORRECTION,
    shader: include_str!("../../../shaders/control/methods/pulse.wgsl"),
    constants: &[
        ("ERRORS_APART", Constant::Whole(ERRORS_APART)),
        ("HASH_DROPPED", Constant::Whole(HASH_DROPPED)),
        ("HASH_UNIT", Constant::Number(HASH_UNIT)),
        ("HASH_MULTIPLIER", Constant::Whole(HASH_MULTIPLIER)),
        ("HASH_INCREMENT", Constant::Whole(HASH_INCREMENT)),
        ("HASH_FACTOR", Constant::Whole(HASH_FACTOR)),
        ("HASH_CHOICE", Constant::Whole(HASH_CHOICE)),
        ("HASH_LEAST", Constant::Whole(HASH_LEAST)),
        ("HASH_LAST", Constant::Whole(HASH_LAST)),
    ],
    members: &[
        ("period", Member::Whole),
        ("seed", Member::Whole),
        ("noise", Member::Number),
        ("point", Member::Components),
    ],
    adapted: &[],
};

impl Settings for PulseSetting {
    type Law = Pulse<f64>;

    const METHOD: &'static Method = &METHOD;

    fn given(options: &GivenOptions, site: &Site) -> Result<Self, ControlError> {
        Ok(PulseSetting {
            stop: site.stop,
            period: options.count("period", 1),
            target: Target::given(options, site, site.components())?,
            noise: options.number("noise", 0.0),
            seed: options.count("seed", 1),
        })
    }

    fn write(&self, family: &Family, to: &mut Arguments) {
        to.setting(PERIOD, f64::from(self.period));
        to.setting(NOISE, self.noise);
        to.word("seed", &self.seed.to_string());
        self.target.write(&Vec::from_iter(0..2 * family.n()), to);
    }

    fn vary(&mut self, quantity: ControlQuantity, value: f64) -> Option<()> {
        match quantity {
            PERIOD => self.period = value as u32,
            NOISE => self.noise = value,
            _ => {
                let place = self.target.component(quantity)?;
                self.target.given[place] = Some(value);
            }
        }
        Some(())
    }

    fn check(&self) -> Result<(), ControlError> {
        let (period, noise) = (f64::from(self.period), self.noise);
        check_ranges(&[
            (PERIOD, period, self.period > 0, "1 or greater"),
            (NOISE, noise, noise >= 0.0 && noise.is_finite(), "0 or greater"),
        ])?;
        self.target.check()
    }

    fn resolve(&self, system: &System) -> Result<Pulse<f64>, ControlError> {
        let PulseSetting { stop, period, noise, seed, .. } = *self;
        let all = Vec::from_iter(0..2 * system.plant().n);
        Ok(Pulse { stop, period, target: self.target.resolve(system, stop, &all)?, noise, seed })
    }

    fn shown(&self) -> (&'static str, Vec<Shown>) {
        let period = Shown::Setting(PERIOD, f64::from(self.period));
        ("period pulse", vec![period, Shown::Setting(NOISE, self.noise)])
    }
}

/// The period pulse at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse<T> {
    /// The stop on whose section it acts.
    pub stop: Stop,
    /// P, iterates from one pulse to the next.
    pub period: u32,
    /// X0.
    pub target: SectionValues<T>,
    /// E: each component of X is measured with an error of up to so much.
    pub noise: T,
    /// What the errors are drawn from.
    pub seed: u32,
}

impl<T: Real> Law<T> for Pulse<T> {
    type Exact = Pulse<f64>;

    fn rounded(&Pulse { stop, period, target, noise, seed }: &Pulse<f64>) -> Self {
        Pulse { stop, period, target: target.map(T::of), noise: T::of(noise), seed }
    }

    /// Q = X(n) − X0 is taken away, X(n) as measured.
    #[inline(always)]
    fn act<const N: usize>(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        if !self.is_due(seen) {
            return Action::none();
        }
        let away = SectionPoint::new(&self.target).minus(&seen.section);
        let error = |i: usize| self.noise * uniform(self.seed, seen.controlled, i as u32);
        Action::correcting(Components::from_fn(|i| away[i] - error(i)))
    }

    /// A pulse erases it.
    #[inline(always)]
    fn passed<const N: usize>(
        &self,
        seen: &Seen<T, N>,
        _: &[Components<T, N>],
        arrived: Components<T, N>,
    ) -> Components<T, N> {
        if self.is_due(seen) { Components::zero() } else { arrived }
    }

    fn target(&self) -> Option<Vec<T>> {
        Some(self.target.to_vec())
    }

    fn written(&self) -> Vec<u32> {
        [vec![self.period, self.seed], bits([self.noise]), bits(self.target.to_vec())].concat()
    }
}

impl<T: Real> Pulse<T> {
    /// Whether a pulse falls on this iterate.
    fn is_due<const N: usize>(&self, seen: &Seen<T, N>) -> bool {
        seen.controlled.is_multiple_of(self.period)
    }
}

/// Errors are drawn with numbers that lie so far apart from one iterate to the next.
const ERRORS_APART: u32 = 4;
/// Low bits of a hash that are left out, so that what is left is exact in single precision …
const HASH_DROPPED: u32 = 8;
/// … and what the lowest bit that is left stands for, between −1 and 1.
const HASH_UNIT: f64 = 1.0 / 8_388_608.0;

// The 32-bit PCG hash RXS-M-XS: M. Jarzynski, M. Olano, Journal of Computer Graphics Techniques 9(3) (2020) 20-38.
const HASH_MULTIPLIER: u32 = 747_796_405;
const HASH_INCREMENT: u32 = 2_891_336_453;
const HASH_FACTOR: u32 = 277_803_737;
/// The highest bits, above this one, choose by how many more than [`HASH_LEAST`] a word is shifted.
const HASH_CHOICE: u32 = 28;
const HASH_LEAST: u32 = 4;
const HASH_LAST: u32 = 22;

/// A number between −1 and 1 that depends on nothing but these three: two rounds of the PCG hash.
fn uniform<T: Real>(seed: u32, iterate: u32, component: u32) -> T {
    let mixed =
        hash(hash(seed ^ iterate.wrapping_mul(ERRORS_APART).wrapping_add(component)).wrapping_add(iterate));
    T::of(f64::from(mixed >> HASH_DROPPED)) * T::of(HASH_UNIT) - T::one()
}

fn hash(value: u32) -> u32 {
    let state = value.wrapping_mul(HASH_MULTIPLIER).wrapping_add(HASH_INCREMENT);
    let word = ((state >> ((state >> HASH_CHOICE) + HASH_LEAST)) ^ state).wrapping_mul(HASH_FACTOR);
    (word >> HASH_LAST) ^ word
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_fill_their_range_evenly() {
        let drawn: Vec<f64> = (0..4000).map(|i| uniform(7, i / 4, i % 4)).collect();
        let mean = drawn.iter().sum::<f64>() / 4000.0;
        let square = drawn.iter().map(|x| x * x).sum::<f64>() / 4000.0;
        assert!(drawn.iter().all(|x| (-1.0..1.0).contains(x)));
        assert!(mean.abs() < 0.03 && (square - 1.0 / 3.0).abs() < 0.02, "{mean} {square}");
        assert_ne!(uniform::<f64>(7, 3, 1), uniform::<f64>(8, 3, 1));
    }
}
