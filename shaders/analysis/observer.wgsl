// One trajectory followed to its verdict: transient, settling, observation.

struct Schedule {
    transient: u32,
    observe: u32,
    max_period: u32,
    fixed_periods: u32,
}

struct Observer {
    trajectory: Trajectory,
    tangent: State,
    recurrence: Recurrence,
    exponent: Exponent,
    spread: Spread,
    grown: f32,
    stage: u32,
    periods: u32,
    observed: u32,
    observe: u32,
    moves: u32,
    impacts: u32,
    impacts_total: u32,
    peak: f32,
    stuck: u32,
    loss: Loss,
}

struct Verdict {
    regime: u32,
    n: u32,
    symmetric: u32,
    lyapunov: f32,
    impacts_per_stop: array<u32, MOST>,
    state: array<f32, 8>,
    impacts: u32,
    impacts_total: u32,
    peak_impact_velocity: f32,
    periods: u32,
    returning: u32,
    observed: u32,
    power: f32,
    contact: f32,
}

var<private> observer: Observer;
var<private> schedule: Schedule;

// Goes on with an observer that was stored.
fn observer_resume(saved: Observer) {
    observer = saved;
    trajectory = saved.trajectory;
    tangent = saved.tangent;
}

// The observer as it is to be stored.
fn observer_saved() -> Observer {
    var saved = observer;
    saved.trajectory = trajectory;
    saved.tangent = tangent;
    return saved;
}

// Begins at forcing phase 0. While an observer works, `trajectory` and `tangent` hold what it will store.
fn observer_begin(start: State) {
    trajectory = trajectory_new(start);
    tangent = tangent_seed();
    observer.recurrence = recurrence_anchored(trajectory.point.state);
    observer.exponent = exponent_over(schedule.observe);
    observer.spread = spread_about(trajectory.point);
    observer.grown = 0.0;
    observer.stage = STAGE_TRANSIENT;
    observer.periods = 0u;
    observer.observed = 0u;
    observer.observe = schedule.observe;
    observer.moves = 0u;
    observer.impacts = 0u;
    observer.impacts_total = 0u;
    observer.peak = 0.0;
    observer.stuck = 0u;
    observer.loss = loss_none(CONTACT_FREE);
    if schedule.transient == 0u {
        observer_begin_observation(schedule.observe);
    }
}

fn observer_note(taken: Move) {
    if observer.stage == STAGE_OBSERVATION && taken.event != EVENT_STEP_END {
        loss_note(taken);
    }
    if trajectory.contact != CONTACT_FREE {
        observer.stuck = 1u;
    }
    if taken.event >= EVENT_IMPACT && taken.event <= EVENT_COMPLETE_CHATTER && taken.velocity != 0.0 {
        observer_impact(taken.stop, taken.velocity, taken.event == EVENT_COMPLETE_CHATTER);
        observer_count_beside(taken.beside);
    } else if taken.event == EVENT_HALF_PERIOD {
        observer_half_period();
    } else {
        observer.moves = observer.moves + 1u;
        if taken.event == EVENT_STROBE {
            observer_strobe();
        }
    }
    observer_give_up();
}

fn observer_impact(stop: u32, velocity: f32, complete_chatter: bool) {
    observer.moves = observer.moves + 1u;
    recurrence_count(stop, complete_chatter);
    observer.impacts = observer.impacts + 1u;
    observer.impacts_total = observer.impacts_total + 1u;
    observer.peak = max(observer.peak, abs(velocity));
}

