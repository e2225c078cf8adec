// A trajectory under control, followed from return to return on the section to its outcome.

struct Controlled {
    trajectory: Trajectory,
    tangent: State,
    adapted: Adapted,
    memory: Memory,
    deviations: array<SectionPoint, DELAYS>,
    exponent: Exponent,
    spread: Spread,
    // The force of the present iterate.
    force: f32,
    progress: u32,
    iterates: u32,
    observed: u32,
    observed_turns: f32,
    periods: u32,
    passage: u32,
    moves: u32,
    at_stops: vec4<u32>,
    mirrored: SectionPoint,
    impacts: u32,
    impacts_total: u32,
    peak: f32,
    stuck: u32,
    erased: u32,
    escapes: u32,
    effort: f32,
    signal: f32,
}

// What a force in phase with the forcing changes of the constants of flight.
struct Driven {
    gamma_sin: State,
    gamma_cos: State,
    sin: X,
    // By normal.
    bound: array<f32, NORMALS>,
}

var<private> driven: Driven;
var<private> controlled: Controlled;
var<private> control_schedule: ControlSchedule;

fn controlled_begin(start: State) {
    trajectory = trajectory_new(start);
    tangent = tangent_seed();
    adapted = adapted_begin();
    observer.exponent = exponent_over(control_schedule.observed);
    observer.spread = spread_about(trajectory.point);
    deviations_seed();
    memory.seen = 0u;
    memory_start_over();
    controlled.force = 0.0;
    controlled.progress = PROGRESS_SETTLING;
    controlled.iterates = 0u;
    controlled.observed = 0u;
    controlled.observed_turns = 0.0;
    controlled.periods = 0u;
    controlled.passage = 0u;
    controlled.moves = 0u;
    controlled.at_stops = vec4(0u);
    controlled.mirrored = section_zero();
    controlled.impacts = 0u;
    controlled.impacts_total = 0u;
    controlled.peak = 0.0;
    controlled.stuck = 0u;
    controlled.erased = 0u;
    controlled.escapes = 0u;
    controlled.effort = 0.0;
    controlled.signal = 0.0;
}

// Takes the constants of flight under a force in phase with the forcing; always from those without, so that it does
// not matter which forces went before.
fn controlled_force(force: f32) {
    // As they are without the force: elsewhere `flight` has them with it.
    driven.sin = flights[flow].sin + force * x_of_values(control.push);
    driven.gamma_sin = state_plus(flights[flow].gamma_sin, force, state_of_values(control.drive_sin));
    driven.gamma_cos = state_plus(flights[flow].gamma_cos, force, state_of_values(control.drive_cos));
    //: each normal
    driven.bound[$k] = abs(force) * control.drive_bound[$k];
    //: end
    controlled.force = force;
}

fn controlled_note(taken: Move) {
    controlled.moves = controlled.moves + 1u;
    if trajectory.contact != CONTACT_FREE && !contact_is_clamped_only(trajectory.contact) {
        controlled.stuck = controlled.iterates + 1u;
    }
    if is_impact(taken) {
        // Before the return: they belong to it.
        controlled_count_beside(taken.beside);
        let count = select(1u, INFINITELY_MANY, taken.event == EVENT_COMPLETE_CHATTER);
        controlled.impacts = saturating(controlled.impacts, 1u);
        controlled.impacts_total = saturating(controlled.impacts_total, 1u);
        controlled.peak = max(controlled.peak, abs(taken.velocity));
        controlled.at_stops = added(controlled.at_stops, select(vec4(0u), vec4(count), controlled_place(taken.stop)));
        if control.mirror[control.stop] == taken.stop {
            controlled.mirrored = section_mirrored();
        }
        if taken.stop == control.stop {
            controlled_arrive();
        }
    } else if taken.event == EVENT_STROBE {
        controlled_strobe();
    }
    if controlled.moves > MOST_MOVES {
        controlled.progress = PROGRESS_FAILED;
    }
}

