// Periodicity: whether the strobe state returns, and keeps returning.

struct Recurrence {
    anchor: State,
    since: u32,
    kept: u32,
    n: u32,
    // Impacts at each stop in the first cycle after the anchor, and in the present one.
    impacts: array<u32, STOPS>,
    running: array<u32, STOPS>,
    worst: f32,
    early: f32,
    // Whether the last return went hardly farther than those before.
    quickly: u32,
    moved: u32,
    apart: f32,
    // Within this a first return must be.
    trusted: f32,
    symmetric: u32,
}

fn recurrence_anchored(state: State) -> Recurrence {
    let none = array<u32, STOPS>();
    return Recurrence(state, 0u, 0u, 0u, none, none, 0.0, 0.0, 0u, 0u, FARTHEST, FARTHEST, 0u);
}

// Counts an impact; infinitely many if it ends a complete chatter sequence.
fn recurrence_count(stop: u32, complete_chatter: bool) {
    if !complete_chatter {
        recurrence_count_finite(stop, 1u);
        return;
    }
    //: each stop
    observer.recurrence.running[$k] = select(observer.recurrence.running[$k], INFINITELY_MANY, stop == $ku);
    //: end
}

// Counts impacts none of which ends a complete chatter sequence.
fn recurrence_count_finite(stop: u32, impacts: u32) {
    let most = INFINITELY_MANY - 1u;
    //: each stop
    {
        let running = observer.recurrence.running[$k];
        let counted = running + select(0u, impacts, stop == $ku);
        observer.recurrence.running[$k] = select(running, min(counted, most), running < most);
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

fn recurrence_at_strobe(state: State, tolerance: f32, max_period: u32, late: bool) {
    observer.recurrence.since = observer.recurrence.since + 1u;
    let away = anchor_distance(state);
    if observer.recurrence.n == 0u {
        if away <= tolerance && away <= observer.recurrence.trusted {
            observer.recurrence.n = observer.recurrence.since;
            observer.recurrence.impacts = observer.recurrence.running;
            recurrence_returned(away);
        } else if observer.recurrence.since >= max_period {
            recurrence_start_over(state, late, FARTHEST);
        }
        return;
    }
    let turned = observer.recurrence.since % observer.recurrence.n;
    if turned == 0u {
        var same = true;
        //: each stop
        same = same && observer.recurrence.running[$k] == observer.recurrence.impacts[$k];
        //: end
        if same && away <= tolerance {
            recurrence_returned(away);
            if late && observer.recurrence.moved == 0u {
                recurrence_move_along(state);
            }
        } else {
            recurrence_start_over(state, late, NEARER * recurrence_farthest());
        }
    } else if observer.recurrence.n % turned == 0u {
        observer.recurrence.apart = min(observer.recurrence.apart, away);
    }
}

// In the transient: the motion is compared with its present self after so many periods of returns, or a few where it comes
// closer quickly.
fn recurrence_follow_along(state: State, periods: u32) {
    let due = recurrence_holds_for(periods) || recurrence_holds_for(0u) && observer.recurrence.quickly == 1u;
    let moves = observer.recurrence.worst > AT_REST;
    if due && moves && observer.recurrence.since % observer.recurrence.n == 0u {
        let nearer = observer.recurrence.early == 0.0 || observer.recurrence.worst <= observer.recurrence.early;
        observer.recurrence.kept = select(0u, observer.recurrence.kept + observer.recurrence.since, nearer);
        observer.recurrence.since = 0u;
        recurrence_move_along(state);
    }
}

// Whether the state has kept returning for so long, whatever it was compared with.
fn recurrence_kept_for(periods: u32) -> bool {
    return recurrence_holds_for(0u) && observer.recurrence.kept + observer.recurrence.since >= periods;
}

fn recurrence_start_over(state: State, late: bool, trusted: f32) {
    observer.recurrence = recurrence_anchored(state);
    observer.recurrence.moved = select(0u, 1u, late);
    observer.recurrence.trusted = trusted;
}

// The largest distance of a return from its anchor, before that moved along with the motion or since.
fn recurrence_farthest() -> f32 {
    return max(observer.recurrence.early, observer.recurrence.worst);
}

// The motion is compared with its present self from now on.
fn recurrence_move_along(state: State) {
    observer.recurrence.anchor = state;
    observer.recurrence.moved = 1u;
    observer.recurrence.early = observer.recurrence.worst;
    observer.recurrence.worst = 0.0;
}

fn recurrence_returned(away: f32) {
    observer.recurrence.running = array<u32, STOPS>();
    let worst = max(observer.recurrence.worst, away);
    observer.recurrence.quickly = select(0u, 1u, worst - observer.recurrence.worst <= QUICKLY * worst);
    observer.recurrence.worst = worst;
}

fn recurrence_holds_for(periods: u32) -> bool {
    let n = observer.recurrence.n;
    return n > 0u && observer.recurrence.since >= periods && observer.recurrence.since >= LEAST_RETURNS * n;
}

// Whether N is the period of a motion that was reached.
fn recurrence_is_settled() -> bool {
    let worst = observer.recurrence.worst;
    let comes_closer = worst <= SETTLED && worst + worst <= observer.recurrence.early;
    return (worst <= ROUNDING || comes_closer) && observer.recurrence.apart >= DISTINCT * recurrence_farthest();
}

fn anchor_distance(state: State) -> f32 {
    return state_distance(state, observer.recurrence.anchor);
}

// The largest difference of a state's components from another's: in units of what is of order one, relative above.
fn state_distance(state: State, anchor: State) -> f32 {
    let distance = max(largest(state.x - anchor.x), largest(state.v - anchor.v));
    let size = max(max(largest(anchor.x), largest(anchor.v)), stops.unit);
    return distance / size;
}
