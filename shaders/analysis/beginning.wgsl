// How an observation begins: which one, and what is noted of it from there.

// An observation that begins.
struct Observation {
    // Its forcing periods; 0 where none begins.
    periods: u32,
    // The forcing periods of a turn where it is turn by turn, else 0.
    turn: u32,
}

const NO_OBSERVATION = Observation(0u, 0u);

// Of what returns: turn by turn, where there is time for that. Where it no longer moves at all, and its turns are short, that is
// enough; it is observed for longer otherwise.
fn observation_of_settled(at_rest: bool) -> Observation {
    let n = max(observer.recurrence.n, 1u);
    let turns = max((SETTLED_OBSERVATION + (n - 1u)) / n, SETTLED_TURNS);
    if at_rest && observer_has_short_turns() {
        return observation_by_turns();
    }
    let measured = max(turns * n, observer_turns_needed());
    if measured < schedule.observe {
        return Observation(measured, observer.recurrence.n);
    }
    // Whole turns, where there is time for them: what is measured is the mean over them.
    return Observation(min(turns * n, schedule.observe), 0u);
}

// Of what has not settled: the whole observation, once the transient is over.
fn observation_of_unsettled() -> Observation {
    return Observation(select(0u, schedule.observe, observer.periods >= schedule.transient), 0u);
}

// Of what returns, turn by turn.
fn observation_by_turns() -> Observation {
    return Observation(observer_turns_needed(), observer.recurrence.n);
}

// Whether the turns of what returns are short enough for an observation turn by turn.
fn observer_has_short_turns() -> bool {
    return observer_turns_needed() <= min(BRIEF, schedule.observe);
}

fn observer_turns_needed() -> u32 {
    return observer.recurrence.n * max(SETTLED_TURNS, COMPONENTS);
}

// Carries a deviation along from here. While a mass rests on a stop, deviations along the contact are zero.
fn observer_carry(deviation: State) {
    tangent = deviation;
    if trajectory.contact != CONTACT_FREE {
        tangent = tangent_caught(tangent, trajectory.contact);
    }
}

// Begins an observation, if one begins.
fn observer_begin_observation(begins: Observation) {
    if begins.periods > 0u {
        observer_begin_observing(begins);
    }
}

fn observer_begin_observing(begins: Observation) {
    observer.stage = STAGE_OBSERVATION;
    observer.observe = begins.periods;
    observer.observed = 0u;
    observer.impacts = 0u;
    observer.peak = 0.0;
    observer.stuck = 0u;
    observer.loss = loss_none(trajectory.contact);
    var deviation = tangent_seed();
    if begins.turn > 0u {
        deviation = state_unit(0u);
    }
    observer_carry(deviation);
    observer.recurrence = recurrence_anchored(trajectory.point.state);
    observer.exponent = exponent_over(begins.periods);
    observer.turn = turn_over(begins.turn);
    observer.spread = spread_about(trajectory.point);
    observer.grown = 0.0;
    observer.lost = 0u;
    observer.lately_lost = 0u;
}
