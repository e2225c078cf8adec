// A leg that ends within the stops but comes near to one: it touches it and returns, or turns before.

// Whether a leg turns off its stop and stays off all others, on its way to where it turns about, the share `u` of it, and from
// there on.
fn turns_off(before: Point, middle: Point, after: Point, end: End, u: f32, window: f32) -> bool {
    let time = u * window;
    let within = (0.0 < time) & (time < window);
    let direction = flight.normals[end.normal].direction;
    let left = face_gap(end) - end_sign(end) * along(direction, middle.state.x);
    let rounding = stop_rounding(end, middle.state, window * along(direction, middle.state.v));
    return within
        & (rounding < left)
        & leg_clears(before, middle, time)
        & leg_clears(middle, after, window - time);
}

// Whether a leg that returns from a stop, which it meets with the speed `arrives`, would go beyond it by more than rounding.
fn is_deep(arrives: f32, pulls: vec2<f32>, bound: f32, window: f32, rounding: f32) -> bool {
    let least = pulled(pulls, bound, window).x;
    return (rounding + rounding) * max(-least, 0.0) < arrives * arrives;
}

// Between what the acceleration towards the stop lies all along a leg.
fn pulled(pulls: vec2<f32>, bound: f32, window: f32) -> vec2<f32> {
    let swelling = (window * window) * (bound * 0.125);
    return vec2(min(pulls.x, pulls.y) - swelling, max(pulls.x, pulls.y) + swelling);
}
