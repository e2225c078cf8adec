//! What is computed without allocation for the sizes that plants have.

/// An expression in which a constant stands for a size, where that is one of the given ones; another expression where it is none.
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
