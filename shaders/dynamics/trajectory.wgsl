// One trajectory: steps of flight, impacts, chatter, sticking.

// What the first mass touches.
const CONTACT_FREE = 0u;
const CONTACT_STUCK_A = 1u;
const CONTACT_STUCK_B = 2u;
const CONTACT_CLAMPED = 3u;

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

// A move: what ended it, and with an impact, where (+1 at A, -1 at Ā) and how fast.
struct Move {
    event: u32,
    side: f32,
    velocity: f32,
}

var<private> trajectory: Trajectory;
var<private> tangent: vec4<f32>;

fn trajectory_new(start: vec4<f32>) -> Trajectory {
    let clamped = flight.delta == 0.0;
    let state = select(start, vec4(0.0, start.y, 0.0, start.w), clamped);
    let point = point_at_phase_zero(state);
    return Trajectory(point, point, 0u, select(CONTACT_FREE, CONTACT_CLAMPED, clamped), 0u, 0.0);
}

// A trajectory that goes on from a point at a time `offset` after the beginning of a step.
fn trajectory_from_point(point: Point, contact: u32, step: u32, offset: f32) -> Trajectory {
    var ahead = point;
    if contact == CONTACT_FREE {
        ahead = point_flown(point, flight.h - offset, 1.0);
    }
    return Trajectory(point, ahead, 0u, contact, step, offset);
}

// Moves on to the next event, the end of the step at the latest; `carry` says whether the tangent comes along.
fn advance(carry: bool) -> Move {
    if trajectory.contact == CONTACT_FREE {
        return fly(carry);
    }
    if trajectory.contact == CONTACT_CLAMPED {
        glide(carry, flight.h - trajectory.offset, 0.0);
        return Move(end_step(), 0.0, 0.0);
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
    let motion = point_motion(trajectory.point, 1.0);
    let time = contact_safe_time(trajectory.point, motion, window);
    if time >= window {
        return go_ahead(carry, window);
    }
    glide(carry, time, 1.0);
    trajectory.offset = trajectory.offset + time;
    let side = select(-1.0, 1.0, trajectory.point.x1 >= 0.0);
    let left = contact_imminent(trajectory.point, side);
    // A contact beyond the end of the step belongs to the next one.
    if left == FAR || trajectory.offset + left > flight.h {
        return Move(EVENT_FLIGHT, 0.0, 0.0);
    }
    if side * trajectory.point.v1 < 0.0 {
        trajectory.point.v1 = 0.0;
    }
    return strike(carry, side, left);
}

fn go_ahead(carry: bool, window: f32) -> Move {
    if trajectory.kicks <= MOST_KICKS {
        trajectory.point = trajectory.ahead;
    } else {
        trajectory.point = point_flown(trajectory.point, window, 1.0);
    }
    if carry {
        if trajectory.offset == 0.0 {
            tangent = tangent_stepped(tangent);
        } else {
            tangent = tangent_flown(tangent, window, 1.0);
        }
    }
    return Move(end_step(), 0.0, 0.0);
}

fn strike(carry: bool, side: f32, left: f32) -> Move {
    let arrived = point_nudged(trajectory.point, left);
    let before = point_motion(arrived, 1.0);
    let velocity = arrived.v1;
    let rebound = -(flight.r * velocity);
    trajectory.point = arrived;
    trajectory.point.x1 = side * flight.delta;
    trajectory.point.v1 = rebound;
    trajectory.offset = trajectory.offset + left;
    let after = point_motion(trajectory.point, 1.0);
    if carry && velocity != 0.0 {
        tangent = tangent_struck(tangent, velocity, rebound - velocity, before.acceleration, after.acceleration);
    }
    let speed = abs(rebound);
    let room = f32(flight.steps - trajectory.step) * flight.h - trajectory.offset;
    let closure = chatter_close(speed, Motion(side * after.acceleration, after.jerk, after.bound), room);
    if !closure.closes {
        trajectory.kicks = trajectory.kicks + 1u;
        if trajectory.kicks <= MOST_KICKS {
            trajectory.ahead = point_kicked(trajectory.ahead, rebound - velocity, flight.h - trajectory.offset);
        }
        return Move(EVENT_IMPACT, side, velocity);
    }
    // The gap of the skipped rebounds lets the coupling's spring and damper act on the second mass.
    let push = side * flight.inverse_mass * closure.gap_integral;
    let drag = flight.coupling_damping * (flight.inverse_mass * flight.coupling_damping + flight.ground_damping);
    trajectory.point.x2 = trajectory.point.x2 - flight.coupling_damping * push;
    trajectory.point.v2 = trajectory.point.v2 - (1.0 - drag) * push;
    trajectory.point.v1 = 0.0;
    trajectory.contact = select(CONTACT_STUCK_B, CONTACT_STUCK_A, side > 0.0);
    if carry {
        tangent = vec4(0.0, tangent.y, 0.0, tangent.w);
    }
    return Move(select(EVENT_CAUGHT, EVENT_COMPLETE_CHATTER, speed > 0.0), side, velocity);
}

fn rest(carry: bool) -> Move {
    let window = flight.h - trajectory.offset;
    let side = select(-1.0, 1.0, trajectory.contact == CONTACT_STUCK_A);
    let motion = point_motion(trajectory.point, 0.0);
    let force = side * motion.acceleration;
    let slope = side * motion.jerk;
    if force <= unresolved() && slope < 0.0 {
        return release(carry, side, slope);
    }
    let least = flight.h * SQRT_EPSILON;
    let time = max(contact_pressed_time(force, slope, motion.bound, window), least);
    if time >= window {
        glide(carry, window, 0.0);
        return Move(end_step(), 0.0, 0.0);
    }
    glide(carry, time, 0.0);
    trajectory.offset = trajectory.offset + time;
    return Move(EVENT_FLIGHT, 0.0, 0.0);
}

fn release(carry: bool, side: f32, slope: f32) -> Move {
    let motion = point_motion(trajectory.point, 1.0);
    let half_window = 0.5 * (flight.h - trajectory.offset);
    let least = flight.h * SQRT_EPSILON;
    let longest = min(max(-slope / (motion.bound + motion.bound), least), half_window);
    let pulled = contact_safe_across(trajectory.point, motion, side, longest);
    trajectory.contact = CONTACT_FREE;
    glide(carry, pulled, 1.0);
    trajectory.offset = trajectory.offset + pulled;
    trajectory.ahead = point_flown(trajectory.point, flight.h - trajectory.offset, 1.0);
    trajectory.kicks = 0u;
    return Move(EVENT_RELEASED, side, 0.0);
}

fn glide(carry: bool, time: f32, free: f32) {
    trajectory.point = point_flown(trajectory.point, time, free);
    if carry {
        tangent = tangent_flown(tangent, time, free);
    }
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
