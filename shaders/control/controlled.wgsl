// A trajectory under control, followed from return to return on the section to its outcome.

struct ControlSchedule {
    start: u32,
    iterates: u32,
    observed: u32,
    fixed_iterates: u32,
}

struct Controlled {
    trajectory: Trajectory,
    tangent: State,
    adapted: Adapted,
    memory: Memory,
    deviations: array<array<f32, 4>, DELAYS>,
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
    at_b: u32,
    mirrored: array<f32, 4>,
    impacts: u32,
    impacts_total: u32,
    peak: f32,
    stuck: u32,
    erased: u32,
    escapes: u32,
    effort: f32,
    signal: f32,
}

struct Outcome {
    verdict: Verdict,
    period: u32,
    iterates: u32,
    converged_at: u32,
    signal: f32,
    runaway: u32,
    escapes: u32,
    effort: f32,
}

// What a force in phase with the forcing changes of the constants of flight.
struct Driven {
    gamma_sin: State,
    gamma_cos: State,
    sin: X,
    bound: f32,
}

var<private> driven: Driven;
var<private> controlled: Controlled;
var<private> control_schedule: ControlSchedule;

fn controlled_begin(start: State) {
    trajectory = trajectory_new(start);
    tangent = tangent_seed();
    adapted = Adapted(control.amplitude, control.weight, -1.0);
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
    controlled.at_b = 0u;
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
    let s = control.drive_sin;
    let c = control.drive_cos;
    driven.sin = flights[cell].sin + force * vec2(control.push[0], control.push[1]);
    driven.gamma_sin = state_plus(flights[cell].gamma_sin, force, State(vec2(s[0], s[1]), vec2(s[2], s[3])));
    driven.gamma_cos = state_plus(flights[cell].gamma_cos, force, State(vec2(c[0], c[1]), vec2(c[2], c[3])));
    driven.bound = abs(force) * control.drive_bound;
    controlled.force = force;
}

fn controlled_note(taken: Move) {
    controlled.moves = controlled.moves + 1u;
    if trajectory.contact != CONTACT_FREE {
        controlled.stuck = controlled.iterates + 1u;
    }
    let meets = taken.event >= EVENT_IMPACT && taken.event <= EVENT_COMPLETE_CHATTER;
    if meets && taken.velocity != 0.0 {
        let count = select(1u, INFINITELY_MANY, taken.event == EVENT_COMPLETE_CHATTER);
        controlled.impacts = controlled.impacts + 1u;
        controlled.impacts_total = controlled.impacts_total + 1u;
        controlled.peak = max(controlled.peak, abs(taken.velocity));
        if taken.stop == 0u {
            controlled_arrive(count);
        } else {
            controlled.at_b = added(controlled.at_b, count);
            let m = section_mirrored();
            controlled.mirrored = array<f32, 4>(m.x, m.y, m.z, m.w);
        }
    } else if taken.event == EVENT_STROBE {
        controlled_strobe();
    }
    if controlled.moves > MOST_MOVES {
        controlled.progress = PROGRESS_FAILED;
    }
}

fn controlled_strobe() {
    controlled.moves = 0u;
    controlled.periods = controlled.periods + 1u;
    controlled.passage = controlled.passage + 1u;
    if !state_is_finite(trajectory.point.state) {
        controlled.progress = PROGRESS_FAILED;
    } else if controlled.passage > LONGEST_PASSAGE || contact_is_clamped(trajectory.contact) {
        controlled.progress = PROGRESS_LOST;
    }
}

