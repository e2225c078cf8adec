// Quotients and square roots, correctly rounded whatever the driver's are: they are corrected by what they leave, which is
// computed without error. Every sum and product here is rounded by itself.

// What a product loses when it is rounded (T. J. Dekker, Numerische Mathematik 18 (1971) 224-242, doi:10.1007/BF01397083).
fn exact_product_error(a: f32, b: f32, product: f32) -> f32 {
    let a_wide = 4097.0 * a;
    let a_high = a_wide - (a_wide - a);
    let a_low = a - a_high;
    let b_wide = 4097.0 * b;
    let b_high = b_wide - (b_wide - b);
    let b_low = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

// total - a b, without error where a b is near the total.
fn exact_rest(total: f32, a: f32, b: f32) -> f32 {
    let product = a * b;
    return (total - product) - exact_product_error(a, b, product);
}

// The number that is so many units in the last place further from 0.
fn exact_neighbour(value: f32, steps: i32) -> f32 {
    return bitcast<f32>(u32(i32(bitcast<u32>(value)) + steps));
}

// Half the distance of a positive number from the next, or, where it is a power of two, from the one before.
fn exact_half_unit(value: f32, below: bool) -> f32 {
    let bits = bitcast<u32>(value);
    let unit = bitcast<f32>((bits & 0x7f800000u) - 0x0c000000u);
    return select(unit, 0.5 * unit, below & ((bits & 0x007fffffu) == 0u));
}

// Whether nothing overflows or underflows on the way, what is small being scaled.
fn exact_is_ordinary(value: f32) -> bool {
    return (abs(value) > 1e-34) & (abs(value) < 1e12);
}

// What a number is multiplied by where it is small, so that nothing underflows that is computed with it, and what undoes that.
fn exact_scale(value: f32) -> vec2<f32> {
    return select(vec2(1.0), vec2(0x1p+76, 0x1p-76), abs(value) < 1e-12);
}

fn exact_quotient(dividend: f32, divisor: f32) -> f32 {
    let near = dividend / divisor;
    if !exact_is_ordinary(dividend) | !exact_is_ordinary(divisor) {
        return near;
    }
    if (abs(near) < 1e-34) | (abs(near) > 1e34) {
        return near;
    }
    let up = exact_scale(dividend);
    let down = exact_scale(divisor);
    let a = abs(dividend) * up.x;
    let b = abs(divisor) * down.x;
    let guess = abs(near) * (up.x * down.y);
    let nearer = guess + exact_rest(a, guess, b) / b;
    let rest = exact_rest(a, nearer, b);
    var quotient = nearer;
    if rest > exact_half_unit(nearer, false) * b {
        quotient = exact_neighbour(nearer, 1);
    } else if -rest > exact_half_unit(nearer, true) * b {
        quotient = exact_neighbour(nearer, -1);
    }
    return select(quotient, -quotient, near < 0.0) * (up.y * down.x);
}

fn exact_root(square: f32) -> f32 {
    let near = sqrt(square);
    if !exact_is_ordinary(square) {
        return near;
    }
    let scale = exact_scale(square).x;
    let scaled = square * scale;
    // The roots of that scale and of what undoes it.
    let of_root = select(vec2(1.0), vec2(0x1p+38, 0x1p-38), scale > 1.0);
    let guess = near * of_root.x;
    let nearer = guess + exact_rest(scaled, guess, guess) / (2.0 * guess);
    let rest = exact_rest(scaled, nearer, nearer);
    var root = nearer;
    if rest > 2.0 * exact_half_unit(nearer, false) * nearer {
        root = exact_neighbour(nearer, 1);
    } else if -rest >= 2.0 * exact_half_unit(nearer, true) * nearer {
        root = exact_neighbour(nearer, -1);
    }
    return root * of_root.y;
}
