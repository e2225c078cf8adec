// Follows trajectories for whole forcing periods and measures how far they go, a bounded number of moves per dispatch.

@group(0) @binding(0) var<uniform> dispatch: ExtentDispatch;
@group(0) @binding(1) var<storage, read> flights: array<Flight>;
@group(0) @binding(2) var<storage, read> kicks: array<array<State, NORMAL_TERMS>>;
@group(0) @binding(3) var<storage, read> cells: array<Cell>;
// Which cells are not finished yet; FINISHED in the place of one that is, once this dispatch is over.
@group(0) @binding(4) var<storage, read_write> unfinished: array<u32>;
@group(0) @binding(5) var<storage, read_write> observers: array<ExtentObserver>;
@group(0) @binding(6) var<storage, read_write> extents: array<Extent>;
// Forcing periods for which each cell is followed.
@group(0) @binding(7) var<storage, read> periods: array<u32>;

@compute @workgroup_size(WORKGROUP)
fn measure_extents(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = id.y * dispatch.row + id.x;
    if id.x >= dispatch.row || index >= dispatch.count {
        return;
    }
    cell = unfinished[index];
    flight_load();
    if dispatch.begin == 1u {
        extent_begin(start_of_cell());
    } else {
        extent_resume(observers[cell]);
    }
    var taken = 0u;
    var code = EXTENT_FOLLOWED;
    while taken < dispatch.budget && code == EXTENT_FOLLOWED {
        code = extent_advance(periods[cell]);
        taken = taken + 1u;
    }
    // Some drivers end every loop after a number of iterations without an error; such a trajectory must not count as finished.
    if taken < dispatch.budget && code == EXTENT_FOLLOWED {
        code = EXTENT_FAILED;
    }
    observers[cell] = extent_saved();
    if code != EXTENT_FOLLOWED {
        extents[cell] = extent_written(code, periods[cell]);
        unfinished[index] = FINISHED;
    }
}
