// One trajectory: steps of flight, impacts, chatter, sticking.

// What ended a move.
const EVENT_FLIGHT = 0u;
const EVENT_STEP_END = 1u;
const EVENT_HALF_PERIOD = 2u;
const EVENT_STROBE = 3u;
const EVENT_IMPACT = 4u;
const EVENT_CAUGHT = 5u;
const EVENT_COMPLETE_CHATTER = 6u;
const EVENT_RELEASED = 7u;

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

var<private> trajectory: Trajectory;
var<private> tangent: State;

fn trajectory_new(start: State) -> Trajectory {
    var point = point_at_phase_zero(start);
    var contact = CONTACT_FREE;
    //: each normal
    if flight.normals[$k].gap[0] + flight.normals[$k].gap[1] == 0.0 {
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
        if contact_clears(trajectory.point, trajectory.ahead) {
            return go_ahead(carry, window);
        }
    }
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

fn strike(carry: bool, reached: Reached) -> Move {
    let end = reached.end;
    let direction = flight.normals[end.normal].direction;
    let sign = end_sign(end);
    let speed = along(direction, trajectory.point.state.v);
    if sign * speed < 0.0 {
        trajectory.point.state.v = trajectory.point.state.v - speed * flight.normals[end.normal].response;
    }
    let before_contact = trajectory.contact;
    let arrived = point_nudged(trajectory.point, reached.left, before_contact);
    let before = point_motion(arrived, before_contact).acceleration;
    let velocity = along(direction, arrived.state.v);
    let rebound = -(flight.normals[end.normal].restitution[end.side] * velocity);
    let kick = rebound - velocity;
    trajectory.point = arrived;
    trajectory.point.state = placed(arrived.state, end, rebound);
    trajectory.offset = trajectory.offset + reached.left;
    if before_contact != CONTACT_FREE {
        keep_pressed(end.normal, kick);
    }
    let after = point_motion(trajectory.point, trajectory.contact);
    if carry && velocity != 0.0 {
        let contact = trajectory.contact;
        let impact = Saltation(end.normal, velocity, kick, before, after.acceleration, contact);
        tangent = tangent_struck(tangent, impact);
    }
    let stop = flight.normals[end.normal].stop[end.side];
    let closure = strike_closure(end, rebound, after);
    if !closure.closes {
        let corner = corner_closes(trajectory.point, trajectory.contact, end);
        if corner != CONTACT_FREE {
            let beside = corner & ~contact_with(trajectory.contact, end);
            trajectory.contact = corner;
            trajectory.point.state = rested(trajectory.point.state, corner);
            if carry {
                tangent = tangent_caught(tangent, corner);
            }
            return Move(EVENT_COMPLETE_CHATTER, stop, velocity, rebound, beside);
        }
        let lost = unresolved(end, trajectory.point.state);
        if abs(rebound) <= lost {
            // Pulled off the stop as soon as it is met: rounding must not make that another impact.
            trajectory.point.state = placed(trajectory.point.state, end, -(sign * (lost + lost)));
        }
        bounce(end.normal, kick, before_contact);
        return Move(EVENT_IMPACT, stop, velocity, rebound, CONTACT_FREE);
    }
    come_to_rest(end, closure.gap_integral);
    if carry {
        tangent = tangent_caught(tangent, trajectory.contact);
    }
    let event = select(EVENT_CAUGHT, EVENT_COMPLETE_CHATTER, abs(rebound) > 0.0);
    return Move(event, stop, velocity, rebound, CONTACT_FREE);
}

// The closure of the rebounds that follow an impact, if that is as good as following them.
fn strike_closure(end: End, rebound: f32, after: Motion) -> Closure {
    let approach = point_approach(trajectory.point, after, end.normal);
    let towards = Approach(end_sign(end) * approach.acceleration, approach.jerk, approach.bound);
    let room = f32(flight.steps - trajectory.step) * flight.h - trajectory.offset;
    let restitution = flight.normals[end.normal].restitution[end.side];
    let least = unresolved(end, trajectory.point.state);
    var closure = chatter_close(end.normal, Rebound(abs(rebound), restitution, least, room), towards);
    if closure.closes {
        let resting = at_rest(end, closure.gap_integral);
        let contact = contact_with(trajectory.contact, end);
        closure.closes = contact_clears_elsewhere(resting, contact, end, closure.height, closure.lasts);
    }
    return closure;
}

// An impact that ends in flight: the end of the step is where the kick takes it.
fn bounce(normal: u32, kick: f32, before_contact: u32) {
    if trajectory.contact != CONTACT_FREE {
        return;
    }
    let rest = flight.h - trajectory.offset;
    if before_contact != CONTACT_FREE {
        trajectory.kicks = 0u;
        trajectory.ahead = point_flown(trajectory.point, rest, CONTACT_FREE);
        return;
    }
    trajectory.kicks = trajectory.kicks + 1u;
    if trajectory.kicks <= MOST_KICKS {
        trajectory.ahead = point_kicked(trajectory.ahead, normal, kick, rest);
    }
}

// The end of a chatter sequence: springs and dampers acted on the masses that are free, and now the contact holds.
fn come_to_rest(end: End, gap_integral: f32) {
    trajectory.point = at_rest(end, gap_integral);
    trajectory.contact = contact_with(trajectory.contact, end);
}

fn at_rest(end: End, gap_integral: f32) -> Point {
    let contact = contact_with(trajectory.contact, end);
    let response = flight.normals[end.normal].response;
    let push = held(contact, applied(flight.damping, response)).rest;
    let pull = held(contact, applied(flight.stiffness, response) + applied(flight.damping, push)).rest;
    let signed_integral = -(end_sign(end) * gap_integral);
    let state = trajectory.point.state;
    let moved = State(state.x + signed_integral * push, state.v + signed_integral * pull);
    var point = trajectory.point;
    point.state = rested(moved, contact);
    return point;
}

// After an impact along the normal `struck`: a contact whose speed this changes, by more than is lost in rounding, no
// longer holds.
fn keep_pressed(struck: u32, kick: f32) {
    let response = flight.normals[struck].response;
    //: each normal
    if (contact_held(trajectory.contact) >> $ku & 1u) == 1u {
        let end = contact_end_along(trajectory.contact, $ku);
        let change = kick * along(flight.normals[$k].direction, response);
        let lost = unresolved(end, trajectory.point.state) + 4.0 * EPSILON * abs(kick);
        if !contact_is_clamped_along(trajectory.contact, $ku) && abs(change) > lost {
            trajectory.contact = contact_without(trajectory.contact, $ku);
        }
    }
    //: end
    trajectory.point.state = rested(trajectory.point.state, trajectory.contact);
}

// Sticking: the masses that are free move on until a stop is met, or what presses on a contact vanishes.
fn rest(carry: bool) -> Move {
    let window = flight.h - trajectory.offset;
    let contact = trajectory.contact;
    let motion = point_motion(trajectory.point, contact);
    let least = flight.h * SQRT_EPSILON;
    let clear = contact_safe_time(trajectory.point, motion, contact_with_opposite_ends(contact), window);
    if clear <= least {
        let reached = contact_imminent(trajectory.point, contact);
        if trajectory.offset + reached.left <= flight.h {
            return strike(carry, reached);
        }
    }
    var time = clear;
    //: each normal
    if (contact_held(contact) >> $ku & 1u) == 1u && !contact_is_clamped_along(contact, $ku) {
        let end = contact_end_along(contact, $ku);
        let sign = end_sign(end);
        let force = sign * motion.pressing[$k];
        let slope = sign * motion.pressing_rate[$k];
        let bound = point_bound(trajectory.point, $ku);
        let lost = unresolved(end, trajectory.point.state);
        if (force <= lost && slope < 0.0) || force < -lost {
            return release(carry, end, bound);
        }
        time = min(time, max(contact_pressed_time(force, slope, bound, window), least));
    }
    //: end
    glide(carry, min(time, window));
    if time >= window {
        return Move(end_step(), 0u, 0.0, 0.0, CONTACT_FREE);
    }
    return Move(EVENT_FLIGHT, 0u, 0.0, 0.0, CONTACT_FREE);
}

fn release(carry: bool, end: End, bound: f32) -> Move {
    let half_window = 0.5 * (flight.h - trajectory.offset);
    let least = flight.h * SQRT_EPSILON;
    let contact = contact_without(trajectory.contact, end.normal);
    trajectory.contact = contact;
    let motion = point_motion(trajectory.point, contact);
    let slope = end_sign(end) * along(flight.normals[end.normal].direction, motion.jerk);
    let drawn = max(select(least, -slope / (bound + bound), slope < 0.0), least);
    let ignored = contact_with(contact_with_opposite_ends(contact), end);
    let pulled = min(drawn, contact_safe_time(trajectory.point, motion, ignored, half_window));
    glide(carry, pulled);
    if contact == CONTACT_FREE {
        trajectory.ahead = point_flown(trajectory.point, flight.h - trajectory.offset, contact);
        trajectory.kicks = 0u;
    }
    return Move(EVENT_RELEASED, flight.normals[end.normal].stop[end.side], 0.0, 0.0, CONTACT_FREE);
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
