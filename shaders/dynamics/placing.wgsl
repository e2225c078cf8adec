// States moved onto the stops that they rest on, or that they have reached, against the rounding of flights.

// A state moved to where it is to be along a normal, along the response of that.
fn placed(normal: u32, state: State, there: Along) -> State {
    let direction = flight.normals[normal].direction;
    let response = flight.normals[normal].response;
    let away = there.place - along(direction, state.x);
    let change = there.speed - along(direction, state.v);
    return State(state.x + away * response, state.v + change * response);
}

// A state moved onto a stop, with the given speed along its normal.
fn placed_on(state: State, end: End, speed: f32) -> State {
    return placed(end.normal, state, Along(end_sign(end) * stops.gap[end.normal][end.side], speed));
}

// A state moved onto all stops on which masses rest, at rest there: along the responses of their normals, together.
fn rested(state: State, contact: u32) -> State {
    if contact == CONTACT_FREE {
        return state;
    }
    let contacts = contact_held(contact);
    var place = array<f32, NORMALS>();
    var speed = array<f32, NORMALS>();
    //: each normal
    let end$k = contact_end_along(contact, $ku);
    let off$k = end_sign(end$k) * stops.gap[$k][end$k.side] - along(flight.normals[$k].direction, state.x);
    let fast$k = -along(flight.normals[$k].direction, state.v);
    //: end
    //: each pair of normals
    if (contacts >> $lu & 1u) == 1u {
        place[$k] = place[$k] + pressing_share(contacts, $ku, $lu) * off$l;
        speed[$k] = speed[$k] + pressing_share(contacts, $ku, $lu) * fast$l;
    }
    //: end
    var at_rest = state;
    //: each normal
    at_rest.x = at_rest.x + place[$k] * flight.normals[$k].response;
    at_rest.v = at_rest.v + speed[$k] * flight.normals[$k].response;
    //: end
    return at_rest;
}
