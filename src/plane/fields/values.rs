//! The values of a field, with their type.

use num_traits::AsPrimitive;

use crate::system::named;

named! {
    /// The type of a field's values.
    pub enum Kind {
        /// Whole numbers from 0 to 255.
        U8 = "u8",
        /// Whole numbers from 0 to 65535.
        U16 = "u16",
        /// Whole numbers of 32 bits.
        U32 = "u32",
        /// Single precision.
        F32 = "f32",
        /// Double precision.
        F64 = "f64",
    }
}

/// The values of a field, of some cells one after the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Of [`Kind::U8`].
    U8(Vec<u8>),
    /// Of [`Kind::U16`].
    U16(Vec<u16>),
    /// Of [`Kind::U32`].
    U32(Vec<u32>),
    /// Of [`Kind::F32`].
    F32(Vec<f32>),
    /// Of [`Kind::F64`].
    F64(Vec<f64>),
}

/// The same of the values of any type.
macro_rules! of_any {
    ($all:expr, $values:ident => $result:expr) => {
        match $all {
            $crate::plane::fields::Values::U8($values) => $result,
            $crate::plane::fields::Values::U16($values) => $result,
            $crate::plane::fields::Values::U32($values) => $result,
            $crate::plane::fields::Values::F32($values) => $result,
            $crate::plane::fields::Values::F64($values) => $result,
        }
    };
}
pub(crate) use of_any;

impl Values {
    /// Their type.
    pub fn kind(&self) -> Kind {
        match self {
            Values::U8(_) => Kind::U8,
            Values::U16(_) => Kind::U16,
            Values::U32(_) => Kind::U32,
            Values::F32(_) => Kind::F32,
            Values::F64(_) => Kind::F64,
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        of_any!(self, values => values.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Those of some cells, `inner` of them each.
    #[must_use]
    pub fn picked(&self, cells: &[usize], inner: usize) -> Values {
        fn of<T: Copy>(values: &[T], cells: &[usize], inner: usize) -> Vec<T> {
            cells.iter().flat_map(|&cell| values[inner * cell..][..inner].iter().copied()).collect()
        }
        match self {
            Values::U8(values) => Values::U8(of(values, cells, inner)),
            Values::U16(values) => Values::U16(of(values, cells, inner)),
            Values::U32(values) => Values::U32(of(values, cells, inner)),
            Values::F32(values) => Values::F32(of(values, cells, inner)),
            Values::F64(values) => Values::F64(of(values, cells, inner)),
        }
    }

    /// One of them as a real number.
    pub fn real(&self, i: usize) -> f64 {
        of_any!(self, values => values[i].as_())
    }

    /// One of them as a whole number; what is none is 0.
    pub fn whole(&self, i: usize) -> u32 {
        of_any!(self, values => values[i].as_())
    }
}
