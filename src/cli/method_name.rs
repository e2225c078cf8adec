//! The control methods by name.

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
