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

// A time s later with the contacts that hold, |s| ≤ h, or earlier where s is negative.
fn tangent_flown(tangent: State, s: f32, contact: u32) -> State {
    let series = series_under(s, contact);
    var before = tangent.v;
    var last = series_first(series, contact, tangent.x, before);
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
        let next = series_next(series, before, last, X(0.0));
        before = last;
        last = next;
    }
    return State(tangent.x + s * mean, velocity);
}

// The saltation of the impact law, of an impact that begins in contact.
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

// G y, the derivative of a deviation in free flight.
fn tangent_rate(y: State) -> State {
    return State(y.v, applied_onto(flight.damping, y.v, applied(flight.stiffness, y.x)));
}

// The deviation of the end of a step after an impact in it, `back` being the row that gives d·x of a deviation then, and `pull`
// d·x'' before it: it adds as much of the wake and of its derivative as the saltation adds of a velocity along the response, and
// of its derivative.
fn tangent_struck_ahead(tangent: State, back: State, velocity: f32, kick: f32, pull: f32, wake: State) -> State {
    let inverse = 1.0 / velocity;
    let factor = kick * inverse;
    let there = state_dot(back, tangent);
    let speed = -(pull * inverse) * there + state_dot(back, tangent_rate(tangent));
    return state_plus(state_plus(tangent, factor * speed, wake), factor * there, tangent_rate(wake));
}

// Whether it is not far from unit length, `square` being the square of its length, and may be left to grow or shrink.
fn tangent_may_be_left(square: f32) -> bool {
    return (SHORT_SQUARE < square) & (square < LONG_SQUARE);
}

// Brings the tangent back to unit length, `square` being the square of its length, and returns what it had grown by, ln of a factor.
fn tangent_bring_back(square: f32) -> f32 {
    let length = sqrt(square);
    if length > 0.0 && is_finite(length) {
        tangent = state_scaled(1.0 / length, tangent);
        return logarithm(length);
    }
    tangent = tangent_seed();
    return 0.0;
}

// Whether nothing is left of it: of no other deviation is anything left then.
fn tangent_is_lost(tangent: State) -> bool {
    return largest_of(tangent.x, tangent.v) == 0.0;
}

fn tangent_caught(tangent: State, contact: u32) -> State {
    return State(spared(contact, tangent.x), spared(contact, tangent.v));
}
