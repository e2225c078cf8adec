// Delayed feedback, with the sign that stabilises.

fn delay_act(seen: Seen) -> Action {
    if memory.seen <= control.delay_iterates {
        return action_none();
    }
    return action_correcting(delay_feedback(section_minus(memory.points[0], memory.points[control.delay_iterates])));
}

fn delay_is_at_rest() -> bool {
    return true;
}

// The deviations of both points are fed back.
fn delay_passed(seen: Seen, arrived: SectionPoint) -> SectionPoint {
    let before = section_scaled(-1.0, deviations[control.delay_iterates]);
    return section_added(arrived, delay_feedback(section_added(deviations[0], before)));
}

// G times a difference.
fn delay_feedback(difference: SectionPoint) -> SectionPoint {
    let gains = section_of_values(control.delay_gains);
    return SectionPoint(gains.head * difference.head, gains.tail * difference.tail);
}
