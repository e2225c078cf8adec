// Numbers: tests that drivers may not optimise away, and sums that end at the largest.

// Whether a value is neither infinite nor NaN, by its exponent bits: `x != x` does not see a NaN everywhere.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

// The sum of two counts, or the largest number where it is larger.
fn saturating(a: u32, b: u32) -> u32 {
    return a + min(b, ~a);
}
