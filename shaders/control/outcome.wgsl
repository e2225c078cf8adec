// What became of a controlled trajectory.

fn controlled_outcome() -> Outcome {
    var iterates = 0u;
    if controlled.iterates > control_schedule.start {
        iterates = controlled.iterates - control_schedule.start;
    }
    var period = 0u;
    if controlled.progress == PROGRESS_DONE {
        period = memory_period(min(iterates / PROOF_SHARE, CONTROL_SETTLING));
    }
    var n = 0u;
    var impacts = vec4(0u);
    var point = memory.points[0];
    var converged_at = NEVER;
    if period > 0u {
        n = memory_periods(period);
        impacts = memory_impacts(period);
        point = memory_hardest(period);
        let since = memory.returning[period - 1u];
        converged_at = select(0u, since - control_schedule.start, since > control_schedule.start);
    }
    let symmetric = period > 0u && n % 2u == 1u && controlled_is_symmetric(period, impacts);
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
            n,
            select(0u, 1u, symmetric),
            lyapunov,
            array<u32, MOST>(impacts.x, impacts.y, impacts.z, impacts.w),
            array<f32, MOST_COMPONENTS>(),
            controlled.impacts,
            controlled.impacts_total,
            controlled.peak,
            controlled.periods,
            0u,
            0u,
            0.0,
            0.0,
        ),
        section_values(point),
        period,
        controlled.iterates,
        converged_at,
        controlled.signal,
        select(0u, 1u, controlled.progress == PROGRESS_RUNAWAY),
        controlled.escapes,
        effort,
    );
}

fn controlled_is_symmetric(period: u32, impacts: vec4<u32>) -> bool {
    var symmetric = false;
    for (var i = 0u; i < period; i++) {
        symmetric = symmetric || section_away(controlled.mirrored, memory.points[i], stops.unit) <= RETURNED;
    }
    //: each stop
    symmetric = symmetric && control.mirror[$k] < MOST && impacts[$k] == impacts[control.mirror[$k]];
    //: end
    return symmetric;
}

// Whether a mass rested on a stop in the last so many iterates, or since.
fn controlled_has_stuck_for(iterates: u32) -> bool {
    return controlled.stuck > 0u && controlled.stuck + iterates > controlled.iterates;
}

fn controlled_regime(period: u32) -> u32 {
    if controlled.progress == PROGRESS_FAILED {
        return REGIME_FAILED;
    }
    let impacts = any(controlled.at_stops != vec4(0u));
    if controlled.progress == PROGRESS_LOST && !impacts && !controlled_has_stuck_for(0u) {
        return REGIME_NO_IMPACT;
    }
    if controlled.progress != PROGRESS_DONE {
        return REGIME_UNRESOLVED;
    }
    let returns = period > 0u;
    let sticks = controlled_has_stuck_for(select(controlled.observed, period, returns));
    let measured = controlled.erased == 0u;
    return evidence_regime(Evidence(returns, returns, sticks, measured, controlled.observed / 2u));
}
