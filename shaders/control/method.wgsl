// What every control method does: at each return to the section it sets a correction or a force.

struct Control {
    method: u32,
    convention: u32,
    component: u32,
    delay: u32,
    period: u32,
    seed: u32,
    // The section's stop, its end of a contact normal, and the coordinate whose velocity comes first.
    stop: u32,
    normal: u32,
    side: u32,
    own: u32,
    amplitude: f32,
    weight: f32,
    dead_band: f32,
    ratio: f32,
    phase: f32,
    wanted: f32,
    noise: f32,
    // The mirror image of each stop; MOST where the system has no mirror.
    mirror: array<u32, MOST>,
    point: array<f32, COMPONENTS>,
    gains: array<f32, COMPONENTS>,
    // What a unit force in phase with the forcing accelerates, adds to a step, and to the bounds.
    push: array<f32, COORDINATES>,
    drive_sin: array<f32, COMPONENTS>,
    drive_cos: array<f32, COMPONENTS>,
    drive_bound: array<f32, NORMALS>,
}

// What a method sees.
struct Seen {
    section: SectionPoint,
    turns: f32,
    controlled: u32,
}

// What it does.
struct Action {
    correction: SectionPoint,
    force: f32,
    signal: f32,
}

// What changes of a method as it works: B, α and the last |e|.
struct Adapted {
    amplitude: f32,
    weight: f32,
    error: f32,
}

var<private> control: Control;
var<private> adapted: Adapted;

fn action_none() -> Action {
    return Action(section_zero(), 0.0, 0.0);
}

fn action_correcting(correction: SectionPoint) -> Action {
    return Action(correction, 0.0, correction_length(correction));
}

fn correction_length(correction: SectionPoint) -> f32 {
    return sqrt(section_square(correction));
}

fn method_act(seen: Seen) -> Action {
    if control.method == METHOD_SINE {
        return sine_act(seen);
    }
    if control.method == METHOD_PULSE {
        return pulse_act(seen);
    }
    if control.method == METHOD_DELAY {
        return delay_act();
    }
    return action_none();
}

// Whether the method itself has come to rest.
fn method_is_at_rest() -> bool {
    return control.method != METHOD_SINE || sine_is_at_rest();
}
