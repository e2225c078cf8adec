// Follows trajectories, one per invocation, a bounded number of moves per dispatch.

@group(0) @binding(0) var<uniform> dispatch: Dispatch;
@group(0) @binding(1) var<storage, read> flights: array<Flight>;
@group(0) @binding(2) var<storage, read> kicks: array<array<State, NORMAL_TERMS>>;
@group(0) @binding(3) var<storage, read> cells: array<Cell>;
// Which cells are not finished yet; FINISHED in the place of one that is, once this dispatch is over.
@group(0) @binding(4) var<storage, read_write> unfinished: array<u32>;
@group(0) @binding(5) var<storage, read_write> observers: array<Observed>;
@group(0) @binding(6) var<storage, read_write> verdicts: array<Verdict>;

// Follows the trajectory in a stage of its schedule until something is rare, for a few turns.
fn follow_stage(stage: u32, carry: bool) {
    for (var turn = 0u; turn < TURNS; turn++) {
        if (observer.stage != stage) | pace.rare {
            break;
        }
        pace_begin();
        tally_begin(observer.peak, observer.loss.energy);
        pace_rounds(carry);
        observer_pass_impacts();
        if pace.arrived {
            if observer_is_at_rare_strobe(carry) {
                pace.rare = true;
            } else {
                observer_arrive(carry);
            }
        }
    }
}

// Rounds of free flight, and what is rare after them.
fn follow_turn() {
    pace.rare = false;
    follow_stage(STAGE_TRANSIENT, false);
    follow_stage(STAGE_OBSERVATION, true);
    // What rests on a stop goes on as far as nothing is rare about it.
    for (var step = 0u; step < HELD_STEPS; step++) {
        if (trajectory.contact == CONTACT_FREE) | pace.arrived {
            break;
        }
        if !rest_step(observer.stage == STAGE_OBSERVATION) {
            break;
        }
    }
    if pace.rare {
        var taken = Move(EVENT_STROBE, 0u, 0.0, 0.0, CONTACT_FREE, 0.0);
        if !pace.arrived {
            taken = advance_warily(observer.stage == STAGE_OBSERVATION);
        }
        observer_note(taken);
    }
    observer_give_up();
}

@compute @workgroup_size(WORKGROUP)
fn follow(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) place: u32) {
    let index = id.y * dispatch.row + id.x;
    if id.x >= dispatch.row || index >= dispatch.count {
        return;
    }
    lane = place;
    cell = unfinished[index];
    flight_load();
    schedule = dispatch.schedule;
    if dispatch.begin == 1u {
        observer_begin(start_of_cell());
    } else {
        observer_resume();
    }
    var taken = 0u;
    while taken < dispatch.budget && !stage_is_over(observer.stage) {
        follow_turn();
        taken = taken + 1u;
    }
    // Some drivers end every loop after a number of iterations without an error; such a trajectory must not count as finished.
    if taken < dispatch.budget && !stage_is_over(observer.stage) {
        observer.stage = STAGE_FAILED;
    }
    observer_save();
    if stage_is_over(observer.stage) {
        verdicts[cell] = observer_verdict();
        unfinished[index] = FINISHED;
    }
}
