//! The settings that an axis can vary.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr};

/// A setting of a control method that an axis can vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, EnumString, IntoStaticStr)]
#[cfg_attr(test, derive(strum::VariantArray))]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum ControlQuantity {
    /// g, all gains of delayed feedback alike.
    Gain,
    /// p of delayed feedback.
    Delay,
    /// B of the sine force, before adaptation.
    Amplitude,
    /// α of the sine force.
    Alpha,
    /// Δ of the sine force.
    DeadBand,
    /// γ of the sine force.
    Gamma,
    /// φ of the sine force.
    Phase,
    /// P of the period pulse.
    Period,
    /// E of the period pulse.
    Noise,
    /// v1 of the target, after the impact.
    TargetV1,
    /// v2 of the target.
    TargetV2,
    /// v3 of the target.
    TargetV3,
    /// v4 of the target.
    TargetV4,
    /// x1 of the target.
    TargetX1,
    /// x2 of the target.
    TargetX2,
    /// x3 of the target.
    TargetX3,
    /// x4 of the target.
    TargetX4,
    /// τ of the target.
    TargetTau,
}

/// A component of a target, by what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Aim {
    Velocity(usize),
    Displacement(usize),
    Phase,
}

const VELOCITIES: [ControlQuantity; 4] = [
    ControlQuantity::TargetV1,
    ControlQuantity::TargetV2,
    ControlQuantity::TargetV3,
    ControlQuantity::TargetV4,
];

const DISPLACEMENTS: [ControlQuantity; 4] = [
    ControlQuantity::TargetX1,
    ControlQuantity::TargetX2,
    ControlQuantity::TargetX3,
    ControlQuantity::TargetX4,
];

impl ControlQuantity {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// What the setting is, for axis titles.
    pub fn description(self) -> &'static str {
        match self {
            ControlQuantity::Gain => "feedback gain",
            ControlQuantity::Delay => "delay in iterates",
            ControlQuantity::Amplitude => "amplitude of the sine force",
            ControlQuantity::Alpha => "weight of the adaptation",
            ControlQuantity::DeadBand => "dead band",
            ControlQuantity::Gamma => "frequency ratio of the sine force",
            ControlQuantity::Phase => "phase of the sine force",
            ControlQuantity::Period => "pulse period in iterates",
            ControlQuantity::Noise => "largest error of measurement",
            ControlQuantity::TargetV1 => "target velocity after impact",
            ControlQuantity::TargetV2 => "target velocity of the second mass",
            ControlQuantity::TargetV3 => "target velocity of the third mass",
            ControlQuantity::TargetV4 => "target velocity of the fourth mass",
            ControlQuantity::TargetX1 => "target displacement of the first mass",
            ControlQuantity::TargetX2 => "target displacement of the second mass",
            ControlQuantity::TargetX3 => "target displacement of the third mass",
            ControlQuantity::TargetX4 => "target displacement of the fourth mass",
            ControlQuantity::TargetTau => "target phase",
        }
    }

    /// Whether only whole numbers make sense.
    pub fn is_whole(self) -> bool {
        matches!(self, ControlQuantity::Delay | ControlQuantity::Period)
    }

    /// The setting that is a component of a target on a section of n coordinates, whose first component is the velocity of
    /// the coordinate `own`.
    ///
    /// # Panics
    /// If the section has no such component.
    pub fn of_component(component: usize, n: usize, own: usize) -> Self {
        let all = VELOCITIES.into_iter().chain(DISPLACEMENTS).chain([ControlQuantity::TargetTau]);
        let mut all = all.filter(|setting| setting.component(n, own) == Some(component));
        all.next().expect("a section has 2n components")
    }

    /// Which component of a target it is on a section of n coordinates, whose first component is the velocity of the
    /// coordinate `own`.
    pub(super) fn component(self, n: usize, own: usize) -> Option<usize> {
        let among_others = |i: usize| if i < own { i } else { i - 1 };
        match self.aim()? {
            Aim::Phase => Some(2 * n - 1),
            Aim::Velocity(i) | Aim::Displacement(i) if i >= n => None,
            Aim::Velocity(i) if i == own => Some(0),
            Aim::Displacement(i) if i == own => None,
            Aim::Velocity(i) => Some(n + among_others(i)),
            Aim::Displacement(i) => Some(1 + among_others(i)),
        }
    }

    fn aim(self) -> Option<Aim> {
        let place = |all: [ControlQuantity; 4]| all.into_iter().position(|setting| setting == self);
        if self == ControlQuantity::TargetTau {
            return Some(Aim::Phase);
        }
        place(VELOCITIES).map(Aim::Velocity).or_else(|| place(DISPLACEMENTS).map(Aim::Displacement))
    }
}

#[cfg(test)]
mod tests {
    use strum::VariantArray;

    use super::*;
    use crate::control::section_names;
    use crate::dynamics::Stop;
    use crate::model::Setting;
    use crate::system::Family;

    /// The names of settings are those of the section's components, whatever coordinate is its own.
    #[test]
    fn components_have_the_settings_of_their_names() {
        for (family, own) in
            [("luo-ma-lv", 0), ("bouncing-ball", 0), ("three-mass-chain", 1), ("impact-damper", 0)]
        {
            let plant = Setting::defaults(Family::builtin(family)).plant().unwrap();
            for (i, name) in section_names(&plant, Stop::A).iter().enumerate() {
                let setting = ControlQuantity::of_component(i, plant.n, own);
                assert_eq!(setting.name(), format!("target_{}", name.trim_end_matches('+')), "{family}");
                assert_eq!(setting.component(plant.n, own), Some(i), "{family}");
            }
            let there = ControlQuantity::VARIANTS.iter().filter(|s| s.component(plant.n, own).is_some());
            assert_eq!(there.count(), 2 * plant.n, "{family}");
        }
    }
}
