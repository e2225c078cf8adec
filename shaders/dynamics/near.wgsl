// Flights of half a step at most, from either end of it: a Taylor polynomial of fixed order.

fn point_flown_near(point: Point, s: f32) -> Point {
    let square = s * s;
    let turn = flight.omega * s;
    let springs = columns_scaled(square, flight.stiffness);
    let dampers = columns_scaled(s, flight.damping);
    let force_sin = s * flight.sin;
    let force_cos = s * flight.cos;
    var before = point.state.v;
    let loaded = flight.load + applied(flight.stiffness, point.state.x);
    let forced = (s * loaded + point.sin * force_sin) + point.cos * force_cos;
    var last = applied_onto(dampers, before, forced);
    var phasor = vec2(point.cos * turn, -(point.sin * turn));
    var velocity = before;
    var mean = before;
    var phase = vec2(point.sin, point.cos);
    //: each contact term
    velocity = velocity + INVERSE_FACTORIALS[$k] * last;
    mean = mean + INVERSE_FACTORIALS[$k + 1] * last;
    phase = phase + INVERSE_FACTORIALS[$k] * phasor;
    let pulled$k = applied_onto(springs, before, phasor.x * force_sin + phasor.y * force_cos);
    before = last;
    last = applied_onto(dampers, last, pulled$k);
    phasor = vec2(phasor.y * turn, -(phasor.x * turn));
    //: end
    return Point(State(point.state.x + s * mean, velocity), phase.x, phase.y);
}

// A point a little later, and x'' then.
struct Slid {
    point: Point,
    acceleration: X,
}

// The point a time s later, so short that its fourth power is lost in rounding.
fn point_slid(point: Point, s: f32, acceleration: X, jerk: X, snap: X) -> Slid {
    let half = s * 0.5;
    let third = s * THIRD;
    let mean = point.state.v + half * (acceleration + third * jerk);
    let steady = acceleration + half * (jerk + third * snap);
    let turn = flight.omega * s;
    let half_turn = turn * 0.5;
    let third_turn = turn * THIRD;
    let sine = third_turn * point.cos + point.sin;
    let cosine = -third_turn * point.sin + point.cos;
    let later = Point(
        State(point.state.x + s * mean, point.state.v + s * steady),
        turn * (point.cos - half_turn * sine) + point.sin,
        -turn * (point.sin + half_turn * cosine) + point.cos,
    );
    return Slid(later, acceleration + s * (jerk + half * snap));
}
