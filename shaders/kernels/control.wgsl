// Follows trajectories under control, one per invocation, a bounded number of moves per dispatch.

@group(0) @binding(0) var<uniform> dispatch: ControlDispatch;
@group(0) @binding(1) var<storage, read> flights: array<Flight>;
@group(0) @binding(2) var<storage, read> kicks: array<array<State, NORMAL_TERMS>>;
@group(0) @binding(3) var<storage, read> cells: array<Cell>;
// Which cells are not finished yet; FINISHED in the place of one that is, once this dispatch is over.
@group(0) @binding(4) var<storage, read_write> unfinished: array<u32>;
@group(0) @binding(5) var<storage, read_write> states: array<Controlled>;
@group(0) @binding(6) var<storage, read_write> outcomes: array<Outcome>;
@group(0) @binding(7) var<storage, read> controls: array<Control>;

@compute @workgroup_size(WORKGROUP)
fn control_trajectories(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = id.y * dispatch.row + id.x;
    if id.x >= dispatch.row || index >= dispatch.count {
        return;
    }
    cell = unfinished[index];
    flight_load();
    control = controls[cell];
    control_schedule = dispatch.schedule;
    reach = dispatch.max_period;
    if dispatch.begin == 1u {
        controlled_force(0.0);
        controlled_begin(start_of_cell());
    } else {
        controlled = states[cell];
        trajectory = controlled.trajectory;
        tangent = controlled.tangent;
        adapted = controlled.adapted;
        memory = controlled.memory;
        deviations = controlled.deviations;
        observer.exponent = controlled.exponent;
        observer.spread = controlled.spread;
        controlled_force(controlled.force);
    }
    var taken = 0u;
    while taken < dispatch.budget && !progress_is_over(controlled.progress) {
        controlled_note(advance(controlled.progress == PROGRESS_OBSERVED));
        taken = taken + 1u;
    }
    // Some drivers end every loop after a number of iterations without an error; such a trajectory must not count as finished.
    if taken < dispatch.budget && !progress_is_over(controlled.progress) {
        controlled.progress = PROGRESS_FAILED;
    }
    controlled.trajectory = trajectory;
    controlled.tangent = tangent;
    controlled.adapted = adapted;
    controlled.memory = memory;
    controlled.deviations = deviations;
    controlled.exponent = observer.exponent;
    controlled.spread = observer.spread;
    states[cell] = controlled;
    if progress_is_over(controlled.progress) {
        outcomes[cell] = controlled_outcome();
        unfinished[index] = FINISHED;
    }
}
