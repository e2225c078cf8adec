// A leg that ends within the stops but comes near to one: it touches it and returns, or turns before, or not on its way.

// Whether a leg turns off its stop and stays off all others, on its way to a `middle`, where it turns or comes near, and from there
// on; the share `u` of it lies before, and `rest` of a whole step is left then.
fn turns_off(before: Alongs, middle: Along, end: Point, stop: End, u: f32, rest: f32, window: f32) -> bool {
    let time = u * window;
    let left = face_gap(stop) - end_sign(stop) * middle.place;
    let rounding = stop_rounding(stop, end.state, window, window * middle.speed);
    let each = course_each(before, end, rest, window * flight.inverse_h, stop.normal, middle);
    var off = (0.0 < time) & (time < window) & (rounding < left);
    //: each normal
    let bound$k = point_bound(end, $ku);
    let first$k = leg_clearance(before[$k], each[$k], time, bound$k, $ku);
    let second$k = leg_clearance(each[$k], along_of(end, $ku), window - time, bound$k, $ku);
    off = off & first$k.upper & first$k.lower & second$k.upper & second$k.lower;
    //: end
    return off;
}

// Whether a leg that returns from a stop, which it meets with the speed `arrives`, would go beyond it by more than rounding; the
// acceleration towards it is `pulls` there and at the end of the leg.
fn is_deep(arrives: f32, pulls: vec2<f32>, bound: f32, window: f32, rounding: f32) -> bool {
    let swelling = (window * window) * (bound * 0.125);
    let least = min(pulls.x, pulls.y) - swelling;
    return (rounding + rounding) * max(-least, 0.0) < arrives * arrives;
}
