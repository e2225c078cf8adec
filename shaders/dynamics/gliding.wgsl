// A part of a step, with the contacts that hold.

// Moves on for a time within the step, with the present contacts.
fn glide(carry: bool, time: f32) {
    glide_to(carry, glided(time), time);
}

// Where it is a time later within the step, with the present contacts.
fn glided(time: f32) -> Point {
    var point: Point;
    if is_whole_step(time, trajectory.contact) {
        point = point_stepped_held(first_held(trajectory.contact), trajectory.point);
    } else {
        point = point_flown(trajectory.point, time, trajectory.contact);
    }
    point.state = rested(point.state, trajectory.contact);
    return point;
}

// Moves on to where it is a time later within the step, with the present contacts.
fn glide_to(carry: bool, point: Point, time: f32) {
    trajectory.point = point;
    if carry && trajectory.under_way == 0u {
        if is_whole_step(time, trajectory.contact) {
            tangent = tangent_stepped_held(first_held(trajectory.contact), tangent);
        } else {
            tangent = tangent_flown(tangent, time, trajectory.contact);
        }
    }
    trajectory.offset = trajectory.offset + time;
}

// Whether a flight of such a length is a whole step under contacts along one normal.
fn is_whole_step(time: f32, contact: u32) -> bool {
    return holds_one_normal(contact) && time == flight.h;
}

// Whether contacts hold along one normal, and along no other.
fn holds_one_normal(contact: u32) -> bool {
    return countOneBits(contact_held(contact)) == 1u;
}

// The first normal that holds.
fn first_held(contact: u32) -> u32 {
    return firstTrailingBit(contact_held(contact));
}

// One whole step h while masses rest on a stop along one normal, and on no other.
fn point_stepped_held(normal: u32, point: Point) -> Point {
    let sine = state_plus(flight.normals[normal].held_gamma_one, point.sin, held_sine(normal));
    let forced = state_plus(sine, point.cos, held_cosine(normal));
    return point_turned(point, state_held_onto(normal, forced, point.state));
}

// What one such step makes of a deviation.
fn tangent_stepped_held(normal: u32, tangent: State) -> State {
    return state_held_onto(normal, State(X(0.0), X(0.0)), tangent);
}

// The same on top of a state.
fn state_held_onto(normal: u32, base: State, deviation: State) -> State {
    var state = base;
    //: each coordinate
    state = state_plus(state, deviation.x$c, flight.normals[normal].held_phi_x[$i]);
    //: end
    //: each coordinate
    state = state_plus(state, deviation.v$c, flight.normals[normal].held_phi_v[$i]);
    //: end
    return state;
}

// What it adds for the sine of the forcing phase.
fn held_sine(normal: u32) -> State {
    return flight.normals[normal].held_gamma_sin;
}

// What it adds for its cosine.
fn held_cosine(normal: u32) -> State {
    return flight.normals[normal].held_gamma_cos;
}
