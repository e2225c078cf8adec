// Flights of half a step at most, from either end of it: a Taylor polynomial of fixed order.

fn point_flown_near(point: Point, s: f32) -> Point {
    let square = s * s;
    let turn = flight.omega * s;
    let opposite = -(turn * turn);
    let springs = columns_scaled(square, flight.stiffness);
    let dampers = columns_scaled(s, flight.damping);
    let now = s * (point.cos * flight.cos + point.sin * flight.sin);
    let later = s * (-point.sin * flight.cos + point.cos * flight.sin);
    var before = point.state.v;
    let loaded = flight.load + applied(flight.stiffness, point.state.x);
    var last = applied_onto(dampers, before, s * loaded + now);
    var velocity = before;
    var mean = before;
    // sin ωs and cos ωs − 1 are the sums of the odd and of the even powers, each over its factorial.
    var even = opposite;
    var odd = turn;
    var sine = turn;
    var versed = 0.0;
    //: each pair of contact terms
    velocity = velocity + INVERSE_FACTORIALS[$k] * last;
    mean = mean + INVERSE_FACTORIALS[$l] * last;
    versed = even * INVERSE_FACTORIALS[$l] + versed;
    let pulled$k = applied_onto(springs, before, odd * later);
    before = last;
    last = applied_onto(dampers, last, pulled$k);
    odd = odd * opposite;
    velocity = velocity + INVERSE_FACTORIALS[$l] * last;
    mean = mean + INVERSE_FACTORIALS[$l + 1] * last;
    sine = odd * INVERSE_FACTORIALS[$l + 1] + sine;
    let pulled$l = applied_onto(springs, before, even * now);
    before = last;
    last = applied_onto(dampers, last, pulled$l);
    even = even * opposite;
    //: end
    return Point(
        State(point.state.x + s * mean, velocity),
        point.cos * sine + (point.sin * versed + point.sin),
        -point.sin * sine + (point.cos * versed + point.cos),
    );
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
