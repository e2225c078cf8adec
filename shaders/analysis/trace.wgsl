// What a trajectory leaves on a section while it is observed.

// How many passages of this cell were seen.
var<private> passages: u32;

// Sees what ended a move; `capacity` readings of each cell are kept.
fn trace_see(taken: Move, capacity: u32) {
    rebounds_see(taken);
    if probe_meets(taken) {
        if passages < capacity {
            readings[cell * capacity + passages] = probe_read(taken);
        }
        passages = passages + 1u;
    }
}
