// A point of the motion and its free flight.

// State and forcing phasor at one instant.
struct Point {
    x1: f32,
    x2: f32,
    v1: f32,
    v2: f32,
    sin: f32,
    cos: f32,
}

// How the first mass moves for the next instants: x1'', x1''', and a bound on |x1''''|.
struct Motion {
    acceleration: f32,
    jerk: f32,
    bound: f32,
}

fn point_at_phase_zero(state: vec4<f32>) -> Point {
    return Point(state.x, state.y, state.z, state.w, 0.0, 1.0);
}

fn point_state(point: Point) -> vec4<f32> {
    return vec4(point.x1, point.x2, point.v1, point.v2);
}

// One whole step h of free flight.
fn point_stepped(point: Point) -> Point {
    let y = (flight.phi[0] * point.x1 + flight.phi[1] * point.x2)
        + (flight.phi[2] * point.v1 + flight.phi[3] * point.v2)
        + (flight.gamma_sin * point.sin + flight.gamma_cos * point.cos);
    return Point(
        y.x,
        y.y,
        y.z,
        y.w,
        point.sin * flight.turn_cos + point.cos * flight.turn_sin,
        point.cos * flight.turn_cos - point.sin * flight.turn_sin,
    );
}

// A flight of length s ≤ h; `free` is 1 in free flight and 0 while the first mass rests on a stop.
fn point_flown(point: Point, s: f32, free: f32) -> Point {
    let series = series_new(s, free);
    let turn = flight.omega * s;
    let force = vec2(flight.force1 * (s * free), flight.force2 * s);
    var before = vec2(point.v1, point.v2);
    var last = series_first(series, vec2(point.x1, point.x2), before) + point.sin * force;
    var phasor = vec2(point.cos * turn, -(point.sin * turn));
    var velocity = before;
    var mean = before;
    var phase = vec2(point.sin, point.cos);
    var power = 1.0;
    for (var k = 1u; k <= ORDER; k++) {
        let weight = INVERSE_FACTORIALS[k];
        let lower = INVERSE_FACTORIALS[k + 1u];
        velocity = velocity + weight * last;
        mean = mean + lower * last;
        phase = phase + weight * phasor;
        power = power * series.reach;
        if power * weight < TRUNCATION {
            break;
        }
        let next = series_next(series, before, last, phasor.x * force);
        before = last;
        last = next;
        phasor = vec2(phasor.y * turn, -(phasor.x * turn));
    }
    return Point(
        point.x1 + mean.x * s,
        point.x2 + mean.y * s,
        velocity.x,
        velocity.y,
        phase.x,
        phase.y,
    );
}

// The point with v1 changed by `kick` a time s ≤ h ago.
fn point_kicked(point: Point, kick: f32, s: f32) -> Point {
    let u = s * flight.inverse_h;
    var sum = kicks[cell].terms[ORDER];
    for (var k = ORDER; k > 0u; k--) {
        sum = sum * u + kicks[cell].terms[k - 1u];
    }
    return Point(
        point.x1 + kick * sum.x,
        point.x2 + kick * sum.y,
        point.v1 + kick * sum.z,
        point.v2 + kick * sum.w,
        point.sin,
        point.cos,
    );
}

// x1'' and x2'' of Eq. (2).
fn point_accelerations(point: Point) -> vec2<f32> {
    let coupling = (point.x2 - point.x1) + flight.coupling_damping * (point.v2 - point.v1);
    let a1 = coupling + flight.force1 * point.sin;
    let a2 = (flight.force2 * point.sin - flight.ground_stiffness * point.x2)
        - (flight.ground_damping * point.v2 + flight.inverse_mass * coupling);
    return vec2(a1, a2);
}

// The point a time s later, so short that its square is lost in rounding.
fn point_nudged(point: Point, s: f32) -> Point {
    let a = point_accelerations(point);
    let turn = flight.omega * s;
    return Point(
        point.x1 + point.v1 * s,
        point.x2 + point.v2 * s,
        point.v1 + a.x * s,
        point.v2 + a.y * s,
        point.sin + point.cos * turn,
        point.cos - point.sin * turn,
    );
}

fn point_bound(point: Point) -> f32 {
    return (flight.bound.x * abs(point.x1) + flight.bound.y * abs(point.x2))
        + (flight.bound.z * abs(point.v1) + flight.bound.w * abs(point.v2))
        + flight.bound_forcing;
}

// What decides when a stop can be reached (`free` = 1), or left (`free` = 0).
fn point_motion(point: Point, free: f32) -> Motion {
    let a = point_accelerations(point);
    let jerk = ((point.v2 - point.v1) + flight.coupling_damping * (a.y - free * a.x))
        + flight.force1 * flight.omega * point.cos;
    return Motion(a.x, jerk, point_bound(point));
}
