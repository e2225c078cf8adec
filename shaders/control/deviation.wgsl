// A small deviation of the points on the section, carried through flight and control.

var<private> deviations: array<SectionPoint, DELAYS>;

fn deviations_seed() {
    for (var i = 1u; i < DELAYS; i++) {
        deviations[i] = section_zero();
    }
    var each = section_zero();
    //: each coordinate
    each.head$c = TANGENT_SEED;
    each.tail$c = TANGENT_SEED;
    //: end
    deviations[0] = each;
}

// The rates of displacements and velocities at the trajectory's present point.
fn deviation_rates() -> State {
    return State(trajectory.point.state.v, point_motion(trajectory.point, trajectory.contact).acceleration);
}

// The deviation, at fixed time, of the trajectory that leaves the present point, as it is carried along.
fn deviations_leaving() -> State {
    let present = deviations[0];
    let within = surface_unpacked(present, 0.0);
    return tangent_carried(state_plus(within, -(section_tau(present) / flight.omega), deviation_rates()));
}

// The deviation of the point at which the trajectory arrives.
fn deviations_arrived() -> SectionPoint {
    let deviation = tangent_present(tangent);
    let rate = deviation_rates();
    let direction = flight.normals[control.normal].direction;
    let speed = along(direction, rate.x);
    var shift = 0.0;
    if speed != 0.0 {
        shift = -(along(direction, deviation.x) / speed);
    }
    return surface_components(state_plus(deviation, shift, rate), flight.omega * shift);
}

fn deviations_push(deviation: SectionPoint) {
    for (var i = DELAYS - 1u; i > 0u; i--) {
        deviations[i] = deviations[i - 1u];
    }
    deviations[0] = deviation;
}

// The factor by which the deviation has grown; it is brought back to unit length. 0 where it is lost.
fn deviations_growth() -> f32 {
    var squares = 0.0;
    for (var i = 0u; i < DELAYS; i++) {
        squares = squares + section_square(deviations[i]);
    }
    let length = sqrt(squares);
    if !(length > 0.0 && is_finite(length)) {
        deviations_seed();
        return 0.0;
    }
    let factor = 1.0 / length;
    for (var i = 0u; i < DELAYS; i++) {
        deviations[i] = section_scaled(factor, deviations[i]);
    }
    return length;
}
