// What an observed trajectory settled on.

// Whether what returns is a motion that was reached: nearby trajectories do not leave it.
fn observer_is_settled() -> bool {
    let measured = observer.turn.n > 0u;
    let stays = select(observer.grown <= NEUTRAL_GROWTH, observer.turn.exponent <= NEUTRAL_RATE, measured);
    return recurrence_is_settled() && stays;
}

// Whether the state began to return only within the observation.
fn observer_is_late() -> bool {
    return observer.recurrence.since < observer.observed;
}

// Whether the observation ended within a turn of what returns: what was measured is no mean over whole ones.
fn observer_is_within_turn() -> bool {
    let n = observer.recurrence.n;
    return n > 0u && observer.observed % max(n, 1u) != 0u;
}

fn observer_regime() -> u32 {
    if observer.stage == STAGE_FAILED {
        return REGIME_FAILED;
    }
    if observer.stage == STAGE_QUIET || (observer.impacts == 0u && observer.stuck == 0u) {
        return REGIME_NO_IMPACT;
    }
    let returns = recurrence_holds_for(observer_proof());
    var impacts = 0u;
    //: each stop
    impacts = max(impacts, observer.recurrence.impacts[$k]);
    //: end
    if returns && impacts == 0u && observer.stuck == 0u {
        return REGIME_NO_IMPACT;
    }
    let sticks = observer.stuck == 1u;
    return evidence_regime(Evidence(returns, observer_is_settled(), sticks, true, observer.observe / 2u));
}

// The state that is reported: where the trajectory ends, or the forced response that motion decays onto.
fn observer_state(regime: u32) -> State {
    if regime == REGIME_NO_IMPACT && observer.stage == STAGE_QUIET && flight.quiet_decays == 1u {
        return flight.quiet_forced;
    }
    return trajectory_present().state;
}

fn observer_verdict() -> Verdict {
    let regime = observer_regime();
    let periodic = regime == REGIME_PERIODIC || regime == REGIME_PERIODIC_STICKING;
    let late = periodic && observer_is_late();
    let lost = select(observer.lost, observer.lately_lost, late);
    var lyapunov = NOT_MEASURED;
    if regime == REGIME_NO_IMPACT {
        lyapunov = flight.linear_exponent;
    } else if observer.turn.n > 0u && periodic {
        lyapunov = observer.turn.exponent;
    } else if regime != REGIME_FAILED && lost == 1u {
        lyapunov = FORGETS;
    } else if regime != REGIME_FAILED && observer.exponent.batches > 0u {
        lyapunov = exponent_per_period();
        if late {
            lyapunov = observer.grown / f32(observer.recurrence.since);
        }
    }
    // What came before an observation is not of it.
    let observed = observer.stage == STAGE_OBSERVED;
    let may_return = regime != REGIME_NO_IMPACT && regime != REGIME_FAILED;
    let in_question = !periodic || late || observer_is_within_turn();
    let returning = may_return && in_question && recurrence_holds_for(0u);
    let symmetric = periodic && observer.recurrence.n % 2u == 1u && observer.recurrence.symmetric == 1u;
    var impacts_per_stop = array<u32, MOST>();
    //: each stop
    impacts_per_stop[$k] = select(0u, observer.recurrence.impacts[$k], periodic);
    //: end
    var power = 0.0;
    var contact = 0.0;
    if observer.stage == STAGE_FAILED {
        power = NOT_MEASURED;
        contact = NOT_MEASURED;
    } else if observed {
        let time = f32(observer.observed) * (f32(flight.steps) * flight.h);
        power = observer.loss.energy / time;
        contact = observer.loss.rested / time;
    }
    return Verdict(
        regime,
        select(0u, observer.recurrence.n, periodic),
        select(0u, 1u, symmetric),
        lyapunov,
        impacts_per_stop,
        state_values(observer_state(regime)),
        select(0u, observer.impacts, observed),
        observer.impacts_total,
        select(0.0, observer.peak, observed),
        observer.periods,
        select(0u, observer.recurrence.n, returning),
        select(0u, observer.observed, observed),
        power,
        contact,
    );
}
