//! The settings that an axis can vary.

use serde::{Deserialize, Serialize};

/// A setting of a control method that an axis can vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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
    /// v1+ of the target.
    TargetV1,
    /// x2 of the target.
    TargetX2,
    /// v2 of the target.
    TargetV2,
    /// τ of the target.
    TargetTau,
}

impl ControlQuantity {
    /// Every setting.
    pub const ALL: [ControlQuantity; 13] = [
        ControlQuantity::Gain,
        ControlQuantity::Delay,
        ControlQuantity::Amplitude,
        ControlQuantity::Alpha,
        ControlQuantity::DeadBand,
        ControlQuantity::Gamma,
        ControlQuantity::Phase,
        ControlQuantity::Period,
        ControlQuantity::Noise,
        ControlQuantity::TargetV1,
        ControlQuantity::TargetX2,
        ControlQuantity::TargetV2,
        ControlQuantity::TargetTau,
    ];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            ControlQuantity::Gain => "gain",
            ControlQuantity::Delay => "delay",
            ControlQuantity::Amplitude => "amplitude",
            ControlQuantity::Alpha => "alpha",
            ControlQuantity::DeadBand => "dead_band",
            ControlQuantity::Gamma => "gamma",
            ControlQuantity::Phase => "phase",
            ControlQuantity::Period => "period",
            ControlQuantity::Noise => "noise",
            ControlQuantity::TargetV1 => "target_v1",
            ControlQuantity::TargetX2 => "target_x2",
            ControlQuantity::TargetV2 => "target_v2",
            ControlQuantity::TargetTau => "target_tau",
        }
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
            ControlQuantity::TargetX2 => "target displacement of the second mass",
            ControlQuantity::TargetV2 => "target velocity of the second mass",
            ControlQuantity::TargetTau => "target phase",
        }
    }

    /// Whether only whole numbers make sense.
    pub fn is_whole(self) -> bool {
        matches!(self, ControlQuantity::Delay | ControlQuantity::Period)
    }

    /// Which of so many components of the target it is; x2 and v2 are components of a point on the paper's section only.
    pub(super) fn target_index(self, components: usize) -> Option<usize> {
        match self {
            ControlQuantity::TargetV1 => Some(0),
            ControlQuantity::TargetX2 => (components == 4).then_some(1),
            ControlQuantity::TargetV2 => (components == 4).then_some(2),
            ControlQuantity::TargetTau => components.checked_sub(1),
            _ => None,
        }
    }
}
