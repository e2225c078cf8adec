// What rebounds that are closed together do to the masses, and to a deviation.

// By how much springs and dampers move the masses that are free with some contacts, and change their velocities, per ∫ gap dt of
// rebounds off a stop along one of their normals.
fn closing_sways(contact: u32, normal: u32) -> State {
    let response = flight.normals[normal].response;
    let push = spared(contact, applied(flight.damping, response));
    let pull = spared(contact, applied(flight.stiffness, response) + applied(flight.damping, push));
    return State(push, pull);
}

// A deviation just after rebounds that are closed, before their contact holds beside those that hold already: it changes the speed of
// the first of them, and what presses; what it has of a gap closes, and dampers push the other masses.
fn tangent_closed(tangent: State, contact: u32, end: End, speed: f32, force: f32, gap_integral: f32) -> State {
    let direction = flight.normals[end.normal].direction;
    let sign = end_sign(end);
    let pulled = applied(flight.stiffness, tangent.x) + applied(flight.damping, tangent.v);
    let pressed = sign * along(direction, spared(contact, pulled));
    let gap = along(direction, tangent.x);
    let faster = -(sign * along(direction, tangent.v)) - force * (sign * gap) / speed;
    let share = 3.0 * faster / speed - (pressed + pressed) / force;
    // What is over at once may be pressed by nothing.
    let grows = select(0.0, gap_integral * share, gap_integral > 0.0);
    let signed_growth = -(sign * grows);
    let sways = closing_sways(contact_with(contact, end), end.normal);
    let pushed = tangent.v - gap * sways.x;
    return State(tangent.x + signed_growth * sways.x, pushed + signed_growth * sways.v);
}
