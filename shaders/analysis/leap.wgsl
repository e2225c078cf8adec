// A leap to the motion that returns come closer to.

// Whether the map of a turn is to be measured in order to leap: the state returns, and still moves. That takes less than an
// observation, so that it is discarded where nothing has settled; a turn to leap after and one to prove it must be left of
// the transient.
fn observer_is_to_leap() -> bool {
    let moves = recurrence_holds_for(0u) && observer.recurrence.worst > AT_REST;
    let measures = observer.leaps > 1u && observer.turn.n == 0u && observer_has_short_turns();
    let needed = observer_turns_needed();
    let part = needed < schedule.observe;
    let has_time = observer.periods + needed + 2u * observer.recurrence.n <= schedule.transient;
    return moves && measures && part && has_time && trajectory.contact == CONTACT_FREE;
}

// At a strobe of the transient after the map of a turn was measured: one turn after the anchor it leaps to where that return
// leads, if the map says that it leads there.
fn observer_leap() {
    let since = observer.recurrence.since;
    if since > 0u && since < observer.turn.n {
        return;
    }
    let state = trajectory.point.state;
    let anchor = observer.recurrence.anchor;
    let missed = state_distance(state, anchor);
    let end = state_plus(anchor, 1.0, turn_followed_for_ever(state_plus(state, -1.0, anchor)));
    let returned = observer.recurrence.n > 0u && since == observer.turn.n && observer.turn.exponent < 0.0;
    let neared = missed > AT_REST && missed <= LEFT_BY_LEAP * observer.turn.missed;
    let near = state_distance(end, state) <= LONGEST_LEAP;
    let leads_there = state_is_finite(end) && near && state_is_between_stops(end);
    let has_time = observer.periods + observer.turn.n <= schedule.transient;
    let may_leap = observer.leaps > 0u && has_time && trajectory.contact == CONTACT_FREE;
    if returned && neared && leads_there && may_leap {
        observer.leaps = observer.leaps - 1u;
        observer.turn.missed = missed;
        trajectory.point.state = end;
        observer.recurrence = recurrence_anchored(end);
    } else {
        observer.turn = turn_over(0u);
    }
}

// Whether a state is off every stop.
fn state_is_between_stops(state: State) -> bool {
    var between = true;
    //: each normal
    {
        let place = along(flight.normals[$k].direction, state.x);
        between = between && place < stops.gap[$k][0] && -place < stops.gap[$k][1];
    }
    //: end
    return between;
}
