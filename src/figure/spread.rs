//! How a colour bar spreads numbers.

/// How a colour bar spreads numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// By equal differences.
    Even,
    /// By equal ratios; what is not above zero has no place on it.
    Ratios,
    /// By equal differences to either side of zero.
    AboutZero,
}
