// A point of the motion and its flight.

// State and forcing phasor at one instant.
struct Point {
    state: State,
    sin: f32,
    cos: f32,
}

// How the masses move for the next instants, with the contacts that hold: x'', x''', what presses on each contact, and
// its derivative.
struct Motion {
    acceleration: X,
    jerk: X,
    pressing: array<f32, NORMALS>,
    pressing_rate: array<f32, NORMALS>,
}

// How a motion goes on along one normal: (d·x)'', (d·x)''', and a bound on |(d·x)''''|.
struct Approach {
    acceleration: f32,
    jerk: f32,
    bound: f32,
}

fn point_at_phase_zero(state: State) -> Point {
    return Point(state, 0.0, 1.0);
}

// One whole step h of free flight.
fn point_stepped(point: Point) -> Point {
    let sine = state_plus(flight.gamma_one, point.sin, flight.gamma_sin);
    let forced = state_plus(sine, point.cos, flight.gamma_cos);
    return point_turned(point, state_flown_onto(forced, point.state));
}

// A state with the forcing phasor of a point turned by a whole step.
fn point_turned(point: Point, state: State) -> Point {
    return Point(
        state,
        point.sin * flight.turn_cos + point.cos * flight.turn_sin,
        point.cos * flight.turn_cos + -(point.sin * flight.turn_sin),
    );
}

// What one step makes of a deviation.
fn state_flown(deviation: State) -> State {
    return state_flown_onto(State(X(0.0), X(0.0)), deviation);
}

// The same on top of a state.
fn state_flown_onto(base: State, deviation: State) -> State {
    var state = base;
    //: each coordinate
    state = state_plus(state, deviation.x$c, flight.phi_x[$i]);
    //: end
    //: each coordinate
    state = state_plus(state, deviation.v$c, flight.phi_v[$i]);
    //: end
    return state;
}

// A flight of length s ≤ h with the contacts that hold; in free flight s may be negative.
fn point_flown(point: Point, s: f32, contact: u32) -> Point {
    let series = series_under(s, contact);
    let turn = flight.omega * s;
    let force_sin = s * spared(contact, flight.sin);
    let force_cos = s * spared(contact, flight.cos);
    var before = point.state.v;
    let first = series_first(series, contact, point.state.x, before);
    var last = ((first + point.sin * force_sin) + point.cos * force_cos) + s * spared(contact, flight.load);
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
        let next = series_next(series, before, last, phasor.x * force_sin + phasor.y * force_cos);
        before = last;
        last = next;
        phasor = vec2(phasor.y * turn, -(phasor.x * turn));
    }
    return Point(State(point.state.x + s * mean, velocity), phase.x, phase.y);
}

// What a change of d·v by 1 has become after the share u of a step.
fn wake(normal: u32, u: f32) -> State {
    var sum = normal_term(normal, KICK_ORDER);
    //: each kick term
    sum = state_plus(normal_term(normal, $ku), u, sum);
    //: end
    return sum;
}

// The row that gives d·x of a deviation before the share u of a step, from the deviation after it.
fn look_back(normal: u32, u: f32) -> State {
    var sum = normal_term(normal, KICK_TERMS + BACK_ORDER);
    //: each back term
    sum = state_plus(normal_term(normal, KICK_TERMS + $ku), u, sum);
    //: end
    return sum;
}

// The point with a speed changed by `kick` some time ago, `wake` being what a change by 1 has become.
fn point_kicked(point: Point, kick: f32, wake: State) -> Point {
    return Point(state_plus(point.state, kick, wake), point.sin, point.cos);
}

// The point a time s later, so short that its square is lost in rounding.
fn point_nudged(point: Point, s: f32, contact: u32) -> Point {
    let acceleration = spared(contact, point_accelerations(point));
    let turn = flight.omega * s;
    return Point(
        State(point.state.x + s * point.state.v, point.state.v + s * acceleration),
        point.sin + point.cos * turn,
        point.cos - point.sin * turn,
    );
}

