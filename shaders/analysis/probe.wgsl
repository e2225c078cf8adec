// A quantity read on a section, of a trajectory.

// The codes of the section and of what is read there.
struct Probe {
    section: u32,
    reading: u32,
}

var<private> probe: Probe;

// Whether a move ended on the section.
fn probe_meets(taken: Move) -> bool {
    if probe.section == SECTION_STROBE {
        return taken.event == EVENT_STROBE;
    }
    return is_impact(taken) && probe.section == taken.stop;
}

fn probe_read(taken: Move) -> f32 {
    let state = trajectory.point.state;
    if probe.section == SECTION_STROBE {
        return probe_of_state(state);
    }
    switch probe.reading {
        case READING_V_BEFORE: {
            return taken.velocity;
        }
        case READING_V_AFTER: {
            return taken.rebound;
        }
        case READING_TAU: {
            return probe_phase();
        }
        default: {
            return probe_of_state(probe_leaving(state, taken));
        }
    }
}

// A quantity of the state; 0 for one of impacts.
fn probe_of_state(state: State) -> f32 {
    if probe.reading >= READING_SPEED {
        return probe_speed(state, probe.reading - READING_SPEED);
    }
    if probe.reading >= READING_GAP {
        return probe_gap(state, probe.reading - READING_GAP);
    }
    if probe.reading < READING_COMPONENT {
        return 0.0;
    }
    var values = state_values(state);
    return values[probe.reading - READING_COMPONENT];
}

// The state just after an impact that leaves its stop with the rebound along its normal, where masses that come to rest
// there still move so.
fn probe_leaving(state: State, taken: Move) -> State {
    var leaving = state;
    //: each normal
    if probe_is_on($ku, 0u, taken.stop) || probe_is_on($ku, 1u, taken.stop) {
        let change = taken.rebound - along(flight.normals[$k].direction, state.v);
        leaving.v = state.v + change * flight.normals[$k].response;
    }
    //: end
    return leaving;
}

// Whether a stop is at an end of a contact normal.
fn probe_is_on(normal: u32, side: u32, stop: u32) -> bool {
    return stops.gap[normal][side] < FAR && flight.normals[normal].stop[side] == stop;
}

// The distance that is left to a stop.
fn probe_gap(state: State, stop: u32) -> f32 {
    var value = 0.0;
    //: each normal
    if probe_is_on($ku, 0u, stop) {
        value = stops.gap[$k][0] - along(flight.normals[$k].direction, state.x);
    }
    if probe_is_on($ku, 1u, stop) {
        value = stops.gap[$k][1] + along(flight.normals[$k].direction, state.x);
    }
    //: end
    return value;
}

// The velocity towards a stop.
fn probe_speed(state: State, stop: u32) -> f32 {
    var value = 0.0;
    //: each normal
    if probe_is_on($ku, 0u, stop) {
        value = along(flight.normals[$k].direction, state.v);
    }
    if probe_is_on($ku, 1u, stop) {
        value = -along(flight.normals[$k].direction, state.v);
    }
    //: end
    return value;
}

// The forcing phase, from the step and the offset in it.
fn probe_phase() -> f32 {
    let steps = f32(trajectory.step) + trajectory.offset * flight.inverse_h;
    return steps * (TAU / f32(flight.steps));
}
