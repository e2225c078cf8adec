//! Delayed feedback: Eq. (30), with the sign that stabilises.
//!
//! After K. Pyragas, Phys. Lett. A 170 (1992) 421–428, doi:10.1016/0375-9601(92)90745-8.

use serde::{Deserialize, Serialize};

use crate::control::action::{Action, Seen};
use crate::control::components::Components;
use crate::control::error::ControlError;
use crate::control::law::{Aim, CORRECTION, Law, Member, Method, Settings, Shown, bits, check_ranges};
use crate::control::memory::LONGEST_DELAY;
use crate::control::option::OptionKind::{Choice, Count, Number, Numbers};
use crate::control::option::{Arguments, GivenOptions, MethodOption};
use crate::control::quantity::ControlQuantity;
use crate::control::site::{Site, words};
use crate::control::surface::section_names;
use crate::control::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::{Real, System, joined};
use crate::system::Family;

/// Settings of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DelaySetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// The diagonal of G, each between 0 and 1: one for each component of X.
    pub gains: SectionValues<f64>,
    /// p, iterates, 1 to [`LONGEST_DELAY`].
    pub delay: u32,
    /// The sign of the feedback.
    pub sign: Sign,
}

/// The sign of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sign {
    /// X(n+1) = F(X(n)) + G (X(n) − X(n−p)).
    Stabilising,
    /// X(n+1) = F(X(n)) + G (X(n−p) − X(n)), as Eq. (30) is printed.
    Printed,
}

/// The settings that axes vary: all gains alike, and p.
const GAIN: ControlQuantity = ControlQuantity::new("gain", "g", "feedback gain");
const DELAY: ControlQuantity = ControlQuantity::whole("delay", "p", "delay in iterates");

/// g unless it is given.
const USUAL_GAIN: f64 = 0.5;

const METHOD: Method = Method {
    name: "delay",
    about: "Delayed feedback of the points on the section",
    options: (
        "Delay",
        &[
            MethodOption::new(Number, ["gain", "G"], "the gain g of all components, 0 to 1 [default: 0.5]"),
            MethodOption::new(Numbers, ["gains", "G1,G2,…"], "the diagonal of G, a gain for each component")
                .instead_of("gain"),
            MethodOption::new(Count, ["delay", "p"], "the delay p in iterates, 1 to 8 [default: 1]"),
            MethodOption::new(
                Choice(&SIGNS),
                ["sign", "SIGN"],
                "the sign of the feedback [default: stabilising]",
            ),
        ],
    ),
    aim: Aim::Nothing,
    varied: &[GAIN, DELAY],
    signal: CORRECTION,
    shader: include_str!("../../../shaders/control/methods/delay.wgsl"),
    constants: &[],
    members: &[("iterates", Member::Whole), ("gains", Member::Components)],
    adapted: &[],
};

/// The signs by their options and in words, in their order.
const SIGNS: [[&str; 2]; 2] = [
    ["stabilising", "X(n+1) = F(X(n)) + G (X(n) − X(n−p)), which stabilises"],
    ["printed", "X(n+1) = F(X(n)) + G (X(n−p) − X(n)), as Eq. (30) is printed"],
];

/// Each multiplier λ of F gives μ² − (λ + g) μ + g = 0, whose roots have the product g.
const GAIN_RANGE: &str =
    "between 0 and 1: a larger gain makes every motion unstable (for the other sign see --sign)";

impl Settings for DelaySetting {
    type Law = Delay<f64>;

    const METHOD: &'static Method = &METHOD;

    fn given(options: &GivenOptions, site: &Site) -> Result<Self, ControlError> {
        let alike = vec![options.number("gain", USUAL_GAIN); site.components()];
        let gains = options.numbers("gains").unwrap_or(&alike);
        let fitting = SectionValues::from_slice(gains).filter(|_| gains.len() == site.components());
        let gains = fitting.ok_or_else(|| {
            let (given, wanted) = (gains.len(), words(site.components()));
            ControlError::Option(format!("--gains has {given} numbers: give {wanted}, for {}", site.listed()))
        })?;
        let sign = match options.word("sign") {
            Some("printed") => Sign::Printed,
            _ => Sign::Stabilising,
        };
        Ok(DelaySetting { stop: site.stop, gains, delay: options.count("delay", 1), sign })
    }

