//! The settings of the adapted sine force.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::convention::Convention;
use super::sine::Sine;
use crate::control::error::ControlError;
use crate::control::law::{Aim, Beginning, Constant, Member, Method, Settings, Shown, check_ranges};
use crate::control::option::{
    Arguments, GivenOptions, MethodOption, OptionKind, OptionKind::Choice, OptionKind::Word,
};
use crate::control::quantity::ControlQuantity;
use crate::control::site::{Site, exists};
use crate::control::target::Target;
use crate::dynamics::Stop;
use crate::model::System;
use crate::system::Family;

/// Settings of the adapted sine force; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SineSetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// What u = B sin(γωt + φ) is.
    pub convention: Convention,
    /// The coordinate that a force acts on, from 0.
    #[serde(default)]
    pub coordinate: usize,
    /// B before the first adaptation.
    pub amplitude: f64,
    /// α, 0 ≤ α ≤ 1; with 0 the amplitude stays as it is.
    pub alpha: f64,
    /// Δ ≥ 0.
    pub dead_band: f64,
    /// γ > 0.
    pub gamma: f64,
    /// φ.
    pub phase: f64,
    /// Which component of X is held to that of the target, in the order of
    /// [`section_names`](crate::control::section_names): 0 to 3 for the paper's v1+, x2, v2, τ.
    pub component: usize,
    /// The target.
    pub target: Target,
}

const AMPLITUDE: ControlQuantity = ControlQuantity::new("amplitude", "B", "amplitude of the sine force");
const ALPHA: ControlQuantity = ControlQuantity::new("alpha", "α", "weight of the adaptation");
const DEAD_BAND: ControlQuantity = ControlQuantity::new("dead_band", "Δ", "dead band");
const GAMMA: ControlQuantity = ControlQuantity::new("gamma", "γ", "frequency ratio of the sine force");
const PHASE: ControlQuantity = ControlQuantity::new("phase", "φ", "phase of the sine force");

/// α unless it is given.
const USUAL_ALPHA: f64 = 0.1;

/// Δ unless it is given: just above the distance of the 1-2-1 motion's phase from the paper's target.
const USUAL_DEAD_BAND: f64 = 0.0055;

/// A setting of its own as an option.
const fn number(name: &'static str, value_name: &'static str, help: &'static str) -> MethodOption {
    MethodOption::new(OptionKind::Number, [name, value_name], help)
}

const METHOD: Method = Method {
    name: "sine",
    about: "A sine force with an adapted amplitude",
    options: (
        "Sine",
        &[
            MethodOption::new(
                Choice(&Convention::NAMES),
                ["convention", "CONVENTION"],
                "what u = B sin(γωt + φ) is [default: kick]",
            ),
            number("amplitude", "B", "the amplitude B before the first adaptation [default: 0]"),
            number(
                "alpha",
                "ALPHA",
                "the weight of the adaptation, 0 to 1; 0 keeps B constant [default: 0.1]",
            )
            .more("B(n+1) = B(n) + α |e(n+1)|, and α changes its sign whenever |e(n+1)/e(n)| > 1."),
            number("dead-band", "DELTA", "the error below which B is left alone [default: 0.0055]"),
            number("gamma", "GAMMA", "frequency of the force in units of the forcing's [default: 1]"),
            number("phase", "PHI", "phase φ of the force in radians [default: 0]"),
            MethodOption::new(
                Word,
                ["component", "NAME"],
                "the component of the section point that is held to the target [default: tau]",
            )
            .more("v_after for the first, or a name: v1+, x2, v2, tau at the paper's stops."),
            MethodOption::new(
                Word,
                ["coordinate", "x1 … xn"],
                "the coordinate that a force acts on [default: x1]",
            ),
        ],
    ),
    aim: Aim::Component,
    varied: &[AMPLITUDE, ALPHA, DEAD_BAND, GAMMA, PHASE],
    signal: ("amplitude ", &["", "B"]),
    shader: include_str!("../../../shaders/control/methods/sine.wgsl"),
    constants: &[
        ("CONVENTION_KICK", Constant::Whole(Convention::Kick as u32)),
        ("CONVENTION_FORCE", Constant::Whole(Convention::Force as u32)),
    ],
    members: &[
        ("convention", Member::Whole),
        ("component", Member::Whole),
        ("amplitude", Member::Number),
        ("weight", Member::Number),
        ("dead_band", Member::Number),
        ("ratio", Member::Number),
        ("phase", Member::Number),
        ("wanted", Member::Number),
    ],
    adapted: &[
        ("amplitude", Beginning::Member("amplitude")),
        ("weight", Beginning::Member("weight")),
        ("error", Beginning::Number(-1.0)),
    ],
};

