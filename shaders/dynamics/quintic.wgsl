// The gap to a stop along a leg, as the polynomial of fifth degree that agrees with it at both ends.

// Its coefficients: the two lowest, and the others.
struct Quintic {
    low: vec2<f32>,
    high: vec4<f32>,
}

// Where a gap is narrowest, or near its narrower end, how wide it is there, and its second derivative before the last of Newton's
// steps.
struct Narrowest {
    u: f32,
    gap: f32,
    bend: f32,
}

// With the same places and slopes at the two ends, and such coefficients of u² and u³.
fn quintic_through(places: vec2<f32>, slopes: vec2<f32>, bend: f32, twist: f32) -> Quintic {
    let change = places.y - places.x - slopes.x - bend - twist;
    let rise = twist * -3.0 + (slopes.y - slopes.x - (bend + bend));
    let high = vec4(bend, twist, change * 5.0 + -rise, change * -4.0 + rise);
    return Quintic(vec2(places.x, slopes.x), high);
}

// The cubic with the same places and slopes at the two ends.
fn quintic_cubic(places: vec2<f32>, slopes: vec2<f32>, window: f32) -> Quintic {
    let leaves = slopes.x * window;
    let arrives = slopes.y * window;
    let change = places.y - places.x;
    let bend = change * 3.0 - (leaves + leaves) - arrives;
    let twist = leaves + arrives - (change + change);
    return Quintic(vec2(places.x, leaves), vec4(bend, twist, 0.0, 0.0));
}

// About where a gap, open at u = 0 and closed beyond u = 1, closes.
fn quintic_chord(gaps: vec2<f32>, approach: f32) -> f32 {
    let chord = gaps.y - gaps.x + approach;
    let discriminant = approach * approach + -(4.0 * chord * gaps.x);
    let sum = abs(approach) + sqrt(max(discriminant, 0.0));
    let approaching = 0.0 < approach;
    let above = select(sum, gaps.x + gaps.x, approaching);
    let below = select(-(chord + chord), sum, approaching);
    return above / below;
}

// Where the gap closes; the last of Newton's steps takes over the slope of the one before.
fn quintic_root(c: Quintic, start: f32) -> f32 {
    let rise = quintic_rise(c);
    var u = start;
    var inverse = start;
    //: each newton step
    inverse = 1.0 / (cubic(rise, u) * u + c.low.y);
    u = -inverse * quintic_at(c, u) + u;
    //: end
    return -inverse * quintic_at(c, u) + u;
}

// Where the gap is narrowest if the motion comes near, turns and goes; where it has no extremum on the way, near its narrower end.
fn quintic_narrowest(c: Quintic, last: f32) -> Narrowest {
    let rise = quintic_rise(c);
    let bends = vec4(rise.x, rise.y + rise.y, rise.z * 3.0, rise.w * 4.0);
    var u = c.low.y / (c.low.y - last);
    var bend = rise.x;
    //: each newton step
    bend = cubic(bends, u);
    u = u - (cubic(rise, u) * u + c.low.y) / bend;
    //: end
    bend = cubic(bends, u);
    u = u - (cubic(rise, u) * u + c.low.y) / bend;
    let aside = select(1.0 - ASIDE, ASIDE, c.low.x < quintic_at(c, 1.0));
    u = select(aside, u, (0.0 < u) & (u < 1.0));
    return Narrowest(u, quintic_at(c, u), bend);
}

// How wide the gap is.
fn quintic_at(c: Quintic, u: f32) -> f32 {
    return cubic(c.high, u) * (u * u) + (c.low.y * u + c.low.x);
}

// The coefficients of how much its derivative has risen since u = 0, over u.
fn quintic_rise(c: Quintic) -> vec4<f32> {
    return vec4(c.high.x + c.high.x, c.high.y * 3.0, c.high.z * 4.0, c.high.w * 5.0);
}

// A polynomial of third degree: by pairs of terms, which wait for each other less than one term after the other does.
fn cubic(c: vec4<f32>, u: f32) -> f32 {
    return (c.w * u + c.z) * (u * u) + (c.y * u + c.x);
}

// About where a gap that is closed there opens, beyond.
fn narrowest_touch(narrowest: Narrowest) -> f32 {
    return narrowest.u + sqrt(max(-(narrowest.gap + narrowest.gap) / narrowest.bend, 0.0));
}
