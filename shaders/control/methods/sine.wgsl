// A sine force on one coordinate, its amplitude adapted: a kick at each return, or a force in phase with the forcing.

fn sine_act(seen: Seen) -> Action {
    let error = sine_error(seen.section);
    if error >= control.dead_band {
        if adapted.error >= 0.0 && error > adapted.error {
            adapted.weight = -adapted.weight;
        }
        adapted.amplitude = adapted.amplitude + adapted.weight * error;
    }
    adapted.error = error;
    if control.convention == CONVENTION_KICK {
        let kick = adapted.amplitude * sine_phasor(control.ratio * seen.turns).x;
        return Action(section_of_first(kick), 0.0, adapted.amplitude);
    }
    return Action(section_zero(), adapted.amplitude, adapted.amplitude);
}

fn sine_error(section: SectionPoint) -> f32 {
    let error = section_component(section, control.component) - control.wanted;
    if control.component == COMPONENTS - 1u {
        return abs(short_way(error));
    }
    return abs(error);
}

// Sine and cosine of an angle given in turns, with φ.
fn sine_phasor(turns: f32) -> vec2<f32> {
    let shifted = turns + control.phase;
    return sine_and_cosine(TAU * (shifted - floor(shifted)));
}

fn sine_is_at_rest() -> bool {
    return adapted.weight == 0.0 || (adapted.error >= 0.0 && adapted.error < control.dead_band);
}

// How a deviation passes the kick.
fn sine_passed(seen: Seen, arrived: SectionPoint) -> SectionPoint {
    if control.convention != CONVENTION_KICK {
        return arrived;
    }
    let later = section_tau(arrived) - section_tau(deviations[0]);
    let kick = adapted.amplitude * sine_phasor(control.ratio * seen.turns).y * (control.ratio * later);
    return section_added(arrived, section_of_first(kick));
}
