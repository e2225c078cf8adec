//! Suppressing chaos: the control methods of sections 6 and 8 and one more, acting at each return to the section σ.
//!
//! A [`Controlled`] trajectory flies from one impact at a stop, the section's, to the next. At each of them its
//! [`Controller`] sees the point X that it has arrived at ((v1+, x2, v2, τ) on the paper's section, at its first stop) and
//! answers with a correction of it, or with a force on one coordinate until the next. A correction that would lead off the
//! section (into its stop, or beyond another) is left out altogether, and counted as an escape.
//!
//! A point X has 2n components for n coordinates: a [`SectionPoint`] in flight, and [`SectionValues`] where the number of
//! coordinates is known at run time only.

mod action;
mod components;
mod controlled;
mod deviation;
mod error;
mod follow;
mod force;
mod history;
mod law;
mod leaving;
mod memory;
pub mod methods;
mod multipliers;
mod option;
mod outcome;
mod progress;
mod quantity;
mod run;
mod schedule;
mod section_point;
mod site;
mod surface;
mod target;
mod values;
mod witness;

pub use action::{Action, Seen};
pub use components::Components;
pub use controlled::Controlled;
pub use deviation::DELAYS;
pub use error::ControlError;
pub use history::{History, converged_at};
pub use law::{Aim, Beginning, Constant, Member, Method, Shown};
pub use memory::{Counts, LONGEST, LONGEST_DELAY, LONGEST_ON_DEVICE, Memory};
pub use methods::{Controller, METHODS, Scheme};
pub use multipliers::multipliers;
pub use option::{GivenOptions, MethodOption, OptionKind, OptionValue};
pub use outcome::{NEVER, Outcome};
pub use progress::Progress;
pub use quantity::ControlQuantity;
pub use run::control;
pub use schedule::{ControlSchedule, ControlScheduleError};
pub use section_point::SectionPoint;
pub use site::Site;
pub use surface::{Surface, section_names};
pub use target::Target;
pub use values::{MOST_COMPONENTS, SectionValues};
pub use witness::{Return, Witness};

/// The numbers that the GPU's shaders share.
pub(crate) mod constants {
    pub use super::controlled::{LONGEST_PASSAGE, SETTLING};
    pub use super::leaving::RUNAWAY;
}
