// A small deviation of the points on the section, carried through flight and control.

var<private> deviations: array<array<f32, 4>, DELAYS>;

fn deviation_at(i: u32) -> vec4<f32> {
    let d = deviations[i];
    return vec4(d[0], d[1], d[2], d[3]);
}

fn deviations_seed() {
    for (var i = 1u; i < DELAYS; i++) {
        deviations[i] = array<f32, 4>(0.0, 0.0, 0.0, 0.0);
    }
    deviations[0] = array<f32, 4>(0.5, 0.5, 0.5, 0.5);
}

// The rates of (x1, x2, v1, v2) at the trajectory's present point.
fn deviation_rates() -> vec4<f32> {
    return vec4(trajectory.point.state.v, point_motion(trajectory.point, trajectory.contact).acceleration);
}

// The deviation, at fixed time, of the trajectory that leaves the present point.
fn deviations_leaving() -> State {
    let present = deviation_at(0u);
    let shift = present.w / flight.omega;
    let deviation = vec4(0.0, present.y, present.x, present.z) - shift * deviation_rates();
    return State(deviation.xy, deviation.zw);
}

// The deviation of the point at which the trajectory arrives.
fn deviations_arrived() -> vec4<f32> {
    let rate = deviation_rates();
    var shift = 0.0;
    if rate.x != 0.0 {
        shift = -(tangent.x.x / rate.x);
    }
    return vec4(
        tangent.v.x + rate.z * shift,
        tangent.x.y + rate.y * shift,
        tangent.v.y + rate.w * shift,
        flight.omega * shift,
    );
}

// What control makes of the deviation of an arriving point.
fn deviations_passed(seen: Seen, arrived: vec4<f32>) -> vec4<f32> {
    if control.method == METHOD_SINE {
        return sine_deviated(seen, deviation_at(0u), arrived);
    }
    if control.method == METHOD_PULSE && pulse_is_due(seen) {
        return vec4(0.0, 0.0, 0.0, 0.0);
    }
    if control.method == METHOD_DELAY {
        return arrived + delay_feedback(deviation_at(0u) - deviation_at(control.delay));
    }
    return arrived;
}

fn deviations_push(deviation: vec4<f32>) {
    for (var i = DELAYS - 1u; i > 0u; i--) {
        deviations[i] = deviations[i - 1u];
    }
    deviations[0] = array<f32, 4>(deviation.x, deviation.y, deviation.z, deviation.w);
}

// The factor by which the deviation has grown; it is brought back to unit length. 0 where it is lost.
fn deviations_growth() -> f32 {
    var squares = 0.0;
    for (var i = 0u; i < DELAYS; i++) {
        let d = deviation_at(i);
        let square = d * d;
        squares = squares + ((square.x + square.y) + (square.z + square.w));
    }
    let length = sqrt(squares);
    if !(length > 0.0 && is_finite(length)) {
        deviations_seed();
        return 0.0;
    }
    let factor = 1.0 / length;
    for (var i = 0u; i < DELAYS; i++) {
        let d = deviation_at(i) * factor;
        deviations[i] = array<f32, 4>(d.x, d.y, d.z, d.w);
    }
    return length;
}
