// A point of the impact Poincaré section of a stop: the velocity of the section's own coordinate just after an impact,
// the other displacements, the other velocities, τ. The 2n components lie in two halves.

struct SectionPoint {
    head: X,
    tail: X,
}

fn section_zero() -> SectionPoint {
    return SectionPoint(X(), X());
}

fn section_of_trajectory() -> SectionPoint {
    return surface_components(trajectory.point.state, phase_of(trajectory.step, trajectory.offset));
}

// The mirror image of where the trajectory is, just after an impact at the stop's twin.
fn section_mirrored() -> SectionPoint {
    let state = trajectory.point.state;
    let image = State(applied(flight.mirror, state.x), applied(flight.mirror, state.v));
    return surface_components(image, into_turn(phase_of(trajectory.step, trajectory.offset) + PI));
}

// The state of a point on the section.
fn section_state(section: SectionPoint) -> State {
    let end = section_end();
    return surface_unpacked(section, end_sign(end) * stops.gap[end.normal][end.side]);
}

// The end of a contact normal that is the section's stop.
fn section_end() -> End {
    return End(control.normal, control.side);
}

// The velocity into the stop: 0 or negative just after an impact.
fn section_approach(state: State) -> f32 {
    return end_sign(section_end()) * along(flight.normals[control.normal].direction, state.v);
}

// The trajectory that begins at this point with the given contacts.
fn section_trajectory(section: SectionPoint, contact: u32) -> Trajectory {
    let tau = section_tau(section);
    let phasor = sine_and_cosine(tau);
    let point = Point(section_state(section), phasor.x, phasor.y);
    let steps = f32(flight.steps);
    let place = tau * INVERSE_TAU * steps;
    let last = steps - 1.0;
    let step = select(last, floor(place), place < last);
    let behind = (place - step) * flight.h;
    let offset = select(flight.h * (1.0 - EPSILON), behind, behind < flight.h);
    return trajectory_from_point(point, contact, u32(step), offset);
}

// One point minus another; τ the short way round.
fn section_minus(a: SectionPoint, b: SectionPoint) -> SectionPoint {
    let difference = SectionPoint(a.head - b.head, a.tail - b.tail);
    return section_with_tau(difference, short_way(section_tau(difference)));
}

fn section_added(a: SectionPoint, b: SectionPoint) -> SectionPoint {
    return SectionPoint(a.head + b.head, a.tail + b.tail);
}

fn section_scaled(a: f32, section: SectionPoint) -> SectionPoint {
    return SectionPoint(a * section.head, a * section.tail);
}

// A point moved by a correction.
fn section_plus(section: SectionPoint, correction: SectionPoint) -> SectionPoint {
    let sum = section_added(section, correction);
    return section_with_tau(sum, into_turn(section_tau(sum)));
}

// The largest difference of a component, that of τ as it is, others in units of `unit`.
fn section_distance(a: SectionPoint, b: SectionPoint, unit: f32) -> f32 {
    let difference = section_minus(a, b);
    let rest = section_with_tau(difference, 0.0);
    return max(max(largest(rest.head), largest(rest.tail)) / unit, abs(section_tau(difference)));
}

// How far a point is from another that it may return to: relative where that is larger than `unit`.
fn section_away(section: SectionPoint, anchor: SectionPoint, unit: f32) -> f32 {
    let rest = section_with_tau(anchor, 0.0);
    return section_distance(section, anchor, max(unit, max(largest(rest.head), largest(rest.tail))));
}

// The square of the Euclidean length.
fn section_square(section: SectionPoint) -> f32 {
    return along(section.head, section.head) + along(section.tail, section.tail);
}

fn section_is_zero(section: SectionPoint) -> bool {
    return max(largest(section.head), largest(section.tail)) == 0.0;
}

fn section_is_finite(section: SectionPoint) -> bool {
    return are_finite(section.head) && are_finite(section.tail);
}

// The forcing phase at a time `offset` after the beginning of a step.
fn phase_of(step: u32, offset: f32) -> f32 {
    return into_turn(TAU * (f32(step) / f32(flight.steps)) + flight.omega * offset);
}

fn into_turn(angle: f32) -> f32 {
    let raised = select(angle, angle + TAU, angle < 0.0);
    let lowered = select(raised, raised - TAU, raised >= TAU);
    return select(0.0, lowered, lowered < TAU);
}

fn short_way(difference: f32) -> f32 {
    if difference > PI {
        return difference - TAU;
    }
    return select(difference, difference + TAU, difference < -PI);
}

// The sine and the cosine of an angle, by their Taylor series about the nearest quarter turn.
fn sine_and_cosine(angle: f32) -> vec2<f32> {
    let quarter = floor(angle * TWO_OVER_PI + 0.5);
    let rest = angle - quarter * HALF_PI;
    var term = vec2(0.0, 1.0);
    var sum = term;
    for (var k = 1u; k <= ORDER; k++) {
        term = vec2(term.y * rest, -(term.x * rest));
        sum = sum + INVERSE_FACTORIALS[k] * term;
    }
    let which = u32(quarter - 4.0 * floor(quarter * 0.25));
    if which == 0u {
        return sum;
    }
    if which == 1u {
        return vec2(sum.y, -sum.x);
    }
    if which == 2u {
        return -sum;
    }
    return vec2(-sum.y, sum.x);
}
