//! What is computed without allocation for the sizes that plants have.

/// An expression in a constant that stands for a size: one of the given ones, if it is, and another expression otherwise.
macro_rules! sized {
    ($size:expr, $n:ident of $($known:literal)*: $fixed:expr, else $other:expr) => {
        match $size {
            $($known => {
                const $n: usize = $known;
                $fixed
            })*
            _ => $other,
        }
    };
}

pub(crate) use sized;
