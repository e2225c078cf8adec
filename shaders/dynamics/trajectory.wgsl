// One trajectory: steps of flight, impacts, chatter, sticking.

struct Trajectory {
    point: Point,
    ahead: Point,
    kicks: u32,
    contact: u32,
    step: u32,
    offset: f32,
    // 1 while a step of free flight is under way: `ahead` is its end then, and a tangent that is carried along is that of its end.
    under_way: u32,
    // One more than the number of the normal that was met directly just now, and where it is along each: the point follows from
    // them then. Otherwise 0.
    met: u32,
    along: Alongs,
}

// A move: what ended it, and with an impact, at which stop, and d·v before and after it.
struct Move {
    event: u32,
    stop: u32,
    velocity: f32,
    rebound: f32,
    // The stops beside this one that share the rebounds of a complete chatter sequence, as contacts; seldom any.
    beside: u32,
    // For how long masses are off the stop: in rebounds that are closed, or since it opened.
    apart: f32,
}

// Whether a move ended with an impact; a mass that comes to rest on a stop without one is caught at velocity 0.
fn is_impact(taken: Move) -> bool {
    return event_is_impact(taken.event) && taken.velocity != 0.0;
}

var<private> trajectory: Trajectory;
var<private> tangent: State;

fn trajectory_new(start: State) -> Trajectory {
    var point = point_at_phase_zero(start);
    var contact = CONTACT_FREE;
    //: each normal
    if stops.gap[$k][0] + stops.gap[$k][1] == 0.0 {
        contact = contact_with(contact_with(contact, End($ku, 0u)), End($ku, 1u));
    }
    //: end
    point.state = rested(point.state, contact);
    return trajectory_at(point, point, contact, 0u, 0.0, 0u);
}

// A trajectory that goes on from a point at a time `offset` after the beginning of a step.
fn trajectory_from_point(point: Point, contact: u32, step: u32, offset: f32) -> Trajectory {
    if contact == CONTACT_FREE && offset > 0.0 {
        let ahead = point_flown(point, flight.h - offset, contact);
        return trajectory_at(point, ahead, contact, step, offset, 1u);
    }
    return trajectory_at(point, point, contact, step, offset, 0u);
}

fn trajectory_at(point: Point, ahead: Point, contact: u32, step: u32, offset: f32, under_way: u32) -> Trajectory {
    return Trajectory(point, ahead, 0u, contact, step, offset, under_way, 0u, Alongs());
}

// Where it is along each normal.
fn trajectory_along() -> Alongs {
    if trajectory.met > 0u {
        return trajectory.along;
    }
    return along_each(trajectory.point);
}

// The present point: just after a contact that was met directly, where the end of the step was so long before, and exactly on the
// stop.
fn trajectory_present() -> Point {
    if trajectory.met == 0u {
        return trajectory.point;
    }
    let normal = trajectory.met - 1u;
    let before = point_flown(trajectory.ahead, trajectory.offset - flight.h, CONTACT_FREE);
    return Point(placed(normal, before.state, along_at(trajectory.along, normal)), before.sin, before.cos);
}

// Within a step: finds its end where flight is free, and what the tangent of the present point is there.
fn trajectory_look_ahead(carry: bool) {
    if trajectory.contact == CONTACT_FREE {
        trajectory.ahead = point_flown(trajectory.point, flight.h - trajectory.offset, CONTACT_FREE);
        trajectory.kicks = 0u;
        trajectory.under_way = 1u;
        if carry {
            tangent = tangent_carried(tangent);
        }
    }
}

// A tangent of the present point, as it is carried along from here.
fn tangent_carried(present: State) -> State {
    if trajectory.under_way == 1u {
        return tangent_flown(present, flight.h - trajectory.offset, CONTACT_FREE);
    }
    return present;
}

// What a tangent that is carried along is at the present point.
fn tangent_present(carried: State) -> State {
    if trajectory.under_way == 1u {
        return tangent_flown(carried, trajectory.offset - flight.h, CONTACT_FREE);
    }
    return carried;
}