    fn write(&self, _: &Family, to: &mut Arguments) {
        if !(to.varied)(GAIN) {
            to.value("gains", &joined(&self.gains, ","));
        }
        to.setting(DELAY, f64::from(self.delay));
        to.word("sign", SIGNS[self.sign as usize][0]);
    }

    fn vary(&mut self, quantity: ControlQuantity, value: f64) -> Option<()> {
        match quantity {
            GAIN => self.gains = self.gains.map(|_| value),
            DELAY => self.delay = value as u32,
            _ => return None,
        }
        Some(())
    }

    fn check(&self) -> Result<(), ControlError> {
        let gain = |g: f64| (GAIN, g, (0.0..=1.0).contains(&g), GAIN_RANGE);
        let whole = (1..=LONGEST_DELAY as u32).contains(&self.delay);
        check_ranges(&self.gains.iter().map(|&g| gain(g)).collect::<Vec<_>>())?;
        check_ranges(&[(DELAY, f64::from(self.delay), whole, "a whole number from 1 to 8")])
    }

    fn resolve(&self, system: &System) -> Result<Delay<f64>, ControlError> {
        let DelaySetting { stop, gains, delay, sign } = *self;
        let (given, wanted) = (gains.len(), 2 * system.plant().n);
        if given != wanted {
            let names = section_names(system.plant(), stop).join(", ");
            return Err(ControlError::Count { what: "gains", given, wanted, names });
        }
        let gains = match sign {
            Sign::Stabilising => gains,
            Sign::Printed => gains.map(|gain| -gain),
        };
        Ok(Delay { stop, gains, delay })
    }

    fn shown(&self) -> (&'static str, Vec<Shown>) {
        let method = match self.sign {
            Sign::Stabilising => "delayed feedback",
            Sign::Printed => "delayed feedback, printed sign",
        };
        let g = self.gains[0];
        let alike = self.gains.iter().all(|&gain| gain == g);
        let gain = if alike { Shown::Setting(GAIN, g) } else { Shown::Diagonal(self.gains) };
        (method, vec![gain, Shown::Setting(DELAY, f64::from(self.delay))])
    }
}

/// Delayed feedback at work: X(n+1) = F(X(n)) + G (X(n) − X(n−p)).
///
/// Print has G (X(n−p) − X(n)), which is this with negative gains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay<T> {
    /// The stop on whose section it acts.
    pub stop: Stop,
    /// The diagonal of G, one for each component; its sign is the one above.
    pub gains: SectionValues<T>,
    /// p, in iterates.
    pub delay: u32,
}

impl<T: Real> Law<T> for Delay<T> {
    type Exact = Delay<f64>;

    fn rounded(&Delay { stop, gains, delay }: &Delay<f64>) -> Self {
        Delay { stop, gains: gains.map(T::of), delay }
    }

    #[inline(always)]
    fn act<const N: usize>(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        if seen.memory.seen <= self.delay {
            return Action::none();
        }
        let points = &seen.memory.points;
        Action::correcting(self.feedback(&points[0].minus(&points[self.delay as usize])))
    }

    #[inline(always)]
    fn passed<const N: usize>(
        &self,
        _: &Seen<T, N>,
        before: &[Components<T, N>],
        arrived: Components<T, N>,
    ) -> Components<T, N> {
        let past = before[self.delay as usize].map(|value| -value);
        arrived.added(&self.feedback(&before[0].added(&past)))
    }

    fn remembered(&self) -> usize {
        self.delay as usize + 1
    }

    fn written(&self) -> Vec<u32> {
        [vec![self.delay], bits(self.gains.to_vec())].concat()
    }
}

impl<T: Real> Delay<T> {
    /// G times a difference.
    #[inline(always)]
    fn feedback<const N: usize>(&self, difference: &Components<T, N>) -> Components<T, N> {
        Components::from_fn(|i| self.gains[i] * difference[i])
    }
}
