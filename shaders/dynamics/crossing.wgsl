// Contact found directly: the time at which a leg meets a stop, and where, with a certificate that it meets none before.

// A contact, and where the motion is along each normal just after the impact.
struct Crossing {
    certain: bool,
    // Whether the leg comes near to a stop, and provably stays off all stops.
    passes: bool,
    end: End,
    time: f32,
    // The share of a whole step that is left.
    rest: f32,
    after: Alongs,
    velocity: f32,
    kick: f32,
    rebound: f32,
    // d·x'' before the impact.
    pull: f32,
}

// The contact of a leg to the end of a step, which ends beyond one stop, or touches one and returns.
fn crossing_of(before: Alongs, ahead: Point, window: f32) -> Crossing {
    let face = crossing_face(before, ahead, window);
    let normal = face.end.normal;
    let sign = end_sign(face.end);
    let gap = face_gap(face.end);
    let begins = along_at(before, normal);
    let ends = along_of(ahead, normal);
    let course = course_to(ahead, ends.speed, normal);
    // The gap, seen from the end of the leg: u is the share of it that is left.
    let whole = window * flight.inverse_h;
    let bends = course_bends(course);
    let square = -sign * (whole * whole);
    let leaves = sign * begins.speed;
    let slopes = vec2(sign * ends.speed * window, leaves * window);
    let gaps = vec2(gap - sign * ends.place, gap - sign * begins.place);
    let polynomial = quintic_through(gaps, slopes, square * bends.x, square * whole * bends.y);
    var start = 1.0 - quintic_chord(vec2(gaps.y, gaps.x), slopes.y);
    // Where the leg returns, it is asked about where the gap is narrowest.
    var opens = false;
    var turns = 0.0;
    if face.returns {
        let narrowest = quintic_narrowest(polynomial, slopes.y);
        turns = narrowest.u;
        opens = 0.0 < narrowest.gap;
        start = narrowest_touch(narrowest);
    }
    let u = select(quintic_root(polynomial, start), turns, opens);

    // What that misses is little: the course itself says how much.
    let stop = sign * gap;
    let nearly = u * whole;
    let here = course_about(course, nearly, whole, begins.place);
    var passes = false;
    if opens {
        passes = turns_off(before, here_along(here), ahead, face.end, 1.0 - u, nearly, window);
    }
    let change = here_change_to(here, stop);
    let there = here_changed(here, change);
    let rest = nearly + change;
    let time = window - rest * flight.h;

    let arrival = here_along(there);
    let velocity = arrival.speed;
    let restitution = select(
        stops.restitution[normal][1],
        stops.restitution[normal][0],
        face.end.side == 0u,
    );
    let rebound = -(restitution * velocity);
    let kick = rebound - velocity;
    let pull = here_pull(there);
    let force = sign * (pull - flight.normals[normal].drag * kick);
    let close = abs(change) * (flight.h * flight.rate) < STRAIGHT;
    let within = (0.0 < time) & (time < window);
    let ways = vec2(leaves, sign * velocity);
    let bound = point_bound(ahead, normal);
    let width = stops.gap[normal][0] + stops.gap[normal][1];
    let first = crossing_stays_off(face, gaps.y, width, ways, time, bound);
    let parts = crossing_parts(face.end, restitution, rebound, ahead.state, force);
    let rounding = stop_rounding(face.end, ahead.state, window, window * velocity);
    let meets = abs(gap - sign * arrival.place) * EXACT < rounding;
    let last = (bends.x + bends.x) * (flight.inverse_h * flight.inverse_h);
    let deep = !face.returns | is_deep(ways.y, vec2(sign * pull, sign * last), bound, window, rounding);
    let certain = face.only & close & within & first & parts & deep & meets;
    let own = Along(stop, rebound);
    let passed = course_each(before, ahead, rest, whole, normal, own);
    let after = crossing_struck(face.end, passed, kick);
    return Crossing(certain, passes & !certain, face.end, time, rest, after, velocity, kick, rebound, pull);
}

// Where the motion is along each normal just after an impact: what the kick changes along those that are not met.
fn crossing_struck(end: End, passed: Alongs, kick: f32) -> Alongs {
    var each = passed;
    if NORMALS > 1u {
        let response = flight.normals[end.normal].response;
        //: each normal
        if $ku != end.normal {
            each[$k].speed = kick * along(flight.normals[$k].direction, response) + each[$k].speed;
        }
        //: end
    }
    return each;
}

// Whether a contact is the first since the gap lies within its hull on the way there, and that between the stops.
fn crossing_stays_off(face: Face, gap: f32, width: f32, ways: vec2<f32>, time: f32, bound: f32) -> bool {
    let hull = hull_of(vec2(gap, 0.0), -ways, bound, time);
    return (0.0 < hull.lower) & (0.0 < hull.lowest) & (face.opposite_clear | (hull.highest < width));
}

// Whether the rebounds that follow an impact can surely not be closed, so that it ends in flight.
fn crossing_parts(end: End, restitution: f32, rebound: f32, state: State, force: f32) -> bool {
    let speed = abs(rebound);
    let slow = max(unresolved(end, state), FADING * stops.unit);
    let loss = 1.0 - restitution;
    let cubic_loss = 1.0 - restitution * restitution * restitution;
    let drift = (flight.rate + flight.rate) * speed;
    let steady = drift < force * loss * STEADY_BOUND;
    let ratio = speed / force;
    let effect = flight.normals[end.normal].coupling * drift * (ratio * ratio * ratio) * TWO_THIRDS;
    let lost = effect < (loss * cubic_loss) * (CHATTER_BOUND * stops.unit);
    let may_close = (0.0 < force) & steady & lost;
    return (slow < speed) & !may_close;
}
