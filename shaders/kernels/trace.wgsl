// Follows trajectories like the kernel `follow`, and reads a section while they are observed.

@group(0) @binding(0) var<uniform> dispatch: TraceDispatch;
@group(0) @binding(1) var<storage, read> flights: array<Flight>;
@group(0) @binding(2) var<storage, read> kicks: array<array<State, NORMAL_TERMS>>;
@group(0) @binding(3) var<storage, read> cells: array<Cell>;
// Which cells are not finished yet; FINISHED in the place of one that is, once this dispatch is over.
@group(0) @binding(4) var<storage, read_write> unfinished: array<u32>;
@group(0) @binding(5) var<storage, read_write> observers: array<Observed>;
@group(0) @binding(6) var<storage, read_write> verdicts: array<Verdict>;
@group(0) @binding(7) var<storage, read_write> traces: array<Trace>;
@group(0) @binding(8) var<storage, read_write> readings: array<f32>;

@compute @workgroup_size(WORKGROUP)
fn trace(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) place: u32) {
    let index = id.y * dispatch.row + id.x;
    if id.x >= dispatch.row || index >= dispatch.count {
        return;
    }
    lane = place;
    cell = unfinished[index];
    flight_load();
    schedule = dispatch.schedule;
    probe = Probe(dispatch.section, dispatch.reading);
    if dispatch.begin == 1u {
        observer_begin(start_of_cell());
        rebounds = Rebounds(0.0, 0u, 0u, 0u);
        passages = 0u;
    } else {
        observer_resume();
        rebounds = traces[cell].rebounds;
        passages = traces[cell].passages;
    }
    var taken = 0u;
    while taken < dispatch.budget && !stage_is_over(observer.stage) {
        let observed = observer.stage == STAGE_OBSERVATION;
        let ended = advance(observed);
        if observed {
            trace_see(ended, dispatch.capacity);
        }
        observer_note(ended);
        taken = taken + 1u;
    }
    // Some drivers end every loop after a number of iterations without an error; such a trajectory must not count as finished.
    if taken < dispatch.budget && !stage_is_over(observer.stage) {
        observer.stage = STAGE_FAILED;
    }
    observer_save();
    traces[cell] = Trace(rebounds, passages);
    if stage_is_over(observer.stage) {
        verdicts[cell] = observer_verdict();
        unfinished[index] = FINISHED;
    }
}
