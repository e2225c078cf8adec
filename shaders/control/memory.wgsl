// The last points on the section, and whether they repeat.

struct Memory {
    points: array<SectionPoint, DEPTH>,
    turns: array<f32, DEPTH>,
    // At each stop, in the plant's order.
    impacts: array<vec4<u32>, DEPTH>,
    seen: u32,
    returning: array<u32, LONGEST>,
    settled: array<u32, LONGEST>,
}

var<private> memory: Memory;
// The largest number of iterates in one period that is looked for.
var<private> reach: u32;

fn memory_push(point: SectionPoint, turns: f32, impacts: vec4<u32>) {
    for (var i = max(reach, LONGEST_DELAY); i > 0u; i--) {
        memory.points[i] = memory.points[i - 1u];
        memory.turns[i] = memory.turns[i - 1u];
        memory.impacts[i] = memory.impacts[i - 1u];
    }
    memory.points[0] = point;
    memory.turns[0] = turns;
    memory.impacts[0] = impacts;
    memory.seen = memory.seen + 1u;
    for (var m = 1u; m <= reach; m++) {
        var away = 1.0;
        if memory.seen > m {
            away = section_away(point, memory.points[m], stops.unit);
        }
        if away > RETURNED {
            memory.returning[m - 1u] = memory.seen;
        }
        if away > AT_REST {
            memory.settled[m - 1u] = memory.seen;
        }
    }
}

fn memory_start_over() {
    for (var m = 0u; m < LONGEST; m++) {
        memory.returning[m] = memory.seen;
        memory.settled[m] = memory.seen;
    }
}

fn memory_holds(since: u32, m: u32, proof: u32) -> bool {
    let kept = memory.seen - since;
    return kept >= proof && kept >= LEAST_RETURNS * m;
}

// The least period whose points have kept returning, 0 if none.
fn memory_period(proof: u32) -> u32 {
    var period = 0u;
    for (var m = reach; m > 0u; m--) {
        if memory_holds(memory.returning[m - 1u], m, proof) {
            period = m;
        }
    }
    return period;
}

fn memory_is_settled(proof: u32) -> bool {
    var settled = false;
    for (var m = 1u; m <= reach; m++) {
        settled = settled || memory_holds(memory.settled[m - 1u], m, proof);
    }
    return settled;
}

// The time of one period of `period` iterates in forcing periods, to the nearest whole number.
fn memory_periods(period: u32) -> u32 {
    var turns = 0.0;
    for (var i = 0u; i < period; i++) {
        turns = turns + memory.turns[i];
    }
    return u32(floor(turns + 0.5));
}

// The impacts at each stop in one period of `period` iterates.
fn memory_impacts(period: u32) -> vec4<u32> {
    var impacts = vec4(0u);
    for (var i = 0u; i < period; i++) {
        impacts = added(impacts, memory.impacts[i]);
    }
    return impacts;
}

// The point of one period that is the hardest impact.
fn memory_hardest(period: u32) -> SectionPoint {
    var hardest = memory.points[0];
    for (var i = 1u; i < period; i++) {
        let point = memory.points[i];
        if section_approach(section_state(point)) < section_approach(section_state(hardest)) {
            hardest = point;
        }
    }
    return hardest;
}

// The sums of impact counts, any of which may be infinite.
fn added(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> {
    let infinite = vec4(INFINITELY_MANY);
    return select(min(a + b, infinite - vec4(1u)), infinite, (a == infinite) | (b == infinite));
}
