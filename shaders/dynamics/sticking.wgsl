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
        // What would open just before the step's end opens in the next one.
        if window > least && rest_opens(end, force, slope) {
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

// Whether a contact opens now, `slope` being the derivative of the `force` that presses on it.
fn rest_opens(end: End, force: f32, slope: f32) -> bool {
    let lost = unresolved(end, trajectory.point.state);
    return (force <= lost && slope < 0.0) || force < -lost;
}

// A whole step under contacts along one normal, where no other stop is met in it and the contacts surely last: what `held_flight`
// comes to then. Says whether it was made; a step to phase 0 or π is left to `rest`.
fn rest_step(carry: bool) -> bool {
    let contact = trajectory.contact;
    let next = trajectory.step + 1u;
    let to_phase = (next == flight.steps) | (next + next == flight.steps);
    if to_phase | (trajectory.offset > 0.0) | !holds_one_normal(contact) {
        return false;
    }
    let motion = point_motion(trajectory.point, contact);
    var there = point_stepped_held(first_held(contact), trajectory.point);
    there.state = rested(there.state, contact);
    let then = point_motion(there, contact);
    let ignored = contact_with_opposite_ends(contact);
    var lasts = contact_safe_time(trajectory.point, motion, ignored, flight.h) >= flight.h;
    let late = flight.h * SQRT_EPSILON;
    //: each normal
    if contact_opens_along(contact, $ku) {
        let end = contact_end_along(contact, $ku);
        let sign = end_sign(end);
        let forces = vec2(sign * motion.pressing[$k], sign * then.pressing[$k]);
        let slopes = vec2(sign * motion.pressing_rate[$k], sign * then.pressing_rate[$k]);
        let pressed = Pressed(forces, slopes, motion_bound(motion, $ku), flight.h);
        lasts = lasts && !rest_opens(end, forces.x, slopes.x) && pressed_lasts(pressed, late);
    }
    //: end
    if lasts {
        trajectory.point = there;
        if carry {
            tangent = tangent_stepped_held(first_held(contact), tangent);
        }
        trajectory.step = next;
    }
    return lasts;
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
