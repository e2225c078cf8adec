// Delayed feedback, with the sign that stabilises.

fn delay_act() -> Action {
    if memory.seen <= control.delay {
        return action_none();
    }
    return action_correcting(delay_feedback(section_minus(memory_point(0u), memory_point(control.delay))));
}

// G times a difference.
fn delay_feedback(difference: vec4<f32>) -> vec4<f32> {
    let g = control.gains;
    return vec4(g[0], g[1], g[2], g[3]) * difference;
}
