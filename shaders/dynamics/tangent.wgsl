// A small deviation from the motion: (x1, x2, v1, v2), carried through flight and impact.

fn tangent_seed() -> vec4<f32> {
    return vec4(0.5, 0.5, 0.5, 0.5);
}

fn tangent_stepped(tangent: vec4<f32>) -> vec4<f32> {
    return (flight.phi[0] * tangent.x + flight.phi[1] * tangent.y)
        + (flight.phi[2] * tangent.z + flight.phi[3] * tangent.w);
}

fn tangent_flown(tangent: vec4<f32>, s: f32, free: f32) -> vec4<f32> {
    let series = series_new(s, free);
    var before = tangent.zw;
    var last = series_first(series, tangent.xy, before);
    var velocity = before;
    var mean = before;
    var power = 1.0;
    for (var k = 1u; k <= ORDER; k++) {
        let weight = INVERSE_FACTORIALS[k];
        velocity = velocity + weight * last;
        mean = mean + INVERSE_FACTORIALS[k + 1u] * last;
        power = power * series.reach;
        if power * weight < TRUNCATION {
            break;
        }
        let next = series_next(series, before, last, vec2(0.0, 0.0));
        before = last;
        last = next;
    }
    return vec4(tangent.xy + mean * s, velocity);
}

// The saltation of an impact, Eq. (3).
fn tangent_struck(tangent: vec4<f32>, velocity: f32, kick: f32, before: f32, after: f32) -> vec4<f32> {
    let shift = tangent.x / velocity;
    let damper = flight.inverse_mass * flight.coupling_damping * kick;
    return vec4(
        -(flight.r * tangent.x),
        tangent.y,
        (flight.r * before + after) * shift - flight.r * tangent.z,
        tangent.w + damper * shift,
    );
}

fn tangent_length(tangent: vec4<f32>) -> f32 {
    let squares = tangent * tangent;
    return sqrt((squares.x + squares.y) + (squares.z + squares.w));
}
