//! The control methods and their variants, by name.

use clap::ValueEnum;

/// A control method by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// A sine force with an adapted amplitude
    Sine,
    /// Period pulses that bring every P-th point back to the target
    Pulse,
    /// Delayed feedback of the points on the section
    Delay,
}

impl MethodName {
    /// The name in messages and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            MethodName::Sine => "sine",
            MethodName::Pulse => "pulse",
            MethodName::Delay => "delay",
        }
    }
}

/// What the sine force is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ConventionName {
    /// At each return to the section its first component, v1+, is changed by B sin(γωt + φ), t the time since the last
    /// return
    Kick,
    /// A force B sin(γθ + φ) on --coordinate between impacts, θ the phase of the forcing
    Force,
    /// A force B sin(γωt + φ) on --coordinate between impacts, t counted from each impact at --stop
    ForceLocal,
}

/// The sign of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SignName {
    /// X(n+1) = F(X(n)) + G (X(n) − X(n−p)), which stabilises
    Stabilising,
    /// X(n+1) = F(X(n)) + G (X(n−p) − X(n)), as Eq. (30) is printed
    Printed,
}
