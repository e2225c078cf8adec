// How far a motion goes: the integral of the square and the peak of every coordinate.

struct ExtentObserver {
    trajectory: Trajectory,
    // Over the forcing periods that are over, and over the present one.
    squares: X,
    turn: X,
    peak: X,
    periods: u32,
    moves: u32,
}

var<private> extent: ExtentObserver;

// Begins at forcing phase 0. While an observer works, `trajectory` holds what it will store.
fn extent_begin(start: State) {
    trajectory = trajectory_new(start);
    extent.squares = X(0.0);
    extent.turn = X(0.0);
    extent.peak = X(0.0);
    extent.periods = 0u;
    extent.moves = 0u;
}

fn extent_resume(saved: ExtentObserver) {
    extent = saved;
    trajectory = saved.trajectory;
}

fn extent_saved() -> ExtentObserver {
    var saved = extent;
    saved.trajectory = trajectory;
    return saved;
}

// One move further; whether so many forcing periods are over, or it has to be given up.
fn extent_advance(periods: u32) -> u32 {
    let before = trajectory.point;
    let offset = trajectory.offset;
    let held_before = trajectory.contact;
    let event = advance(false).event;
    let until = select(trajectory.offset, flight.h, event_ends_step(event));
    let contact = select(held_before, trajectory.contact, event == EVENT_RELEASED);
    extent_note(before, until - offset, contact);
    extent.moves = extent.moves + 1u;
    if event == EVENT_STROBE {
        extent.squares = extent.squares + extent.turn;
        extent.turn = X(0.0);
        extent.moves = 0u;
        extent.periods = extent.periods + 1u;
        if !state_is_bounded(trajectory.point.state) {
            return EXTENT_FAILED;
        }
        return select(EXTENT_FOLLOWED, EXTENT_DONE, extent.periods == periods);
    }
    return select(EXTENT_FOLLOWED, EXTENT_FAILED, extent.moves > MOST_MOVES);
}

// Notes a piece of flight from a point on.
fn extent_note(before: Point, time: f32, contact: u32) {
    let quarter = 0.25 * time;
    var start = before.state;
    for (var half = 0.0; half <= 2.0; half += 2.0) {
        let middle = point_flown(before, (half + 1.0) * quarter, contact).state;
        let end = point_flown(before, (half + 2.0) * quarter, contact).state;
        extent_note_half(start, middle, end, quarter);
        start = end;
    }
}

// Notes half a piece of flight, from its states at both ends and in the middle, a quarter of the piece from either.
fn extent_note_half(a: State, m: State, b: State, quarter: f32) {
    let values = 7.0 * (a.x * a.x + b.x * b.x) + 16.0 * (m.x * m.x);
    let slopes = 2.0 * quarter * (a.x * a.v - b.x * b.v);
    extent.turn = extent.turn + (quarter / 15.0) * (values + slopes);
    let peak = max(max(max(extent.peak, abs(a.x)), abs(m.x)), abs(b.x));
    extent.peak = extent_turned(extent_turned(peak, quarter, a, m), quarter, m, b);
}

// The larger of a peak and of the modulus at a turning point of the cubic over a time, between two states.
fn extent_turned(peak: X, time: f32, a: State, b: State) -> X {
    let share = a.v / (a.v - b.v);
    let rest = 1.0 - share;
    let value = a.x * rest * rest * (1.0 + 2.0 * share)
        + b.x * share * share * (3.0 - 2.0 * share)
        + time * share * rest * (a.v * rest - b.v * share);
    return max(peak, select(peak, abs(value), a.v * b.v < X(0.0)));
}

// What is written of a trajectory that was followed for so many forcing periods.
fn extent_written(code: u32, periods: u32) -> Extent {
    let time = f32(periods) * (f32(flight.steps) * flight.h);
    let means = extent.squares / time;
    var written = Extent(code, array<f32, MOST>(), array<f32, MOST>());
    //: each coordinate
    written.mean_squares[$i] = means$c;
    written.peaks[$i] = extent.peak$c;
    //: end
    return written;
}