// Infinitely many impacts at every stop that shares the rebounds of another.
fn controlled_count_beside(beside: u32) {
    if beside == CONTACT_FREE {
        return;
    }
    //: each normal
    if contact_includes(beside, End($ku, 0u)) {
        controlled_count_without_end(flight.normals[$k].stop[0]);
    }
    if contact_includes(beside, End($ku, 1u)) {
        controlled_count_without_end(flight.normals[$k].stop[1]);
    }
    //: end
}

fn controlled_count_without_end(stop: u32) {
    controlled.at_stops = select(controlled.at_stops, vec4(INFINITELY_MANY), controlled_place(stop));
}

// Where counts at a stop stand.
fn controlled_place(stop: u32) -> vec4<bool> {
    return vec4(stop) == vec4(0u, 1u, 2u, 3u);
}

fn controlled_strobe() {
    controlled.moves = controlled.moves - min(controlled.moves, FAIR_MOVES);
    controlled.periods = controlled.periods + 1u;
    controlled.passage = controlled.passage + 1u;
    if !state_is_bounded(trajectory.point.state) {
        controlled.progress = PROGRESS_FAILED;
    } else if controlled.passage > LONGEST_PASSAGE || contact_is_clamped_along(trajectory.contact, control.normal) {
        controlled.progress = PROGRESS_LOST;
    }
}

// A return to the section.
fn controlled_arrive() {
    let arrived = section_of_trajectory();
    if !section_is_finite(arrived) {
        controlled.progress = PROGRESS_FAILED;
        return;
    }
    var turns = 0.0;
    if memory.seen > 0u {
        let last = section_tau(memory.points[0]);
        turns = f32(controlled.passage) + (section_tau(arrived) - last) * INVERSE_TAU;
    }
    let on = controlled.iterates >= control_schedule.start;
    if controlled.iterates == control_schedule.start {
        memory_start_over();
    }
    let seen = Seen(arrived, turns, select(0u, controlled.iterates - control_schedule.start, on));
    let observing = controlled.progress == PROGRESS_OBSERVED;
    var action = action_none();
    if on {
        action = method_act(seen);
    }
    var section = section_plus(arrived, action.correction);
    let escaped = !section_is_zero(action.correction) && !leaving_is_admitted(section);
    if escaped {
        section = arrived;
        controlled.escapes = controlled.escapes + 1u;
        action.correction = section_zero();
    }
    if observing {
        let deviation = deviations_arrived();
        if escaped {
            deviations_push(deviation);
        } else {
            deviations_push(method_passed(seen, deviation));
        }
    }
    memory_push(section, turns, controlled.at_stops);
    controlled.signal = action.signal;
    if on {
        controlled.effort = controlled.effort + (correction_length(action.correction) + abs(action.force));
        leaving_goes_on_from(section, action);
    }
    controlled.iterates = controlled.iterates + 1u;
    controlled.passage = 0u;
    controlled.at_stops = vec4(0u);
    if controlled.progress == PROGRESS_RUNAWAY {
        return;
    }
    if observing {
        controlled_observe(turns);
    }
    if on {
        controlled_schedule_on();
    }
}

fn controlled_observe(turns: f32) {
    controlled.observed = controlled.observed + 1u;
    controlled.observed_turns = controlled.observed_turns + turns;
    let factor = deviations_growth();
    if factor > 0.0 {
        exponent_add(logarithm(factor));
    } else {
        controlled.erased = 1u;
    }
    let half = control_schedule.observed / 2u;
    if controlled.observed <= 2u * half {
        spread_at_strobe(trajectory.point, controlled.observed > half);
    }
    tangent = deviations_leaving();
}

fn controlled_schedule_on() {
    let settled =
        control_schedule.fixed_iterates == 0u && method_is_at_rest() && memory_is_settled(CONTROL_SETTLING);
    if controlled.iterates >= control_schedule.iterates || settled {
        controlled.progress = PROGRESS_DONE;
    } else if controlled.progress == PROGRESS_SETTLING
        && controlled.iterates >= control_schedule.iterates - control_schedule.observed {
        controlled.progress = PROGRESS_OBSERVED;
        controlled.impacts = 0u;
        controlled.peak = 0.0;
        deviations_seed();
        tangent = deviations_leaving();
        observer.spread = spread_about(trajectory.point);
    }
}
