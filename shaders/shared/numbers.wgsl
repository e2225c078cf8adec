// Numbers: tests that drivers may not optimise away.

// Whether a value is neither infinite nor NaN, by its exponent bits: `x != x` does not see a NaN everywhere.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}
