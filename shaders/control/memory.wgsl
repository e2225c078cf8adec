// The last points on the section, and whether they repeat.

struct Memory {
    points: array<array<f32, 4>, DEPTH>,
    turns: array<f32, DEPTH>,
    at_b: array<u32, DEPTH>,
    at_a: array<u32, DEPTH>,
    seen: u32,
    returning: array<u32, LONGEST>,
    settled: array<u32, LONGEST>,
}

var<private> memory: Memory;
// The largest number of iterates in one period that is looked for.
var<private> reach: u32;

fn memory_point(i: u32) -> vec4<f32> {
    let p = memory.points[i];
    return vec4(p[0], p[1], p[2], p[3]);
}

fn memory_push(point: vec4<f32>, turns: f32, at_b: u32, at_a: u32) {
    for (var i = max(reach, LONGEST_DELAY); i > 0u; i--) {
        memory.points[i] = memory.points[i - 1u];
        memory.turns[i] = memory.turns[i - 1u];
        memory.at_b[i] = memory.at_b[i - 1u];
        memory.at_a[i] = memory.at_a[i - 1u];
    }
    memory.points[0] = array<f32, 4>(point.x, point.y, point.z, point.w);
    memory.turns[0] = turns;
    memory.at_b[0] = at_b;
    memory.at_a[0] = at_a;
    memory.seen = memory.seen + 1u;
    for (var m = 1u; m <= reach; m++) {
        var away = 1.0;
        if memory.seen > m {
            away = section_distance(point, memory_point(m));
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
    return kept >= proof && kept >= 3u * m;
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

// N, p and q of one period of `period` iterates.
fn memory_counts(period: u32) -> vec3<u32> {
    var turns = 0.0;
    var p = 0u;
    var q = 0u;
    for (var i = 0u; i < period; i++) {
        turns = turns + memory.turns[i];
        p = added(p, memory.at_b[i]);
        q = added(q, memory.at_a[i]);
    }
    return vec3(u32(floor(turns + 0.5)), p, q);
}

fn memory_hardest(period: u32) -> vec4<f32> {
    var hardest = memory_point(0u);
    for (var i = 1u; i < period; i++) {
        let point = memory_point(i);
        if point.x < hardest.x {
            hardest = point;
        }
    }
    return hardest;
}

// The sum of two impact counts, either of which may be infinite.
fn added(a: u32, b: u32) -> u32 {
    if a == INFINITELY_MANY || b == INFINITELY_MANY {
        return INFINITELY_MANY;
    }
    return min(a + b, INFINITELY_MANY - 1u);
}
