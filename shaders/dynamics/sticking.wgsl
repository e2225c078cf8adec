// Sticking: masses resting on stops, until what presses on a contact vanishes.

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
    var opens = false;
    var opening = End(0u, 0u);
    var opening_bound = 0.0;
    //: each normal
    if !opens && contact_opens_along(contact, $ku) {
        let end = contact_end_along(contact, $ku);
        let sign = end_sign(end);
        let force = sign * motion.pressing[$k];
        let slope = sign * motion.pressing_rate[$k];
        let bound = point_bound(trajectory.point, $ku);
        let lost = unresolved(end, trajectory.point.state);
        // What would open just before the step's end opens in the next one.
        if window > least && ((force <= lost && slope < 0.0) || force < -lost) {
            opens = true;
            opening = end;
            opening_bound = bound;
        }
        time = min(time, max(contact_pressed_time(force, slope, bound, window), least));
    }
    //: end
    if opens {
        return release(carry, opening, opening_bound);
    }
    let held = held_flight(motion, time, clear, least);
    glide_to(carry, held.point, held.time);
    if held.time >= window {
        return Move(end_step(), 0u, 0.0, 0.0, CONTACT_FREE);
    }
    return Move(EVENT_FLIGHT, 0u, 0.0, 0.0, CONTACT_FREE);
}

// A flight under the present contacts.
struct HeldFlight {
    time: f32,
    point: Point,
}

// As long as is found: `sure` is for how long the contacts surely hold, reckoned from here alone, and `clear` for how long nothing
// else is met. They may hold about `late` longer than they should.
fn held_flight(motion: Motion, sure: f32, clear: f32, late: f32) -> HeldFlight {
    let contact = trajectory.contact;
    var reach = clear;
    var failed = FAR;
    var there = trajectory.point;
    for (var tries = 1u; tries <= HELD_FLIGHTS + 1u; tries++) {
        there = glided(reach);
        if reach <= sure || tries > HELD_FLIGHTS {
            break;
        }
        let then = point_motion(there, contact);
        var next = clear;
        var lasts = true;
        //: each normal
        if contact_opens_along(contact, $ku) {
            let sign = end_sign(contact_end_along(contact, $ku));
            let forces = vec2(sign * motion.pressing[$k], sign * then.pressing[$k]);
            let slopes = vec2(sign * motion.pressing_rate[$k], sign * then.pressing_rate[$k]);
            let tried = pressed_next(Pressed(forces, slopes, motion_bound(motion, $ku), reach), sure, late);
            next = min(next, tried.next);
            lasts = lasts && tried.lasts;
        }
        //: end
        let last = tries == HELD_FLIGHTS;
        if lasts && (last || next <= reach + late || next >= failed) {
            break;
        }
        failed = select(reach, failed, lasts);
        reach = select(next, sure, last);
    }
    return HeldFlight(reach, there);
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
    trajectory_look_ahead(carry);
    return Move(EVENT_RELEASED, flight.normals[end.normal].stop[end.side], 0.0, 0.0, CONTACT_FREE);
}
