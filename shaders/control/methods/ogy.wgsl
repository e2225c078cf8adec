// Small kicks that put the point on the stable directions of an unstable motion.

fn ogy_act(seen: Seen) -> Action {
    let kick = ogy_kick(seen);
    if abs(kick) <= control.ogy_window {
        return action_correcting(section_of_first(kick));
    }
    return action_none();
}

fn ogy_is_at_rest() -> bool {
    return true;
}

// What deviates along the unstable direction is taken away.
fn ogy_passed(seen: Seen, arrived: SectionPoint) -> SectionPoint {
    if abs(ogy_kick(seen)) <= control.ogy_window {
        return section_added(arrived, section_of_first(-ogy_along(arrived)));
    }
    return arrived;
}

// The kick that puts a point on the stable directions.
fn ogy_kick(seen: Seen) -> f32 {
    return -ogy_along(section_minus(seen.section, section_of_values(control.ogy_point)));
}

// How far a deviation reaches along the unstable direction.
fn ogy_along(deviation: SectionPoint) -> f32 {
    let gains = section_of_values(control.ogy_gains);
    return along(gains.head, deviation.head) + along(gains.tail, deviation.tail);
}
