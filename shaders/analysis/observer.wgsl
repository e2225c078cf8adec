// One trajectory followed to its verdict: transient, settling, observation.
//
// Where one of several places of an observer is meant, all are written, each with its old value or the new one: of places that
// branches choose between, a compiler keeps all addresses in registers.

struct Observer {
    recurrence: Recurrence,
    exponent: Exponent,
    turn: Turn,
    leaps: u32,
    spread: Spread,
    grown: f32,
    lost: u32,
    lately_lost: u32,
    stage: u32,
    periods: u32,
    observed: u32,
    observe: u32,
    moves: u32,
    impacts: u32,
    impacts_total: u32,
    peak: f32,
    stuck: u32,
    loss: Loss,
}

// A trajectory and its observer, as they are stored.
struct Observed {
    trajectory: Trajectory,
    tangent: State,
    observer: Observer,
}

var<private> schedule: Schedule;
// Which invocation of its workgroup follows the trajectory.
var<private> lane: u32;

// Begins at forcing phase 0. While an observer works, `trajectory` and `tangent` hold what it will store.
fn observer_begin(start: State) {
    trajectory = trajectory_new(start);
    tangent = tangent_seed();
    observer.recurrence = recurrence_anchored(trajectory.point.state);
    observer.exponent = exponent_over(schedule.observe);
    observer.turn = turn_over(0u);
    observer.leaps = MOST_LEAPS;
    observer.spread = spread_about(trajectory.point);
    observer.grown = 0.0;
    observer.lost = 0u;
    observer.lately_lost = 0u;
    observer.stage = STAGE_TRANSIENT;
    observer.periods = 0u;
    observer.observed = 0u;
    observer.observe = schedule.observe;
    observer.moves = 0u;
    observer.impacts = 0u;
    observer.impacts_total = 0u;
    observer.peak = 0.0;
    observer.stuck = 0u;
    observer.loss = loss_none(CONTACT_FREE);
    if schedule.transient == 0u {
        observer_begin_observation(Observation(schedule.observe, 0u));
    }
}
