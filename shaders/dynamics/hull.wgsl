// Between what a motion lies that is known at both ends of a time: the hull of five Bernstein coefficients.

// The lowest and the highest of the inner three, and the middle one of the lower bound, which is a NaN where anything is.
struct Hull {
    lowest: f32,
    highest: f32,
    lower: f32,
}

// Of what is `ends` at both ends of a time `window`, with the derivatives `slopes`; `bound` is on its fourth derivative.
fn hull_of(ends: vec2<f32>, slopes: vec2<f32>, bound: f32, window: f32) -> Hull {
    let quarter = window * 0.25;
    let square = window * window;
    let margin = ((square * square) * SWELLING) * bound;
    let second = slopes.x * quarter + ends.x;
    let fourth = ends.y - slopes.y * quarter;
    let sixth = window * SIXTH;
    let begins = slopes.x * sixth + ends.x * 0.5;
    let middle = ends.y * 0.5 + (-slopes.y * sixth + begins);
    let lower = middle - margin;
    return Hull(min(min(second, fourth), lower), max(max(second, fourth), middle + margin), lower);
}
