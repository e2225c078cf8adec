// A sine force on the first mass, its amplitude adapted: a kick at each return, or a force in phase with the forcing.

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
        return Action(vec4(kick, 0.0, 0.0, 0.0), 0.0, adapted.amplitude);
    }
    return Action(vec4(0.0, 0.0, 0.0, 0.0), adapted.amplitude, adapted.amplitude);
}

fn sine_error(section: vec4<f32>) -> f32 {
    if control.component == 3u {
        return abs(short_way(section.w - control.wanted));
    }
    return abs(section[control.component] - control.wanted);
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
fn sine_deviated(seen: Seen, before: vec4<f32>, arrived: vec4<f32>) -> vec4<f32> {
    if control.convention != CONVENTION_KICK {
        return arrived;
    }
    let later = arrived.w - before.w;
    let kick = adapted.amplitude * sine_phasor(control.ratio * seen.turns).y * (control.ratio * later);
    return vec4(arrived.x + kick, arrived.yzw);
}