// A return to the section.
fn controlled_arrive(at_a: u32) {
    let arrived = section_of_trajectory();
    if !section_is_finite(arrived) {
        controlled.progress = PROGRESS_FAILED;
        return;
    }
    var turns = 0.0;
    if memory.seen > 0u {
        turns = f32(controlled.passage) + (arrived.w - memory.points[0][3]) * INVERSE_TAU;
    }
    let on = controlled.iterates >= control_schedule.start;
    if controlled.iterates == control_schedule.start {
        memory_start_over();
    }
    let seen = Seen(arrived, turns, select(0u, controlled.iterates - control_schedule.start, on));
    let observing = controlled.progress == PROGRESS_OBSERVED;
    let deviation = deviations_arrived();
    var action = action_none();
    if on {
        action = method_act(seen);
    }
    var section = section_plus(arrived, action.correction);
    let escaped = section.x > 0.0;
    if escaped {
        section = arrived;
        controlled.escapes = controlled.escapes + 1u;
        action.correction = vec4(0.0, 0.0, 0.0, 0.0);
    }
    if observing {
        if escaped {
            deviations_push(deviation);
        } else {
            deviations_push(deviations_passed(seen, deviation));
        }
    }
    memory_push(section, turns, controlled.at_b, at_a);
    controlled.signal = action.signal;
    if on {
        controlled.effort = controlled.effort + (correction_length(action.correction) + abs(action.force));
        controlled_go_on_from(section, action);
    }
    controlled.iterates = controlled.iterates + 1u;
    controlled.passage = 0u;
    controlled.at_b = 0u;
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

// Leaves the section from a corrected point, under a force.
fn controlled_go_on_from(section: vec4<f32>, action: Action) {
    if section_distance(section, vec4(0.0, 0.0, 0.0, 0.0)) > RUNAWAY {
        controlled.progress = PROGRESS_RUNAWAY;
        return;
    }
    let unchanged = all(action.correction == vec4(0.0, 0.0, 0.0, 0.0));
    if unchanged && action.force == controlled.force {
        return;
    }
    controlled_force(action.force);
    if unchanged {
        trajectory =
            trajectory_from_point(trajectory.point, trajectory.contact, trajectory.step, trajectory.offset);
    } else {
        trajectory = section_trajectory(section, trajectory.contact != CONTACT_FREE);
        // A phase that jumps back time and again never passes a strobe.
        controlled.moves = 0u;
    }
}

fn controlled_observe(turns: f32) {
    controlled.observed = controlled.observed + 1u;
    controlled.observed_turns = controlled.observed_turns + turns;
    let factor = deviations_growth();
    if factor > 0.0 {
        exponent_add(log(factor));
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

fn controlled_outcome() -> Outcome {
    var iterates = 0u;
    if controlled.iterates > control_schedule.start {
        iterates = controlled.iterates - control_schedule.start;
    }
    var period = 0u;
    if controlled.progress == PROGRESS_DONE {
        period = memory_period(min(iterates / 4u, CONTROL_SETTLING));
    }
    var counts = vec3(0u, 0u, 0u);
    var point = memory_point(0u);
    var converged_at = NEVER;
    if period > 0u {
        counts = memory_counts(period);
        point = memory_hardest(period);
        let since = memory.returning[period - 1u];
        converged_at = select(0u, since - control_schedule.start, since > control_schedule.start);
    }
    let symmetric = period > 0u && counts.x % 2u == 1u && counts.y == counts.z && controlled_is_symmetric(period);
    var lyapunov = NOT_MEASURED;
    let measured =
        observer.exponent.batches > 0u && controlled.erased == 0u && controlled.observed_turns > 0.0;
    if measured {
        let periods = controlled.observed_turns / f32(controlled.observed);
        lyapunov = exponent_per_period() / periods;
    }
    var effort = 0.0;
    if iterates > 0u {
        effort = controlled.effort / f32(iterates);
    }
    return Outcome(
        Verdict(
            controlled_regime(period),
            counts.x,
            select(0u, 1u, symmetric),
            lyapunov,
            array<u32, MOST>(counts.z, counts.y, 0u, 0u),
            array<f32, 8>(point.x, point.y, point.z, point.w, 0.0, 0.0, 0.0, 0.0),
            controlled.impacts,
            controlled.impacts_total,
            controlled.peak,
            controlled.periods,
            0u,
            0u,
            0.0,
            0.0,
        ),
        period,
        controlled.iterates,
        converged_at,
        controlled.signal,
        select(0u, 1u, controlled.progress == PROGRESS_RUNAWAY),
        controlled.escapes,
        effort,
    );
}

fn controlled_is_symmetric(period: u32) -> bool {
    let m = controlled.mirrored;
    var symmetric = false;
    for (var i = 0u; i < period; i++) {
        let away = section_distance(memory_point(i), vec4(m[0], m[1], m[2], m[3]));
        symmetric = symmetric || away <= RETURNED;
    }
    return symmetric;
}

// Whether the first mass rested on a stop in the last so many iterates.
fn controlled_has_stuck_for(iterates: u32) -> bool {
    return controlled.stuck > 0u && controlled.stuck + iterates > controlled.iterates;
}

fn controlled_regime(period: u32) -> u32 {
    if controlled.progress == PROGRESS_FAILED {
        return REGIME_FAILED;
    }
    if controlled.progress == PROGRESS_LOST && controlled.at_b == 0u {
        return REGIME_NO_IMPACT;
    }
    if controlled.progress != PROGRESS_DONE {
        return REGIME_UNRESOLVED;
    }
    if period > 0u {
        return select(REGIME_PERIODIC, REGIME_PERIODIC_STICKING, controlled_has_stuck_for(period));
    }
    if controlled_has_stuck_for(controlled.observed) {
        return REGIME_APERIODIC_STICKING;
    }
    if observer.exponent.batches == 0u || controlled.erased == 1u {
        return REGIME_UNRESOLVED;
    }
    let growth = observer.exponent.sum;
    if growth > CHAOTIC_GROWTH && exponent_per_period() > SIGNIFICANCE * exponent_standard_error() {
        return REGIME_CHAOTIC;
    }
    if abs(growth) < NEUTRAL_GROWTH && spread_is_stationary(controlled.observed / 2u) {
        return REGIME_QUASI_PERIODIC;
    }
    return REGIME_UNRESOLVED;
}
