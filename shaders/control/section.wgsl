// A point of the impact Poincaré section: (v1+, x2, v2, τ) just after an impact at stop A.

fn section_of_trajectory() -> vec4<f32> {
    let state = trajectory.point.state;
    return vec4(state.v.x, state.x.y, state.v.y, phase_of(trajectory.step, trajectory.offset));
}

// The mirror image of where the trajectory is, just after an impact at Ā.
fn section_mirrored() -> vec4<f32> {
    let section = section_of_trajectory();
    return vec4(-section.x, -section.y, -section.z, into_turn(section.w + PI));
}

// The trajectory that begins at this point.
fn section_trajectory(section: vec4<f32>, resting: bool) -> Trajectory {
    let phasor = sine_and_cosine(section.w);
    let state = State(vec2(flight.normals[0].gap[0], section.y), section.xz);
    let point = Point(state, phasor.x, phasor.y);
    let stuck = resting && section.x == 0.0;
    let steps = f32(flight.steps);
    let place = section.w * INVERSE_TAU * steps;
    let last = steps - 1.0;
    let step = select(last, floor(place), place < last);
    let behind = (place - step) * flight.h;
    let offset = select(flight.h * (1.0 - EPSILON), behind, behind < flight.h);
    let at_a = contact_with(CONTACT_FREE, End(0u, 0u));
    return trajectory_from_point(point, select(CONTACT_FREE, at_a, stuck), u32(step), offset);
}

// One point minus another; τ the short way round.
fn section_minus(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    let difference = a - b;
    return vec4(difference.xyz, short_way(difference.w));
}

fn section_plus(a: vec4<f32>, correction: vec4<f32>) -> vec4<f32> {
    let sum = a + correction;
    return vec4(sum.xyz, into_turn(sum.w));
}

fn section_distance(a: vec4<f32>, b: vec4<f32>) -> f32 {
    let difference = abs(section_minus(a, b));
    return max(max(difference.x, difference.y), max(difference.z, difference.w));
}

fn section_is_finite(section: vec4<f32>) -> bool {
    return is_finite(section.x) && is_finite(section.y) && is_finite(section.z) && is_finite(section.w);
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