impl SineSetting {
    /// The largest γ.
    pub const FASTEST: f64 = 100.0;
}

impl Settings for SineSetting {
    type Law = Sine<f64>;

    const METHOD: &'static Method = &METHOD;

    fn given(options: &GivenOptions, site: &Site) -> Result<Self, ControlError> {
        let component = site.component(options.word("component"))?;
        let convention = Convention::named(options.word("convention"));
        let coordinate = options.word("coordinate");
        if let (Some(coordinate), Convention::Kick) = (coordinate, convention) {
            return Err(ControlError::Option(format!(
                "--coordinate {coordinate} has no effect on a kick, which changes {}: drop it, or give --convention force",
                site.names[0]
            )));
        }
        let mut target = Target::given(options, site, 1)?;
        target.given.swap(0, component);
        Ok(SineSetting {
            stop: site.stop,
            coordinate: site.coordinate(coordinate)?,
            convention,
            amplitude: options.number("amplitude", 0.0),
            alpha: options.number("alpha", USUAL_ALPHA),
            dead_band: options.number("dead-band", USUAL_DEAD_BAND),
            gamma: options.number("gamma", 1.0),
            phase: options.number("phase", 0.0),
            component,
            target,
        })
    }

    fn write(&self, family: &Family, to: &mut Arguments) {
        let aimed = ControlQuantity::of_component(self.component, family.n(), self.target.own);
        to.word("convention", self.convention.name());
        to.word(
            "component",
            match self.component {
                0 => "v_after",
                _ => aimed.name.trim_start_matches("target_"),
            },
        );
        if self.coordinate > 0 {
            to.word("coordinate", &format!("x{}", self.coordinate + 1));
        }
        to.setting(AMPLITUDE, self.amplitude);
        to.setting(ALPHA, self.alpha);
        to.setting(DEAD_BAND, self.dead_band);
        to.setting(GAMMA, self.gamma);
        to.setting(PHASE, self.phase);
        if !(to.varied)(aimed) {
            self.target.write(&[self.component], to);
        }
    }

    fn vary(&mut self, quantity: ControlQuantity, value: f64) -> Option<()> {
        match quantity {
            AMPLITUDE => self.amplitude = value,
            ALPHA => self.alpha = value,
            DEAD_BAND => self.dead_band = value,
            GAMMA => self.gamma = value,
            PHASE => self.phase = value,
            _ if self.target.component(quantity) == Some(self.component) => {
                self.target.given[self.component] = Some(value);
            }
            _ => return None,
        }
        Some(())
    }

    fn check(&self) -> Result<(), ControlError> {
        let SineSetting { amplitude, alpha, dead_band, gamma, phase, .. } = *self;
        let is_slow = gamma > 0.0 && gamma <= Self::FASTEST;
        check_ranges(&[
            (AMPLITUDE, amplitude, amplitude.is_finite(), "a finite number"),
            (ALPHA, alpha, (0.0..=1.0).contains(&alpha), "between 0 and 1"),
            (DEAD_BAND, dead_band, dead_band >= 0.0 && dead_band.is_finite(), "0 or greater"),
            (GAMMA, gamma, is_slow, "greater than 0, and at most 100"),
            (PHASE, phase, phase.is_finite(), "a finite number"),
        ])?;
        self.target.check()
    }

    fn resolve(&self, system: &System) -> Result<Sine<f64>, ControlError> {
        let SineSetting { stop, convention, coordinate, amplitude, dead_band, component, .. } = *self;
        let n = system.plant().n;
        exists("component of the section", component, 2 * n)?;
        exists("coordinate", coordinate, n)?;
        Ok(Sine {
            stop,
            convention,
            coordinate,
            amplitude,
            weight: self.alpha,
            dead_band,
            ratio: self.gamma,
            phase: (self.phase / TAU).rem_euclid(1.0),
            component,
            target: self.target.resolve(system, stop, &[component])?[component],
            error: -1.0,
        })
    }

    fn shown(&self) -> (&'static str, Vec<Shown>) {
        let method = match self.convention {
            Convention::Kick => "sine kick",
            Convention::Force => "sine force",
            Convention::ForceLocal => "sine force from each impact",
        };
        let values = [self.amplitude, self.alpha, self.dead_band, self.gamma];
        let on = (self.coordinate > 0).then_some(Shown::Coordinate(self.coordinate));
        let settings =
            METHOD.varied.iter().zip(values).map(|(&setting, value)| Shown::Setting(setting, value));
        (method, on.into_iter().chain(settings).collect())
    }
}
