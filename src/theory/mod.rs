//! The theory on top of the map: exact periodic motions, their multipliers and how they lose stability, Lyapunov
//! spectra.
//!
//! All of it holds for any system of `n` coordinates: a section has 2n components (see [`section_names`]), a motion 2n
//! multipliers, a trajectory 2n exponents. A periodic motion is a sequence of impacts whose times and states satisfy matching equations; free flight between
//! them is an exact matrix. Newton's method solves them for stable and unstable motions alike, and the certified flight
//! of the simulation then decides whether the system really moves like that. Everything is in f64.

mod admissible;
mod approached;
mod bending;
mod cyclic;
#[cfg(test)]
mod example;
mod face;
mod flow;
mod follower;
mod frame;
mod impact_map;
mod jet;
mod joined;
mod label;
mod matched;
mod matching;
mod matching_line;
mod motion;
mod multipliers;
pub(crate) mod newton;
mod normal_form;
mod pattern;
mod search;
mod section_vector;
mod seeding;
mod settled;
mod spectrum;
mod strobe;
mod symmetric;
mod turn;
mod underdetermined;

pub(crate) use admissible::fly;
pub use admissible::{Inadmissible, NamedStop};
pub use approached::{approached, approached_from, confirmed, with_motion};
pub(crate) use cyclic::Cyclic;
pub(crate) use face::Face;
pub use face::section_names;
pub(crate) use flow::Flow;
pub use impact_map::{NoReturn, Return, impact_map, impact_map_at};
pub use label::{Label, LabelError};
pub use matched::{NoSymmetricMotion, SymmetricMotion};
pub(crate) use matching::Arc;
pub use motion::{NoMotion, PeriodicMotion};
pub(crate) use multipliers::{eigenvalues, turn_along};
pub(crate) use normal_form::NormalForm;
pub use normal_form::{flip_coefficient, fold_coefficient, neimark_sacker_coefficient};
pub use pattern::{Pattern, StopSet};
pub use search::{NotFound, labelled_motion};
pub use section_vector::{Node, SectionVector};
pub(crate) use section_vector::{extent, in_units, magnified, phase, unit_about};
pub use seeding::{Search, settled_motion};
pub use settled::SettledMotion;
pub use spectrum::{Spectrum, SpectrumFailed};
pub use strobe::StrobeMotion;
pub use symmetric::{
    SymmetricStarts, symmetric_motions, symmetric_start, symmetric_target, symmetric_target_at,
};
