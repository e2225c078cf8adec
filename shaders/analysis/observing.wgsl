// What is noted of a trajectory: its impacts, and at every strobe whether the transient or the observation ends.

fn observer_note(taken: Move) {
    if taken.event != EVENT_STEP_END {
        if observer.stage == STAGE_OBSERVATION {
            loss_note(taken);
        }
        if trajectory.contact != CONTACT_FREE {
            observer.stuck = 1u;
        }
    }
    if is_impact(taken) {
        observer_impact(taken.stop, taken.velocity, taken.event == EVENT_COMPLETE_CHATTER);
        observer_count_beside(taken.beside);
    } else if taken.event == EVENT_HALF_PERIOD {
        observer_half_period();
    } else if taken.event != EVENT_STEP_END {
        observer.moves = observer.moves + 1u;
        if taken.event == EVENT_STROBE {
            let observed = observer.stage == STAGE_OBSERVATION;
            observer_strobe(observed, observer_is_at_rare_strobe(observed));
        }
    }
    observer_give_up();
}

fn observer_impact(stop: u32, velocity: f32, complete_chatter: bool) {
    observer.moves = observer.moves + 1u;
    recurrence_count(stop, complete_chatter);
    observer.impacts = saturating(observer.impacts, 1u);
    observer.impacts_total = saturating(observer.impacts_total, 1u);
    observer.peak = max(observer.peak, abs(velocity));
}

fn observer_half_period() {
    if observer.stage == STAGE_OBSERVATION {
        recurrence_at_half_period(trajectory.point.state, RETURNED);
    }
}

// Gives up a trajectory that makes no headway.
fn observer_give_up() {
    if observer.moves > MOST_MOVES {
        observer.stage = STAGE_FAILED;
    }
}

// Infinitely many impacts at every stop that shares the rebounds of another.
fn observer_count_beside(beside: u32) {
    if beside == CONTACT_FREE {
        return;
    }
    //: each normal
    if contact_includes(beside, End($ku, 0u)) {
        recurrence_count(flight.normals[$k].stop[0], true);
    }
    if contact_includes(beside, End($ku, 1u)) {
        recurrence_count(flight.normals[$k].stop[1], true);
    }
    //: end
}

// Notes that the trajectory came to phase 0 in free flight, under observation or in the transient, where nothing is to be made of
// the map of a turn.
fn observer_arrive(observed: bool) {
    observer.moves = observer.moves + 1u;
    observer_strobe(observed, false);
    observer_give_up();
}

// Whether the strobe that the trajectory comes to asks for what is long and rare: it completes the map of a turn, may be left by a
// leap, or halves an observation that may end there.
fn observer_is_at_rare_strobe(observed: bool) -> bool {
    let n = observer.turn.n;
    let next = observer.observed + 1u;
    return select(n > 0u, (n > 0u && next == n * COMPONENTS) || observer_is_halved(next), observed);
}

// Whether half of a whole observation is over after so many periods, and that is long enough to see that chaos is plain.
fn observer_is_halved(observed: u32) -> bool {
    let whole = schedule.fixed_periods == 0u && observer.turn.n == 0u && observer.observe == schedule.observe;
    return whole && observed >= SETTLING && observed == observer.observe / 2u;
}

fn observer_strobe(observed: bool, rare: bool) {
    let state = trajectory.point.state;
    let moved = observer.moves > 1u;
    observer.moves = observer.moves - min(observer.moves, FAIR_MOVES);
    observer.periods = observer.periods + 1u;
    if !state_is_bounded(state) {
        observer.stage = STAGE_FAILED;
        return;
    }
    //: each normal
    if contact_is_clamped_along(trajectory.contact, $ku) {
        recurrence_count(flight.normals[$k].stop[0], true);
        recurrence_count(flight.normals[$k].stop[1], true);
    }
    //: end
    var begins = NO_OBSERVATION;
    if observed {
        begins = observer_observe(state, rare);
    } else {
        begins = observer_settle(state, moved, rare);
    }
    observer_begin_observation(begins);
}

