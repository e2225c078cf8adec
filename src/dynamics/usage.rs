//! How well the lanes were used.

use std::ops::AddAssign;

/// What lanes could have done, and what they did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Usage {
    /// Steps of flight that the lanes had room for.
    pub step_slots: u64,
    /// Steps that clear the stops, and were taken in that room; those taken in rounds of contacts are not counted.
    pub steps: u64,
    /// Contacts that the lanes had room for.
    pub contact_slots: u64,
    /// Contacts that were certain, and were met directly.
    pub contacts: u64,
    /// Contacts that were not: they were approached from the safe side, one trajectory by itself.
    pub fallbacks: u64,
}

impl Usage {
    /// The share of the room for steps that was used.
    pub fn share_of_steps(&self) -> f64 {
        share(self.steps, self.step_slots)
    }

    /// The share of the room for contacts that was used.
    pub fn share_of_contacts(&self) -> f64 {
        share(self.contacts, self.contact_slots)
    }

    /// The share of the contacts that lanes came to which were not certain.
    pub fn share_of_fallbacks(&self) -> f64 {
        share(self.fallbacks, self.contacts + self.fallbacks)
    }
}

impl AddAssign for Usage {
    fn add_assign(&mut self, other: Self) {
        self.step_slots += other.step_slots;
        self.steps += other.steps;
        self.contact_slots += other.contact_slots;
        self.contacts += other.contacts;
        self.fallbacks += other.fallbacks;
    }
}

/// A share of a whole; 0 of nothing.
fn share(part: u64, whole: u64) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
