// Delayed feedback, with the sign that stabilises.

fn delay_act() -> Action {
    if memory.seen <= control.delay {
        return action_none();
    }
    return action_correcting(delay_feedback(section_minus(memory.points[0], memory.points[control.delay])));
}

// G times a difference.
fn delay_feedback(difference: SectionPoint) -> SectionPoint {
    let gains = section_of_values(control.gains);
    return SectionPoint(gains.head * difference.head, gains.tail * difference.tail);
}
