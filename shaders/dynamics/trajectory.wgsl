// One trajectory: steps of flight, impacts, chatter, sticking.

struct Trajectory {
    point: Point,
    ahead: Point,
    kicks: u32,
    contact: u32,
    step: u32,
    offset: f32,
}

// A move: what ended it, and with an impact, at which stop, and d·v before and after it.
struct Move {
    event: u32,
    stop: u32,
    velocity: f32,
    rebound: f32,
    // The stops beside this one that share the rebounds of a complete chatter sequence, as contacts; seldom any.
    beside: u32,
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
    return Trajectory(point, point, 0u, contact, 0u, 0.0);
}

// A trajectory that goes on from a point at a time `offset` after the beginning of a step.
fn trajectory_from_point(point: Point, contact: u32, step: u32, offset: f32) -> Trajectory {
    var ahead = point;
    if contact == CONTACT_FREE {
        ahead = point_flown(point, flight.h - offset, contact);
    }
    return Trajectory(point, ahead, 0u, contact, step, offset);
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
    if trajectory.offset == 0.0 {
        trajectory.ahead = point_stepped(trajectory.point);
        trajectory.kicks = 0u;
    }
    if trajectory.kicks <= MOST_KICKS {
        if leg_clears(trajectory.point, trajectory.ahead, window) {
            return go_ahead(carry, window);
        }
        if trajectory.kicks < MOST_KICKS {
            let met = crossing_of(trajectory.point, trajectory.ahead, window);
            if met.certain {
                trajectory_cross(met, carry);
                let stop = flight.normals[met.end.normal].stop[met.end.side];
                return Move(EVENT_IMPACT, stop, met.velocity, met.rebound, CONTACT_FREE);
            }
        }
    }
    return approach(carry);
}

// Up to and through a contact that is certain.
fn trajectory_cross(met: Crossing, carry: bool) {
    if carry {
        let contact = CONTACT_FREE;
        let impact = Saltation(met.end.normal, met.velocity, met.kick, met.before, met.after, contact);
        tangent = tangent_struck(tangent_flown_freely(tangent, met.time), impact);
    }
    let rest = (flight.h - trajectory.offset) - met.time;
    trajectory.point = met.point;
    trajectory.ahead = point_kicked(trajectory.ahead, met.end.normal, met.kick, rest);
    trajectory.kicks = trajectory.kicks + 1u;
    trajectory.offset = trajectory.offset + met.time;
}

// Free flight towards a stop, as far as is safe.
fn approach(carry: bool) -> Move {
    let window = flight.h - trajectory.offset;
    let motion = point_motion(trajectory.point, CONTACT_FREE);
    let time = contact_safe_time(trajectory.point, motion, CONTACT_FREE, window);
    if time >= window {
        return go_ahead(carry, window);
    }
    glide(carry, time);
    // A contact beyond the end of the step belongs to the next one.
    let reached = contact_imminent(trajectory.point, CONTACT_FREE);
    if trajectory.offset + reached.left > flight.h {
        return Move(EVENT_FLIGHT, 0u, 0.0, 0.0, CONTACT_FREE);
    }
    return strike(carry, reached);
}

// The rare cases: an approach from the safe side, or sticking.
fn advance_warily(carry: bool) -> Move {
    if trajectory.contact == CONTACT_FREE {
        let window = flight.h - trajectory.offset;
        if trajectory.kicks <= MOST_KICKS && leg_clears(trajectory.point, trajectory.ahead, window) {
            return go_ahead(carry, window);
        }
        return approach(carry);
    }
    return rest(carry);
}

fn go_ahead(carry: bool, window: f32) -> Move {
    if trajectory.kicks <= MOST_KICKS {
        trajectory.point = trajectory.ahead;
    } else {
        trajectory.point = point_flown(trajectory.point, window, CONTACT_FREE);
    }
    if carry {
        if trajectory.offset == 0.0 {
            tangent = tangent_stepped(tangent);
        } else {
            tangent = tangent_flown(tangent, window, CONTACT_FREE);
        }
    }
    return Move(end_step(), 0u, 0.0, 0.0, CONTACT_FREE);
}

// Moves on for a time within the step, with the present contacts.
fn glide(carry: bool, time: f32) {
    trajectory.point = point_flown(trajectory.point, time, trajectory.contact);
    trajectory.point.state = rested(trajectory.point.state, trajectory.contact);
    if carry {
        tangent = tangent_flown(tangent, time, trajectory.contact);
    }
    trajectory.offset = trajectory.offset + time;
}

fn end_step() -> u32 {
    trajectory.offset = 0.0;
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
