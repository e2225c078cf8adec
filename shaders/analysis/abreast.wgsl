// Trajectories in free flight side by side: a few clear steps, then the contacts of those that wait for one; what is rare
// happens outside.

// Whether the trajectory waits for a contact within its step, whether it came to phase 0 or, under observation, to phase π,
// and whether something rare is to be done: its contact is to be approached from the safe side, or holds; or, where it came to
// phase 0, a turn is over of which something is to be made.
struct Pace {
    waits: bool,
    arrived: bool,
    halfway: bool,
    rare: bool,
}

var<private> pace: Pace;

// Begins rounds: only free flight takes part.
fn pace_begin() {
    let free = trajectory.contact == CONTACT_FREE;
    pace.waits = trajectory.under_way == 1u;
    pace.rare = !free | ((trajectory.kicks > MOST_KICKS) & pace.waits);
    pace.arrived = false;
    pace.halfway = false;
}

// A whole step of free flight, where it clears the stops.
fn pace_step(carry: bool) {
    trajectory_begin_step(carry);
    pace.waits = !leg_clears(along_each(trajectory.point), trajectory.ahead, flight.h);
    if !pace.waits {
        pace_complete(carry);
    }
}

// The rest of the step, where it clears the stops.
fn pace_rest(carry: bool) {
    let rest = flight.h - trajectory.offset;
    if leg_clears(trajectory.along, trajectory.ahead, rest) {
        pace.waits = false;
        pace_complete(carry);
    }
}

// The end of a step.
fn pace_complete(carry: bool) {
    trajectory.point = trajectory.ahead;
    let event = end_step();
    pace.arrived = event == EVENT_STROBE;
    pace.halfway = carry & (event == EVENT_HALF_PERIOD);
}

// The contact that the trajectory waits for, and the rest of the step after it.
fn pace_cross(carry: bool) {
    let window = flight.h - trajectory.offset;
    let met = crossing_of(trajectory_along(), trajectory.ahead, window);
    pace.rare = !(met.certain | met.passes) | (trajectory.kicks >= MOST_KICKS);
    if pace.rare {
        return;
    }
    if met.passes {
        pace.waits = false;
        pace_complete(carry);
    } else {
        trajectory_cross(met, carry);
        tally_count(met.end, met.velocity, met.rebound, carry);
        pace_rest(carry);
    }
}

// Rounds until phase 0, until something rare, or until they are enough.
fn pace_rounds(carry: bool) {
    for (var round = 0u; round < ROUNDS; round++) {
        for (var step = 0u; step < CLEAR_STEPS; step++) {
            if pace.waits | pace.arrived | pace.halfway | pace.rare {
                break;
            }
            pace_step(carry);
        }
        if pace.waits & !pace.rare {
            pace_cross(carry);
        }
        if pace.halfway {
            recurrence_at_half_period(trajectory.point.state, RETURNED);
            pace.halfway = false;
        }
        if pace.arrived | pace.rare {
            break;
        }
    }
}

// Notes the impacts that were counted.
fn observer_pass_impacts() {
    //: each normal
    observer_pass_impacts_at(flight.normals[$k].stop[0], tally.impacts[$k].x);
    observer_pass_impacts_at(flight.normals[$k].stop[1], tally.impacts[$k].y);
    //: end
    observer.peak = tally.fastest;
    observer.loss.energy = tally.energy;
}

fn observer_pass_impacts_at(stop: u32, impacts: u32) {
    if impacts > 0u {
        observer.moves = observer.moves + impacts;
        recurrence_count_finite(stop, impacts);
        observer.impacts = saturating(observer.impacts, impacts);
        observer.impacts_total = saturating(observer.impacts_total, impacts);
    }
}