fn observer_half_period() {
    observer.moves = observer.moves + 1u;
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

fn observer_strobe() {
    let state = trajectory.point.state;
    observer.moves = observer.moves - min(observer.moves, FAIR_MOVES);
    observer.periods = observer.periods + 1u;
    if !state_is_finite(state) {
        observer.stage = STAGE_FAILED;
        return;
    }
    //: each normal
    if contact_is_clamped_along(trajectory.contact, $ku) {
        recurrence_count(flight.normals[$k].stop[0], true);
        recurrence_count(flight.normals[$k].stop[1], true);
    }
    //: end
    if observer.stage == STAGE_TRANSIENT {
        observer_settle(state);
    } else {
        observer_observe(state);
    }
}

fn observer_settle(state: State) {
    if schedule.fixed_periods == 0u {
        if trajectory.contact == CONTACT_FREE && is_quiet(trajectory.point) {
            observer.stage = STAGE_QUIET;
            return;
        }
        recurrence_at_strobe(state, SETTLED, false);
        if recurrence_holds_for(select(SETTLING, SETTLING_AT_REST, observer.recurrence.worst <= AT_REST)) {
            let needed = max(SETTLED_OBSERVATION, 4u * observer.recurrence.n);
            observer_begin_observation(min(needed, schedule.observe));
            return;
        }
    }
    if observer.periods >= schedule.transient {
        observer_begin_observation(schedule.observe);
    }
}

fn observer_begin_observation(observe: u32) {
    observer.stage = STAGE_OBSERVATION;
    observer.observe = observe;
    observer.observed = 0u;
    observer.impacts = 0u;
    observer.peak = 0.0;
    observer.stuck = 0u;
    observer.loss = loss_none(trajectory.contact);
    tangent = tangent_seed();
    if trajectory.contact != CONTACT_FREE {
        // While a mass rests, nothing can deviate that it does not carry.
        tangent = tangent_caught(tangent, trajectory.contact);
    }
    observer.recurrence = recurrence_anchored(trajectory.point.state);
    observer.exponent = exponent_over(observe);
    observer.spread = spread_about(trajectory.point);
    observer.grown = 0.0;
}

fn observer_observe(state: State) {
    observer.observed = observer.observed + 1u;
    let half = observer.observe / 2u;
    let growth = exponent_at_strobe();
    recurrence_at_strobe(state, RETURNED, observer.observed >= half);
    observer.grown = select(observer.grown + growth, 0.0, observer.recurrence.since == 0u);
    if observer.observed <= 2u * half {
        spread_at_strobe(trajectory.point, observer.observed > half);
    }
    if observer.observed < observer.observe {
        return;
    }
    if observer.observe < schedule.observe && !recurrence_holds_for(observer_proof()) {
        // It had not settled after all: go on as if nothing had been seen.
        observer.recurrence = recurrence_anchored(state);
        observer.stage = STAGE_TRANSIENT;
        if observer.periods >= schedule.transient {
            observer_begin_observation(schedule.observe);
        }
    } else {
        observer.stage = STAGE_OBSERVED;
    }
}

fn observer_proof() -> u32 {
    return min(observer.observe / 4u, SETTLING);
}

// Whether what returns is a motion that was reached: nearby trajectories do not leave it.
fn observer_is_settled() -> bool {
    return recurrence_is_settled() && observer.grown <= NEUTRAL_GROWTH;
}

// Whether the state began to return only within the observation.
fn observer_is_late() -> bool {
    return observer.recurrence.since < observer.observed;
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
    if returns && observer_is_settled() {
        return select(REGIME_PERIODIC, REGIME_PERIODIC_STICKING, observer.stuck == 1u);
    }
    if observer.stuck == 1u && !returns {
        return REGIME_APERIODIC_STICKING;
    }
    if observer.exponent.batches == 0u {
        return REGIME_UNRESOLVED;
    }
    let growth = observer.exponent.sum;
    let significant = exponent_per_period() > SIGNIFICANCE * exponent_standard_error();
    if growth > CHAOTIC_GROWTH && significant && observer.stuck == 0u {
        return REGIME_CHAOTIC;
    }
    if returns {
        return REGIME_UNRESOLVED;
    }
    if abs(growth) < NEUTRAL_GROWTH && spread_is_stationary(observer.observe / 2u) {
        return REGIME_QUASI_PERIODIC;
    }
    return REGIME_UNRESOLVED;
}

// The state that is reported: where the trajectory ends, or the forced response that motion decays onto.
fn observer_state(regime: u32) -> State {
    if regime == REGIME_NO_IMPACT && observer.stage == STAGE_QUIET && flight.quiet_decays == 1u {
        return flight.quiet_forced;
    }
    return trajectory.point.state;
}

fn observer_verdict() -> Verdict {
    let regime = observer_regime();
    let periodic = regime == REGIME_PERIODIC || regime == REGIME_PERIODIC_STICKING;
    var lyapunov = NOT_MEASURED;
    if regime == REGIME_NO_IMPACT {
        lyapunov = flight.linear_exponent;
    } else if regime != REGIME_FAILED && observer.exponent.batches > 0u {
        lyapunov = exponent_per_period();
        if periodic && observer_is_late() {
            lyapunov = observer.grown / f32(observer.recurrence.since);
        }
    }
    let may_return = regime != REGIME_NO_IMPACT && regime != REGIME_FAILED;
    let in_question = !periodic || observer_is_late();
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
    } else if observer.stage == STAGE_OBSERVED {
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
        observer.impacts,
        observer.impacts_total,
        observer.peak,
        observer.periods,
        select(0u, observer.recurrence.n, returning),
        select(0u, observer.observed, observer.stage == STAGE_OBSERVED),
        power,
        contact,
    );
}
