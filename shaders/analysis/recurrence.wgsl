// Periodicity: does the strobe state come back, and keep coming back?

struct Recurrence {
    anchor: State,
    since: u32,
    n: u32,
    // Impacts at each stop in the first cycle after the anchor, and in the present one.
    impacts: array<u32, STOPS>,
    running: array<u32, STOPS>,
    worst: f32,
    symmetric: u32,
}

fn recurrence_anchored(state: State) -> Recurrence {
    return Recurrence(state, 0u, 0u, array<u32, STOPS>(), array<u32, STOPS>(), 0.0, 0u);
}

fn counted(running: u32, complete_chatter: bool) -> u32 {
    if complete_chatter {
        return INFINITELY_MANY;
    }
    return select(running, running + 1u, running < INFINITELY_MANY - 1u);
}

fn recurrence_count(stop: u32, complete_chatter: bool) {
    //: each stop
    if stop == $ku {
        observer.recurrence.running[$k] = counted(observer.recurrence.running[$k], complete_chatter);
    }
    //: end
}

fn recurrence_at_half_period(state: State, tolerance: f32) {
    let n = observer.recurrence.n;
    if flight.mirror_exists == 1u && n % 2u == 1u {
        if observer.recurrence.since % n == n / 2u {
            let mirrored = State(applied(flight.mirror, state.x), applied(flight.mirror, state.v));
            observer.recurrence.symmetric = select(0u, 1u, anchor_distance(mirrored) <= tolerance);
        }
    }
}

fn recurrence_at_strobe(state: State, tolerance: f32) {
    observer.recurrence.since = observer.recurrence.since + 1u;
    let away = anchor_distance(state);
    if observer.recurrence.n == 0u {
        if away <= tolerance {
            observer.recurrence.n = observer.recurrence.since;
            observer.recurrence.impacts = observer.recurrence.running;
            recurrence_returned(away);
        } else if observer.recurrence.since >= schedule.max_period {
            observer.recurrence = recurrence_anchored(state);
        }
        return;
    }
    if observer.recurrence.since % observer.recurrence.n == 0u {
        var same = true;
        //: each stop
        same = same && observer.recurrence.running[$k] == observer.recurrence.impacts[$k];
        //: end
        if same && away <= tolerance {
            recurrence_returned(away);
        } else {
            observer.recurrence = recurrence_anchored(state);
        }
    }
}

fn recurrence_returned(away: f32) {
    observer.recurrence.running = array<u32, STOPS>();
    observer.recurrence.worst = max(observer.recurrence.worst, away);
}

fn recurrence_holds_for(periods: u32) -> bool {
    let n = observer.recurrence.n;
    return n > 0u && observer.recurrence.since >= periods && observer.recurrence.since >= 3u * n;
}

// The largest difference of a state's components from the anchor's.
fn anchor_distance(state: State) -> f32 {
    let anchor = observer.recurrence.anchor;
    let distance = max(largest(state.x - anchor.x), largest(state.v - anchor.v));
    let size = max(max(largest(anchor.x), largest(anchor.v)), 1.0);
    return distance / size;
}
