//! Why a control method is refused.

use thiserror::Error;

use crate::model::{Number, SystemError};

/// Why a control method was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ControlError {
    /// A setting is out of its range.
    #[error("{name} = {} is out of range: {name} must be {range}", Number(*value))]
    OutOfRange {
        /// The setting.
        name: &'static str,
        /// The value that was refused.
        value: f64,
        /// The range in words.
        range: &'static str,
    },
    /// The target motion does not exist.
    #[error(
        "there is no physical 1-1-1 motion at the reference omega = {} (the stop stands at {}) to take as the target: \
         choose another --reference, or give --target",
        Number(*omega),
        Number(*gap)
    )]
    NoTarget {
        /// The reference frequency.
        omega: f64,
        /// The gap of the stop: δ, the half clearance, of the paper's.
        gap: f64,
    },
    /// Newton's method does not come from the target to a fixed point of the section's map.
    #[error(
        "Newton's method finds no fixed point of the section from the target: give one nearer to it (--target), and the section of a \
         stop that the motion strikes once in its period (--stop)"
    )]
    NoFixedPoint,
    /// Kicks along one component do not hold a motion that is unstable in so many directions, or turns.
    #[error(
        "the fixed point has {0} multipliers outside the unit circle: these kicks hold a motion with one real one; \
         choose another target, or another method"
    )]
    TooUnstable(usize),
    /// The unstable direction is out of the kicks' reach.
    #[error(
        "a kick of the velocity after the impact does not reach the unstable direction: choose another method"
    )]
    NotReached,
    /// No motion of the system is known that could be the target; with the components by name.
    #[error(
        "there is no symmetric 1-1-1 motion of this system to take as the target: give the target itself, {0} \
         (--target)"
    )]
    TargetNeeded(String),
    /// Not as many values as a point on the section has components.
    #[error(
        "{what}: {given} numbers are given, but a point on this section has {wanted} components: {names}"
    )]
    Count {
        /// What was given.
        what: &'static str,
        /// How many values were given.
        given: usize,
        /// How many there must be.
        wanted: usize,
        /// The components by name.
        names: String,
    },
    /// The direction of a stop has turned.
    #[error(
        "the target begins with v{own}, but here a point on the section is {names}, since the stop's direction is another: \
         let nothing that turns it vary"
    )]
    OtherComponents {
        /// The coordinate whose velocity the target begins with, from 1.
        own: usize,
        /// The components of the section by name.
        names: String,
    },
    /// The system has no such stop, component or coordinate.
    #[error("there is no {what} {number}: this system has {count}, numbered from 0")]
    NoSuch {
        /// "stop", "component of the section" or "coordinate".
        what: &'static str,
        /// The number that was given.
        number: usize,
        /// How many there are.
        count: usize,
    },
    /// A component of the target is NaN or infinite.
    #[error("the target has a component of {}: give finite numbers", Number(*.0))]
    TargetNotFinite(f64),
    /// The target's velocity leads into the stop.
    #[error(
        "the target velocity {name} = {} leads into the stop of the section: just after an impact there the masses \
         part from it, or rest on it; change its sign",
        Number(*velocity)
    )]
    TargetVelocity {
        /// The component.
        name: String,
        /// Its value.
        velocity: f64,
    },
    /// The target's phase is not one.
    #[error("the target phase tau = {} is out of range: tau must be between 0 and 2π (6.2832)", Number(*.0))]
    TargetPhase(f64),
    /// The reference frequency cannot be used.
    #[error("the reference frequency omega = {} is out of range: it must be greater than 0, and finite", Number(*.0))]
    Reference(f64),
    /// An option cannot be used; what is wrong with it, in words.
    #[error("{0}")]
    Option(String),
    /// The system cannot be followed.
    #[error(transparent)]
    System(#[from] SystemError),
}

impl ControlError {
    /// Whether it stands in the way of one system alone, not of its neighbours: the motion that control aims at does not exist there, or
    /// cannot be held.
    pub fn is_of_one_system(&self) -> bool {
        use ControlError::{NoFixedPoint, NoTarget, NotReached, TooUnstable};
        matches!(self, NoTarget { .. } | NoFixedPoint | TooUnstable(_) | NotReached)
    }
}
