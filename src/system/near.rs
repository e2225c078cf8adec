//! Numbers that are the same but for rounding.

/// Two numbers are the same within this, relative to the largest that they are compared with.
pub const SAME: f64 = 8.0 * f64::EPSILON;

/// Whether two numbers are the same within [`SAME`].
#[inline]
pub fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}
