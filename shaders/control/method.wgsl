// What every control method does: look at a return to the section, and answer with a correction or a force.

struct Control {
    method: u32,
    convention: u32,
    component: u32,
    delay: u32,
    period: u32,
    seed: u32,
    amplitude: f32,
    weight: f32,
    dead_band: f32,
    ratio: f32,
    phase: f32,
    wanted: f32,
    noise: f32,
    // What a unit force on the first mass, in phase with the forcing, adds to a step and to the bound.
    drive_bound: f32,
    point: array<f32, 4>,
    gains: array<f32, 4>,
    // What a unit force accelerates.
    push: array<f32, 2>,
    drive_sin: array<f32, 4>,
    drive_cos: array<f32, 4>,
}

// What a method sees.
struct Seen {
    section: vec4<f32>,
    turns: f32,
    controlled: u32,
}

// What it does.
struct Action {
    correction: vec4<f32>,
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
    return Action(vec4(0.0, 0.0, 0.0, 0.0), 0.0, 0.0);
}

fn action_correcting(correction: vec4<f32>) -> Action {
    return Action(correction, 0.0, correction_length(correction));
}

fn correction_length(correction: vec4<f32>) -> f32 {
    let squares = correction * correction;
    return sqrt((squares.x + squares.y) + (squares.z + squares.w));
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
