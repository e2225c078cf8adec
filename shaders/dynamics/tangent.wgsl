// A small deviation from the motion, carried through flight and impact.

// An impact as a deviation meets it.
struct Saltation {
    normal: u32,
    velocity: f32,
    kick: f32,
    before: X,
    after: X,
    contact: u32,
}

fn tangent_seed() -> State {
    return State(X(TANGENT_SEED), X(TANGENT_SEED));
}

fn tangent_stepped(tangent: State) -> State {
    return state_flown(tangent);
}

// A time s ≤ h of free flight later, by a Taylor polynomial of fixed order.
fn tangent_flown_freely(tangent: State, s: f32) -> State {
    let springs = columns_scaled(s * s, flight.stiffness);
    let dampers = columns_scaled(s, flight.damping);
    var before = tangent.v;
    var last = applied_onto(dampers, before, s * applied(flight.stiffness, tangent.x));
    var velocity = before;
    var mean = before;
    //: each tangent term
    velocity = velocity + INVERSE_FACTORIALS[$k] * last;
    mean = mean + INVERSE_FACTORIALS[$k + 1] * last;
    let pulled$k = applied(springs, before);
    before = last;
    last = applied_onto(dampers, last, pulled$k);
    //: end
    return State(tangent.x + s * mean, velocity);
}

fn tangent_flown(tangent: State, s: f32, contact: u32) -> State {
    if contact == CONTACT_FREE {
        return tangent_flown_freely(tangent, s);
    }
    let series = series_new(s);
    var before = tangent.v;
    var last = series_first(series, tangent.x, before);
    last = held(contact, last).rest;
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
        let next = held(contact, series_next(series, before, last, X(0.0))).rest;
        before = last;
        last = next;
    }
    return State(tangent.x + s * mean, velocity);
}

// The saltation of the impact law.
fn tangent_struck(tangent: State, impact: Saltation) -> State {
    let direction = flight.normals[impact.normal].direction;
    let response = flight.normals[impact.normal].response;
    let shift = along(direction, tangent.x) / impact.velocity;
    let factor = impact.kick / impact.velocity;
    let speed = along(direction, tangent.v) - along(direction, impact.before) * shift;
    let v = tangent.v + (factor * speed) * response;
    let struck = State(
        tangent.x + (impact.kick * shift) * response,
        v + (impact.after - impact.before) * shift,
    );
    if impact.contact == CONTACT_FREE {
        return struck;
    }
    return tangent_caught(struck, impact.contact);
}

fn tangent_caught(tangent: State, contact: u32) -> State {
    return State(held(contact, tangent.x).rest, held(contact, tangent.v).rest);
}

fn tangent_length(tangent: State) -> f32 {
    return sqrt(state_square(tangent));
}
