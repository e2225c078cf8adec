// A sine force on one coordinate, its amplitude adapted: a kick at each return, or a force in phase with the forcing.

fn sine_act(seen: Seen) -> Action {
    let error = sine_error(seen.section);
    if error >= control.sine_dead_band {
        if adapted.sine_error >= 0.0 && error > adapted.sine_error {
            adapted.sine_weight = -adapted.sine_weight;
        }
        adapted.sine_amplitude = adapted.sine_amplitude + adapted.sine_weight * error;
    }
    adapted.sine_error = error;
    if control.sine_convention == CONVENTION_KICK {
        let kick = adapted.sine_amplitude * sine_phasor(control.sine_ratio * seen.turns).x;
        return Action(section_of_first(kick), 0.0, adapted.sine_amplitude);
    }
    return Action(section_zero(), adapted.sine_amplitude, adapted.sine_amplitude);
}

fn sine_error(section: SectionPoint) -> f32 {
    let error = section_component(section, control.sine_component) - control.sine_wanted;
    if control.sine_component == COMPONENTS - 1u {
        return abs(short_way(error));
    }
    return abs(error);
}

// Sine and cosine of an angle given in turns, with φ.
fn sine_phasor(turns: f32) -> vec2<f32> {
    let shifted = turns + control.sine_phase;
    return sine_and_cosine(TAU * (shifted - floor(shifted)));
}

fn sine_is_at_rest() -> bool {
    return adapted.sine_weight == 0.0 || (adapted.sine_error >= 0.0 && adapted.sine_error < control.sine_dead_band);
}

// How a deviation passes the kick.
fn sine_passed(seen: Seen, arrived: SectionPoint) -> SectionPoint {
    if control.sine_convention != CONVENTION_KICK {
        return arrived;
    }
    let later = section_tau(arrived) - section_tau(deviations[0]);
    let kick = adapted.sine_amplitude * sine_phasor(control.sine_ratio * seen.turns).y * (control.sine_ratio * later);
    return section_added(arrived, section_of_first(kick));
}