// x'' in free flight.
fn point_accelerations(point: Point) -> X {
    return point_accelerations_under(point, flight.load);
}

// The same under another load.
fn point_accelerations_under(point: Point, load: X) -> X {
    let forced = (load + point.sin * flight.sin) + point.cos * flight.cos;
    let pulled = applied_onto(flight.stiffness, point.state.x, forced);
    return applied_onto(flight.damping, point.state.v, pulled);
}

// x''' in free flight, from x''.
fn point_jerks(point: Point, acceleration: X) -> X {
    let turned = -(flight.omega * point.sin) * flight.cos;
    let forced = turned + (flight.omega * point.cos) * flight.sin;
    let pulled = applied_onto(flight.stiffness, point.state.v, forced);
    return applied_onto(flight.damping, acceleration, pulled);
}

// What decides when a stop can be reached, or left.
fn point_motion(point: Point, contact: u32) -> Motion {
    return point_motion_under(point, contact, flight.load);
}

// The same under another load.
fn point_motion_under(point: Point, contact: u32, load: X) -> Motion {
    let a = held(contact, point_accelerations_under(point, load));
    let j = held(contact, point_jerks(point, a.rest));
    return Motion(a.rest, j.rest, a.pressing, j.pressing);
}

// A bound on |(d·x)''''| along a normal (in contact: on the second derivative of what presses on it) for less than a step before
// the point, or after it.
fn point_bound(point: Point, normal: u32) -> f32 {
    let of_x = flight.normals[normal].bound_x;
    let of_v = flight.normals[normal].bound_v;
    return bound_of(of_x, of_v, point.state.x, point.state.v, bound_forcing(normal));
}

fn bound_forcing(normal: u32) -> f32 {
    return flight.normals[normal].bound_forcing;
}

// A bound on the second derivative of what presses on a contact, likewise, while those hold.
fn point_pressed_bound(point: Point, contact: u32, normal: u32) -> f32 {
    let at = others_place(contact, normal);
    let of_x = flights[flow].pressed_x[at];
    let of_v = flights[flow].pressed_v[at];
    return bound_of(of_x, of_v, point.state.x, point.state.v, pressed_forcing(contact, normal));
}

// A bound on its fourth derivative, likewise: x'' flows like x, forced by −ω² times as much.
fn motion_pressed_bound(motion: Motion, contact: u32, normal: u32) -> f32 {
    let at = others_place(contact, normal);
    let of_x = flights[flow].pressed_x[at];
    let of_v = flights[flow].pressed_v[at];
    return motion_bounded(motion, of_x, of_v, pressed_forcing(contact, normal));
}

// What a bound says of x'' in place of x.
fn motion_bounded(motion: Motion, of_x: X, of_v: X, forcing: f32) -> f32 {
    return bound_of(of_x, of_v, motion.acceleration, motion.jerk, forcing * (flight.omega * flight.omega));
}

fn pressed_forcing(contact: u32, normal: u32) -> f32 {
    return flights[flow].pressed_forcing[others_place(contact, normal)];
}

// Where a bound stands by the contacts that hold beside a normal: by their bits.
fn others_place(contact: u32, normal: u32) -> u32 {
    let held = contact_held(contact);
    let below = held & ((1u << normal) - 1u);
    return normal * OTHERS + (below | ((held >> (normal + 1u)) << normal));
}

fn bound_of(of_x: X, of_v: X, x: X, v: X, forcing: f32) -> f32 {
    var of_places = forcing;
    var of_speeds = 0.0;
    //: each coordinate
    of_places = of_x$c * abs(x$c) + of_places;
    of_speeds = of_v$c * abs(v$c) + of_speeds;
    //: end
    return of_places + of_speeds;
}

fn point_approach(point: Point, motion: Motion, normal: u32) -> Approach {
    return motion_approach(motion, flight.normals[normal].direction, point_bound(point, normal));
}

fn motion_approach(motion: Motion, direction: X, bound: f32) -> Approach {
    return Approach(along(direction, motion.acceleration), along(direction, motion.jerk), bound);
}
