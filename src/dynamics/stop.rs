//! Stops, and which of them are in contact.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::vector::MOST;
use crate::model::{Flight, Real};

/// One of a plant's rigid stops, by its place in the plant's order; the first by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Stop(pub u8);

impl Stop {
    /// A, at x1 = +δ: the first stop of the paper's oscillator.
    pub const A: Stop = Stop(0);
    /// Ā, at x1 = −δ: the second stop of the paper's oscillator.
    pub const B: Stop = Stop(1);

    /// Its place in the plant's order.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// +1 at A, −1 at Ā: the direction in which the stop of the paper's oscillator is approached.
    #[inline(always)]
    pub fn side<T: Real>(self) -> T {
        if self == Stop::A { T::one() } else { -T::one() }
    }
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", char::from(b'A' + self.0))
    }
}

/// An end of a contact normal: the upper one is met where d·x grows, the lower one where it falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct End {
    /// The normal.
    pub normal: usize,
    /// 0 for the upper end, 1 for the lower one.
    pub side: usize,
}

impl End {
    /// +1 at the upper end, −1 at the lower one.
    #[inline(always)]
    pub fn sign<T: Real>(self) -> T {
        if self.side == 0 { T::one() } else { -T::one() }
    }
}

/// The ends of contact normals on which masses rest, pressed: none in free flight.
///
/// Bit k stands for the upper end of normal k, bit k + 4 for its lower end. Both at once clamp the masses for ever: the
/// limit of a closing clearance. The codes are those of the GPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contact(u32);

impl Contact {
    /// Free flight.
    pub const FREE: Contact = Contact(0);

    /// Both ends of a normal at once.
    #[must_use]
    pub fn clamped(self, normal: usize) -> Self {
        Contact(self.0 | (1 << normal) | (1 << (normal + MOST)))
    }

    /// The same contacts and one more.
    #[inline(always)]
    #[must_use]
    pub fn with(self, end: End) -> Self {
        Contact(self.0 | (1 << (end.normal + MOST * end.side)))
    }

    /// The same contacts without those of one normal.
    #[inline(always)]
    #[must_use]
    pub fn without(self, normal: usize) -> Self {
        Contact(self.0 & !((1 << normal) | (1 << (normal + MOST))))
    }

    /// The same contacts and every end of the normals that hold.
    #[inline(always)]
    #[must_use]
    pub fn with_opposite_ends(self) -> Self {
        let held = self.held();
        Contact(held | (held << MOST))
    }

    /// The normals that hold, bit by bit.
    #[inline(always)]
    pub fn held(self) -> u32 {
        (self.0 | (self.0 >> MOST)) & ((1 << MOST) - 1)
    }

    /// The contacts that are not among `earlier` ones.
    #[inline(always)]
    #[must_use]
    pub fn since(self, earlier: Contact) -> Self {
        Contact(self.0 & !earlier.0)
    }

    /// Whether nothing is in contact.
    #[inline(always)]
    pub fn is_free(self) -> bool {
        self.0 == 0
    }

    /// Whether an end is in contact.
    #[inline(always)]
    pub fn includes(self, end: End) -> bool {
        (self.0 >> (end.normal + MOST * end.side)) & 1 == 1
    }

    /// Whether a normal holds at both ends.
    #[inline(always)]
    pub fn is_clamped_along(self, normal: usize) -> bool {
        ((self.0 >> normal) & (self.0 >> (normal + MOST))) & 1 == 1
    }

    /// The end at which a normal holds, if that contact can open: both ends together clamp the masses for ever.
    #[inline(always)]
    pub fn opening_along(self, normal: usize) -> Option<End> {
        self.end_along(normal).filter(|_| !self.is_clamped_along(normal))
    }

    /// Whether some normal holds at both ends.
    #[inline(always)]
    pub fn is_clamped(self) -> bool {
        self.0 & (self.0 >> MOST) != 0
    }

    /// Whether everything that is in contact is clamped.
    #[inline(always)]
    pub fn is_clamped_only(self) -> bool {
        let lower = self.0 >> MOST;
        !self.is_free() && self.0 & ((1 << MOST) - 1) == lower
    }

    /// The end at which a normal holds, the upper one where it is clamped.
    #[inline(always)]
    pub fn end_along(self, normal: usize) -> Option<End> {
        for side in 0..2 {
            let end = End { normal, side };
            if self.includes(end) {
                return Some(end);
            }
        }
        None
    }

    /// The stops of these contacts.
    pub fn stops<T, const N: usize>(self, flight: &Flight<T, N>) -> impl Iterator<Item = Stop> {
        let ends = (0..MOST).flat_map(|normal| [0, 1].map(|side| End { normal, side }));
        ends.filter(move |&end| self.includes(end)).map(|end| Stop(flight.normals[end.normal].stop[end.side]))
    }

    /// The code of the GPU.
    pub fn code(self) -> u32 {
        self.0
    }
}