// A strobe of the transient: what observation begins there. Where the trajectory `moved`, it can impact again.
fn observer_settle(state: State, moved: bool, rare: bool) -> Observation {
    if schedule.fixed_periods == 0u {
        if !moved && trajectory.contact == CONTACT_FREE && is_quiet(trajectory.point) {
            observer.stage = STAGE_QUIET;
            return NO_OBSERVATION;
        }
        let patience = max(min(observer.periods / PATIENCE_SHARE, schedule.max_period), 1u);
        recurrence_at_strobe(state, RETURNING, patience, false);
        if rare {
            observer_leap();
        }
        let at_rest = observer.recurrence.worst <= AT_REST;
        let still = at_rest && recurrence_holds_for(SETTLING_AT_REST);
        let keeps = !at_rest && recurrence_kept_for(SETTLING) && observer.recurrence.worst <= SETTLED;
        if still || keeps {
            return observation_of_settled(at_rest);
        }
        if observer_is_to_leap() {
            observer.leaps = observer.leaps - 1u;
            return observation_by_turns();
        }
        if observer.turn.n == 0u {
            recurrence_follow_along(state, FOLLOWING);
        }
    }
    return observation_of_unsettled();
}

// A strobe of the observation: what other observation begins there.
fn observer_observe(state: State, rare: bool) -> Observation {
    observer.observed = observer.observed + 1u;
    let half = observer.observe / 2u;
    recurrence_at_strobe(state, RETURNED, schedule.max_period, observer.observed >= half);
    observer_measure_growth(rare);
    if observer.observed <= 2u * half {
        spread_at_strobe(trajectory.point, observer.observed > half);
    }
    if rare && observer_is_halved(observer.observed) && observer_is_plainly_chaotic() {
        observer.observe = observer.observed;
        observer.stage = STAGE_OBSERVED;
        return NO_OBSERVATION;
    }
    if observer.observed < observer.observe {
        return NO_OBSERVATION;
    }
    // What leaps, or came to rest, must have ended there.
    let brief = observer.turn.n > 0u && observer.observe <= BRIEF;
    let still = observer.recurrence.worst <= ROUNDING;
    let settled = !brief || (still && observer_is_settled());
    if observer.observe < schedule.observe && !(settled && recurrence_holds_for(observer_proof())) {
        // It had not settled after all: the observation is discarded and the transient goes on.
        observer.recurrence = recurrence_anchored(state);
        observer.stage = STAGE_TRANSIENT;
        if !brief {
            observer.turn = turn_over(0u);
        }
        return observation_of_unsettled();
    }
    observer.stage = STAGE_OBSERVED;
    return NO_OBSERVATION;
}

// Whether what was observed so far says plainly that the motion is chaotic.
fn observer_is_plainly_chaotic() -> bool {
    let impacts = observer.impacts > 0u && observer.stuck == 0u && !recurrence_holds_for(0u);
    return impacts && exponent_grows(PLAIN_GROWTH);
}

// Measures how the tangent vector grows: turn by turn; or batch by batch, and also where the recurrence's anchor was set and where the
// observation ends, for what it grew by in between. A mass that rests on a stop can take the vector: it is not left to grow.
fn observer_measure_growth(rare: bool) {
    if observer.turn.n == 0u {
        let anchored = observer.recurrence.since == 0u;
        let ends = observer.observed == observer.observe;
        let lost = select(0u, 1u, tangent_is_lost(tangent));
        observer.lost = observer.lost | lost;
        observer.lately_lost = select(observer.lately_lost | lost, 0u, anchored);
        let growth = exponent_at_strobe(anchored | (observer.stuck == 1u) | ends);
        observer.grown = select(observer.grown + growth, 0.0, anchored);
    } else if observer.observed % observer.turn.n == 0u {
        let turns = observer.observed / observer.turn.n;
        turn_complete(turns, rare);
        observer_carry(state_unit(turns));
    }
}

fn observer_proof() -> u32 {
    return min(observer.observe / PROOF_SHARE, SETTLING);
}
