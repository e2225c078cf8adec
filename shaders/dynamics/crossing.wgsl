// Contact found directly: the time at which a leg meets a stop, and where, with a certificate that it meets none before.

// A contact, and the point just after the impact.
struct Crossing {
    certain: bool,
    // Whether the leg comes near to a stop, turns, and provably stays off all stops.
    passes: bool,
    end: End,
    time: f32,
    point: Point,
    velocity: f32,
    kick: f32,
    rebound: f32,
    // d·x'' before the impact.
    pull: f32,
}

// The contact of a leg that ends beyond one stop, or touches one and returns.
fn crossing_of(before: Point, after: Point, window: f32) -> Crossing {
    let face = crossing_face(before, after, window);
    let normal = face.end.normal;
    let sign = end_sign(face.end);
    let direction = flight.normals[normal].direction;
    let response = flight.normals[normal].response;
    let gap = face_gap(face.end);
    let pulls = sign * vec2(
        along(direction, point_accelerations(before)),
        along(direction, point_accelerations(after)),
    );
    let speeds = sign * vec2(along(direction, before.state.v), along(direction, after.state.v));
    let gaps = vec2(
        gap - sign * along(direction, before.state.x),
        gap - sign * along(direction, after.state.x),
    );
    let polynomial = quintic_through(gaps, speeds, pulls, window);
    var start = quintic_chord(gaps, speeds.x * window);
    // Where the leg returns, the gap is narrowest on its way.
    var passes = false;
    var turns = 0.0;
    if face.returns {
        let narrowest = quintic_narrowest(polynomial, speeds.y * window);
        turns = narrowest.u;
        passes = 0.0 < narrowest.gap;
        start = narrowest_touch(narrowest);
    }
    let u = select(quintic_root(polynomial, start), turns, passes);

    // From the nearer end of the step, and what is left of the way as if the acceleration changed steadily.
    let near = u < 0.5;
    let reached = point_flown_near(point_select(near, before, after), window * select(u - 1.0, u, near));
    if passes {
        passes = turns_off(before, reached, after, face.end, u, window);
    }
    let acceleration = point_accelerations(reached);
    let jerk = point_jerks(reached, acceleration);
    let snap = point_snaps(reached, acceleration, jerk);
    let left = gap - sign * along(direction, reached.state.x);
    let speed = sign * along(direction, reached.state.v);
    let straight = left / speed;
    let bend = sign * along(direction, acceleration);
    let turn = (sign * along(direction, jerk)) * 0.5;
    let nearly = left / ((bend * 0.5) * straight + speed);
    let far = ((turn * THIRD) * nearly + bend * 0.5) * nearly + speed;
    let steep = (turn * nearly + bend) * nearly + speed;
    let slide = nearly - (far * nearly - left) / steep;
    let slid = point_slid(reached, slide, acceleration, jerk, snap);
    let time = u * window + slide;

    let velocity = along(direction, slid.point.state.v);
    let restitution = select(
        stops.restitution[normal][1],
        stops.restitution[normal][0],
        face.end.side == 0u,
    );
    let rebound = -(restitution * velocity);
    var point = slid.point;
    let away = sign * gap - along(direction, point.state.x);
    let change = rebound - velocity;
    point.state = State(point.state.x + away * response, point.state.v + change * response);
    let result = point_accelerations(point);
    let close = abs(slide) * flight.rate < STRAIGHT;
    let within = (0.0 < time) & (time < window);
    let ways = vec2(speeds.x, sign * velocity);
    let bound = point_bound(before, normal);
    let width = stops.gap[normal][0] + stops.gap[normal][1];
    let first = crossing_is_first(face, ways, pulls, time, bound, window)
        | crossing_stays_off(face, gaps.x, width, ways, time, bound);
    let force = sign * along(direction, result);
    let parts = crossing_parts(face.end, restitution, rebound, point.state, force);
    let rounding = stop_rounding(face.end, slid.point.state, window * velocity);
    let meets = abs(away) < rounding;
    let deep = !face.returns | is_deep(ways.y, pulls, bound, window, rounding);
    let certain = face.only & close & within & first & parts & deep & meets;
    let pull = along(direction, slid.acceleration);
    return Crossing(certain, passes & !certain, face.end, time, point, velocity, change, rebound, pull);
}

// Whether a contact is the first: the way to it is monotone, or bends towards the stop while it stays off the other one.
fn crossing_is_first(
    face: Face,
    ways: vec2<f32>,
    pulls: vec2<f32>,
    time: f32,
    bound: f32,
    window: f32,
) -> bool {
    let leaves = ways.x;
    let arrives = ways.y;
    let within = pulled(pulls, bound, window);
    let sets_out = 0.0 < min(within.x, 0.0) * time + leaves;
    let comes_in = 0.0 < arrives - max(within.y, 0.0) * time;
    let bends = (0.0 < within.x) & face.opposite_clear;
    return (0.0 < arrives) & (sets_out | comes_in | bends);
}

// Whether a contact is the first since the gap lies within its hull on the way there, and that between the stops.
fn crossing_stays_off(face: Face, gap: f32, width: f32, ways: vec2<f32>, time: f32, bound: f32) -> bool {
    let hull = hull_of(vec2(gap, 0.0), -ways, bound, time);
    return (0.0 < hull.lower) & (0.0 < hull.lowest) & (face.opposite_clear | (hull.highest < width));
}

// Whether the rebounds that follow an impact can surely not be closed, so that it ends in flight.
fn crossing_parts(end: End, restitution: f32, rebound: f32, state: State, force: f32) -> bool {
    let speed = abs(rebound);
    let slow = max(unresolved(end, state), FADING);
    let loss = 1.0 - restitution;
    let cubic_loss = 1.0 - restitution * restitution * restitution;
    let drift = (flight.rate + flight.rate) * speed;
    let steady = drift < force * loss * STEADY_BOUND;
    let effect = flight.normals[end.normal].coupling * drift * (speed * speed * speed) * TWO_THIRDS;
    let lost = effect < (force * force * force) * (loss * cubic_loss) * CHATTER_BOUND;
    let may_close = (0.0 < force) & steady & lost;
    return (slow < speed) & !may_close;
}
