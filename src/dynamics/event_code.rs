//! What ended a move, as a code: what the CPU tells by an [`Event`] and the GPU by a number.

use strum::VariantArray;

use super::trajectory::Event;

/// What ended a move, without what came with it; the codes of the GPU are generated from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, VariantArray)]
#[repr(u32)]
pub enum EventCode {
    /// [`Event::Flight`].
    Flight,
    /// [`Event::StepEnd`].
    StepEnd,
    /// [`Event::HalfPeriod`].
    HalfPeriod,
    /// [`Event::Strobe`].
    Strobe,
    /// [`Event::Impact`].
    Impact,
    /// [`Event::Caught`] without rebounds.
    Caught,
    /// [`Event::Caught`] after rebounds, infinitely many.
    CompleteChatter,
    /// [`Event::Released`].
    Released,
}

impl EventCode {
    /// Whether a mass met a stop.
    pub fn is_impact(self) -> bool {
        matches!(self, EventCode::Impact | EventCode::Caught | EventCode::CompleteChatter)
    }

    /// Whether the trajectory came to the end of a step.
    pub fn ends_step(self) -> bool {
        matches!(self, EventCode::StepEnd | EventCode::HalfPeriod | EventCode::Strobe)
    }
}

impl<T> Event<T> {
    /// The event without what came with it.
    #[inline(always)]
    pub(crate) fn code(&self) -> EventCode {
        match self {
            Event::Flight => EventCode::Flight,
            Event::StepEnd => EventCode::StepEnd,
            Event::HalfPeriod => EventCode::HalfPeriod,
            Event::Strobe => EventCode::Strobe,
            Event::Impact(_) => EventCode::Impact,
            Event::Caught { complete_chatter: false, .. } => EventCode::Caught,
            Event::Caught { complete_chatter: true, .. } => EventCode::CompleteChatter,
            Event::Released(_) => EventCode::Released,
        }
    }
}
