// Masses that two stops squeeze: they rebound between both ever faster, and lose all speed along both in an instant.

struct Squeeze {
    closes: bool,
    beside: End,
}

// The stop that masses are thrown on by an impact at `end`, and from which they come back at once, infinitely often.
fn squeezed(point: Point, contact: u32, end: End) -> Squeeze {
    var found = 0u;
    var other = end;
    //: each normal
    if $ku != end.normal && (contact_held(contact) >> $ku & 1u) == 0u {
        if stops.gap[$k][0] < FAR && squeeze_is_thrown_on(point, End($ku, 0u)) {
            found = found + 1u;
            other = End($ku, 0u);
        }
        if stops.gap[$k][1] < FAR && squeeze_is_thrown_on(point, End($ku, 1u)) {
            found = found + 1u;
            other = End($ku, 1u);
        }
    }
    //: end
    if found != 1u {
        return Squeeze(false, end);
    }
    let r = stops.restitution[end.normal][end.side];
    let s = stops.restitution[other.normal][other.side];
    let own_direction = flight.normals[end.normal].direction;
    let other_direction = flight.normals[other.normal].direction;
    let facing = -(end_sign(end) * end_sign(other));
    // What an impact at one stop throws on the other, per speed that it changes.
    let onto_own = facing * along(own_direction, flight.normals[other.normal].response);
    let onto_other = facing * along(other_direction, flight.normals[end.normal].response);
    let product = onto_own * onto_other;
    let trace = (1.0 + r) * (1.0 + s) * product - r - s;
    let faces = onto_own > 0.0 && onto_other > 0.0 && product < 1.0;
    if !(faces && trace > sqrt(r * s) + sqrt(r * s)) {
        return Squeeze(false, end);
    }
    // Contacts that hold must not be in the way.
    var free = true;
    //: each normal
    if contact_opens_along(contact, $ku) {
        let thrown = abs(along(flight.normals[$k].direction, flight.normals[other.normal].response));
        free = free && thrown <= KICK_ROUNDINGS * EPSILON;
    }
    //: end
    if !free {
        return Squeeze(false, end);
    }
    // The speed towards the own stop, per speed towards the other.
    let own_speed = end_sign(end) * along(own_direction, point.state.v);
    var share = own_speed / (end_sign(other) * along(other_direction, point.state.v));
    for (var squeeze = 0u; squeeze < SQUEEZES; squeeze++) {
        let towards_own = share + (1.0 + s) * onto_own;
        let towards_other = (1.0 + r) * onto_other * towards_own - s;
        if !(towards_own > 0.0 && towards_other > 0.0) {
            return Squeeze(false, end);
        }
        share = -(r * towards_own) / towards_other;
    }
    return Squeeze(true, other);
}

// Whether masses meet the stop at an end at once, so slowly that the impact takes nothing, but not so slowly that rounding tells.
fn squeeze_is_thrown_on(point: Point, end: End) -> bool {
    let speed = end_sign(end) * along(flight.normals[end.normal].direction, point.state.v);
    let gap = contact_gap_to(point, end);
    let lost = unresolved(end, point.state);
    let at_once = flight.rate * gap <= CHATTER * speed || gap <= lost;
    return at_once && speed > lost && speed * speed <= CHATTER * (stops.unit * stops.unit);
}

// The end of a squeeze that an impact at `end` throws the masses on `beside` in: they have no speed along either normal, and rest on
// what presses. `before` is their acceleration before the impact, the velocity of which is known.
fn squeeze_collapse(carry: bool, end: End, beside: End, velocity: f32, rebound: f32, before: X) -> Move {
    if carry {
        tangent = tangent_present(tangent);
    }
    let corner = contact_with(contact_with(trajectory.contact, end), beside);
    trajectory.point.state = rested(trajectory.point.state, corner);
    var contact = squeeze_pressed(corner, end);
    contact = squeeze_pressed(contact, beside);
    // Whether one presses depends on the other.
    contact = squeeze_pressed(contact, end);
    contact = squeeze_joined(contact, end);
    contact = squeeze_joined(contact, beside);
    squeeze_part(contact, end);
    squeeze_part(contact, beside);
    if carry {
        let after = point_motion(trajectory.point, contact).acceleration;
        tangent = tangent_squeezed(tangent, Saltation(end.normal, velocity, rebound - velocity, before, after, corner));
    }
    trajectory.under_way = 0u;
    trajectory.contact = contact;
    trajectory_look_ahead(carry);
    let stop = flight.normals[end.normal].stop[end.side];
    return Move(EVENT_COMPLETE_CHATTER, stop, velocity, rebound, contact_with(CONTACT_FREE, beside), 0.0);
}

// The contacts without that at an end, where it pulls.
fn squeeze_pressed(contact: u32, end: End) -> u32 {
    let motion = point_motion(trajectory.point, contact);
    let pulls = contact_includes(contact, end) && end_sign(end) * motion.pressing[end.normal] < 0.0;
    return select(contact, contact_without(contact, end.normal), pulls);
}

// The contacts with that at an end, where it presses.
fn squeeze_joined(contact: u32, end: End) -> u32 {
    let joined = contact_with(contact, end);
    let motion = point_motion(trajectory.point, joined);
    return select(contact, joined, end_sign(end) * motion.pressing[end.normal] > 0.0);
}

// Lets masses part from a stop off which they are pulled at once: rounding must not make that another impact.
fn squeeze_part(contact: u32, end: End) {
    if !contact_includes(contact, end) {
        let lost = unresolved(end, trajectory.point.state);
        trajectory.point.state = placed_on(trajectory.point.state, end, -(end_sign(end) * (lost + lost)));
    }
}

// Once all speed along the normals of a corner is lost at the instant of an impact, whose shift a deviation changes.
fn tangent_squeezed(tangent: State, impact: Saltation) -> State {
    let shift = along(flight.normals[impact.normal].direction, tangent.x) / impact.velocity;
    let left = tangent_caught(State(tangent.x, tangent.v - shift * impact.before), impact.contact);
    return State(left.x, left.v + shift * impact.after);
}
