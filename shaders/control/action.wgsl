// What every control method does: at each return to the section it sets a correction or a force.

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

var<private> control: Control;
// What changes of a method as it works.
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
