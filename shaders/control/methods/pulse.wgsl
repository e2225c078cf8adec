// Period pulses that bring every P-th point back to the target.

fn pulse_act(seen: Seen) -> Action {
    if !pulse_is_due(seen) {
        return action_none();
    }
    let away = section_minus(section_of_values(control.pulse_point), seen.section);
    var errors = section_zero();
    //: each coordinate
    errors.head$c = pulse_uniform(seen.controlled, $iu);
    errors.tail$c = pulse_uniform(seen.controlled, COORDINATES + $iu);
    //: end
    return action_correcting(
        SectionPoint(away.head - control.pulse_noise * errors.head, away.tail - control.pulse_noise * errors.tail),
    );
}

fn pulse_is_at_rest() -> bool {
    return true;
}

// A pulse erases a deviation.
fn pulse_passed(seen: Seen, arrived: SectionPoint) -> SectionPoint {
    if pulse_is_due(seen) {
        return section_zero();
    }
    return arrived;
}

fn pulse_is_due(seen: Seen) -> bool {
    return seen.controlled % control.pulse_period == 0u;
}

// A number between -1 and 1 that depends on nothing but seed, iterate and component.
fn pulse_uniform(iterate: u32, component: u32) -> f32 {
    let mixed = pulse_hash(pulse_hash(control.pulse_seed ^ (iterate * ERRORS_APART + component)) + iterate);
    return f32(mixed >> HASH_DROPPED) * HASH_UNIT - 1.0;
}

fn pulse_hash(value: u32) -> u32 {
    let state = value * HASH_MULTIPLIER + HASH_INCREMENT;
    let word = ((state >> ((state >> HASH_CHOICE) + HASH_LEAST)) ^ state) * HASH_FACTOR;
    return (word >> HASH_LAST) ^ word;
}
