// The natural logarithm of a positive, finite number by sums, products and one quotient.
fn logarithm(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    var exponent = f32(i32(bits >> 23u) - 127);
    var mantissa = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u);
    if mantissa > SQRT_2 {
        mantissa = mantissa * 0.5;
        exponent = exponent + 1.0;
    }
    let f = (mantissa - 1.0) / (mantissa + 1.0);
    let s = f * f;
    let series = s * (INVERSE_ODD[0] + s * (INVERSE_ODD[1] + s * (INVERSE_ODD[2] + s * INVERSE_ODD[3])));
    return exponent * LN_2 + 2.0 * (f + f * series);
}