// Moves on to the next event, the end of the step at the latest; `carry` says whether the tangent comes along.
fn advance(carry: bool) -> Move {
    if trajectory.contact == CONTACT_FREE {
        return fly(carry);
    }
    return rest(carry);
}

fn fly(carry: bool) -> Move {
    let window = flight.h - trajectory.offset;
    let before = trajectory_along();
    if trajectory.under_way == 0u {
        trajectory_begin_step(carry);
    }
    if trajectory.kicks <= MOST_KICKS {
        if leg_clears(before, trajectory.ahead, window) {
            return go_ahead(window);
        }
        if trajectory.kicks < MOST_KICKS {
            let met = crossing_of(before, trajectory.ahead, window);
            if met.certain {
                trajectory_cross(met, carry);
                trajectory.point = trajectory_present();
                let stop = flight.normals[met.end.normal].stop[met.end.side];
                return Move(EVENT_IMPACT, stop, met.velocity, met.rebound, CONTACT_FREE, 0.0);
            }
            if met.passes {
                return go_ahead(window);
            }
        }
    }
    return approach(carry);
}

// Begins a step of free flight.
fn trajectory_begin_step(carry: bool) {
    trajectory.ahead = point_stepped(trajectory.point);
    trajectory.kicks = 0u;
    trajectory.under_way = 1u;
    if carry {
        tangent = tangent_stepped(tangent);
    }
}

// Up to and through a contact that is certain.
fn trajectory_cross(met: Crossing, carry: bool) {
    let later = wake(met.end.normal, met.rest);
    if carry {
        let back = look_back(met.end.normal, met.rest);
        tangent = tangent_struck_ahead(tangent, back, met.velocity, met.kick, met.pull, later);
    }
    trajectory.met = met.end.normal + 1u;
    trajectory.along = met.after;
    trajectory.ahead = point_kicked(trajectory.ahead, met.kick, later);
    trajectory.kicks = trajectory.kicks + 1u;
    trajectory.offset = trajectory.offset + met.time;
}

// Free flight towards a stop, as far as is safe.
fn approach(carry: bool) -> Move {
    let window = flight.h - trajectory.offset;
    trajectory.point = trajectory_present();
    trajectory.met = 0u;
    let motion = point_motion(trajectory.point, CONTACT_FREE);
    let time = clear_time(trajectory.point, motion, CONTACT_FREE, CONTACT_FREE, window);
    if time >= window {
        return go_ahead(window);
    }
    glide(carry, time);
    // A contact beyond the end of the step belongs to the next one.
    let reached = imminent(trajectory.point, CONTACT_FREE);
    if trajectory.offset + reached.left > flight.h {
        return Move(EVENT_FLIGHT, 0u, 0.0, 0.0, CONTACT_FREE, 0.0);
    }
    return strike(carry, reached);
}

// The rare cases: an approach from the safe side, or sticking.
fn advance_warily(carry: bool) -> Move {
    if trajectory.contact == CONTACT_FREE {
        let window = flight.h - trajectory.offset;
        if trajectory.kicks <= MOST_KICKS && leg_clears(trajectory_along(), trajectory.ahead, window) {
            return go_ahead(window);
        }
        return approach(carry);
    }
    return rest(carry);
}

fn go_ahead(window: f32) -> Move {
    if trajectory.kicks <= MOST_KICKS {
        trajectory.point = trajectory.ahead;
    } else {
        trajectory.point = point_flown(trajectory.point, window, CONTACT_FREE);
    }
    return Move(end_step(), 0u, 0.0, 0.0, CONTACT_FREE, 0.0);
}

fn end_step() -> u32 {
    trajectory.offset = 0.0;
    trajectory.under_way = 0u;
    trajectory.met = 0u;
    trajectory.step = trajectory.step + 1u;
    if trajectory.step == flight.steps {
        trajectory.step = 0u;
        trajectory.point.sin = 0.0;
        trajectory.point.cos = 1.0;
        return EVENT_STROBE;
    }
    if trajectory.step + trajectory.step == flight.steps {
        trajectory.point.sin = 0.0;
        trajectory.point.cos = -1.0;
        return EVENT_HALF_PERIOD;
    }
    return EVENT_STEP_END;
}
