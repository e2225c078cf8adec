//! What the sine force is.

/// What u = B sin(γωt + φ) is; print leaves it open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Convention {
    /// A kick: at each return to σ, a time t after the last one, v_c+ (v1+ on the paper's) is changed by u.
    Kick = 0,
    /// A force on one coordinate between impacts; γωt is γ times the phase of the forcing.
    Force = 1,
    /// A force on one coordinate between impacts; t counts from each impact at the section's stop.
    ForceLocal = 2,
}

impl Convention {
    /// Every convention, the usual one first, by its option and in words.
    pub(super) const NAMES: [[&'static str; 2]; 3] = [
        [
            "kick",
            "At each return to the section its first component, v1+, is changed by B sin(γωt + φ), t the time since the last \
             return",
        ],
        ["force", "A force B sin(γθ + φ) on --coordinate between impacts, θ the phase of the forcing"],
        [
            "force-local",
            "A force B sin(γωt + φ) on --coordinate between impacts, t counted from each impact at --stop",
        ],
    ];

    /// The convention of an option.
    pub(super) fn named(name: Option<&str>) -> Self {
        match name {
            Some("force") => Convention::Force,
            Some("force-local") => Convention::ForceLocal,
            _ => Convention::Kick,
        }
    }

    /// The option.
    pub(super) fn name(self) -> &'static str {
        Self::NAMES[self as usize][0]
    }
}
