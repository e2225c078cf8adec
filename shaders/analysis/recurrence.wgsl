// Periodicity: does the strobe state come back, and keep coming back?

struct Recurrence {
    anchor: array<f32, 4>,
    since: u32,
    n: u32,
    p: u32,
    q: u32,
    running_p: u32,
    running_q: u32,
    worst: f32,
    early: f32,
    moved: u32,
    apart: f32,
    symmetric: u32,
}

fn recurrence_anchored(state: vec4<f32>) -> Recurrence {
    let anchor = array<f32, 4>(state.x, state.y, state.z, state.w);
    return Recurrence(anchor, 0u, 0u, 0u, 0u, 0u, 0u, 0.0, 0.0, 0u, FARTHEST, 0u);
}

fn counted(running: u32, complete_chatter: bool) -> u32 {
    if complete_chatter {
        return INFINITELY_MANY;
    }
    return select(running, running + 1u, running < INFINITELY_MANY - 1u);
}

fn recurrence_count(side: f32, complete_chatter: bool) {
    if side > 0.0 {
        observer.recurrence.running_q = counted(observer.recurrence.running_q, complete_chatter);
    } else {
        observer.recurrence.running_p = counted(observer.recurrence.running_p, complete_chatter);
    }
}

fn recurrence_at_half_period(state: vec4<f32>, tolerance: f32) {
    let n = observer.recurrence.n;
    if n % 2u == 1u {
        if observer.recurrence.since % n == n / 2u {
            observer.recurrence.symmetric = select(0u, 1u, anchor_distance(-state) <= tolerance);
        }
    }
}

fn recurrence_at_strobe(state: vec4<f32>, tolerance: f32, late: bool) {
    observer.recurrence.since = observer.recurrence.since + 1u;
    let away = anchor_distance(state);
    if observer.recurrence.n == 0u {
        if away <= tolerance {
            observer.recurrence.n = observer.recurrence.since;
            observer.recurrence.p = observer.recurrence.running_p;
            observer.recurrence.q = observer.recurrence.running_q;
            recurrence_returned(away);
        } else if observer.recurrence.since >= schedule.max_period {
            recurrence_start_over(state, late);
        }
        return;
    }
    let turned = observer.recurrence.since % observer.recurrence.n;
    if turned == 0u {
        let same = observer.recurrence.running_p == observer.recurrence.p
            && observer.recurrence.running_q == observer.recurrence.q;
        if same && away <= tolerance {
            recurrence_returned(away);
            if late && observer.recurrence.moved == 0u {
                recurrence_move_along(state);
            }
        } else {
            recurrence_start_over(state, late);
        }
    } else if observer.recurrence.n % turned == 0u {
        observer.recurrence.apart = min(observer.recurrence.apart, away);
    }
}

fn recurrence_start_over(state: vec4<f32>, late: bool) {
    observer.recurrence = recurrence_anchored(state);
    observer.recurrence.moved = select(0u, 1u, late);
}

// The motion is compared with its present self from now on.
fn recurrence_move_along(state: vec4<f32>) {
    observer.recurrence.anchor = array<f32, 4>(state.x, state.y, state.z, state.w);
    observer.recurrence.moved = 1u;
    observer.recurrence.early = observer.recurrence.worst;
    observer.recurrence.worst = 0.0;
}

fn recurrence_returned(away: f32) {
    observer.recurrence.running_p = 0u;
    observer.recurrence.running_q = 0u;
    observer.recurrence.worst = max(observer.recurrence.worst, away);
}

fn recurrence_holds_for(periods: u32) -> bool {
    let n = observer.recurrence.n;
    return n > 0u && observer.recurrence.since >= periods && observer.recurrence.since >= 3u * n;
}

// Whether N is the period of a motion that was reached.
fn recurrence_is_settled() -> bool {
    let worst = observer.recurrence.worst;
    let early = observer.recurrence.early;
    let comes_closer = worst <= SETTLED && worst + worst <= early;
    return (worst <= ROUNDING || comes_closer) && observer.recurrence.apart >= DISTINCT * max(early, worst);
}

// The largest difference of a state's components from the anchor's.
fn anchor_distance(state: vec4<f32>) -> f32 {
    let a = observer.recurrence.anchor;
    let anchor = vec4(a[0], a[1], a[2], a[3]);
    let difference = abs(state - anchor);
    let extent = abs(anchor);
    let distance = max(max(difference.x, difference.y), max(difference.z, difference.w));
    let size = max(max(max(extent.x, extent.y), max(extent.z, extent.w)), 1.0);
    return distance / size;
}
