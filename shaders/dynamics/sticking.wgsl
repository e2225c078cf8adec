// Sticking: masses resting on stops, until what presses on a contact vanishes.

// Sticking: the masses that are free move on until a stop is met, or what presses on a contact vanishes.
fn rest(carry: bool) -> Move {
    let window = flight.h - trajectory.offset;
    let contact = trajectory.contact;
    let motion = point_motion(trajectory.point, contact);
    let least = flight_least();
    let clear = clear_time(trajectory.point, motion, contact, contact_with_opposite_ends(contact), window);
    if clear <= least {
        let reached = imminent(trajectory.point, contact);
        if trajectory.offset + reached.left <= flight.h {
            return strike(carry, reached);
        }
    }
    // What would open just before the step's end opens in the next one.
    if window > least {
        let opening = rest_opening(motion);
        if opening.opens {
            return release(carry, opening.end);
        }
    }
    let sure = surely_held(motion, clear, least);
    let held = held_flight(motion, sure, clear, least);
    glide_to(carry, held.point, held.time);
    if held.time >= window {
        return Move(end_step(), 0u, 0.0, 0.0, CONTACT_FREE, 0.0);
    }
    return Move(EVENT_FLIGHT, 0u, 0.0, 0.0, CONTACT_FREE, 0.0);
}

// A contact that opens now, if any does.
struct Opening {
    opens: bool,
    end: End,
}

// The first of them.
fn rest_opening(motion: Motion) -> Opening {
    let contact = trajectory.contact;
    var opening = Opening(false, End(0u, 0u));
    //: each normal
    if !opening.opens && contact_opens_along(contact, $ku) {
        let end = contact_end_along(contact, $ku);
        opening = Opening(pressing_on(trajectory.point, motion, contact, end).opens, end);
    }
    //: end
    return opening;
}

// For how long, and no longer than `time`, the present contacts surely hold, reckoned from here alone; `least` where they do for
// less.
fn surely_held(motion: Motion, time: f32, least: f32) -> f32 {
    let contact = trajectory.contact;
    var sure = time;
    //: each normal
    if contact_opens_along(contact, $ku) {
        let pressing = pressing_on(trajectory.point, motion, contact, contact_end_along(contact, $ku));
        let bound = point_pressed_bound(trajectory.point, contact, $ku);
        sure = min(sure, max(pressing_lasts(pressing, bound, time), least));
    }
    //: end
    return sure;
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
    var lasts = clear_time(trajectory.point, motion, contact, ignored, flight.h) >= flight.h;
    let late = flight_least();
    //: each normal
    if contact_opens_along(contact, $ku) {
        let end = contact_end_along(contact, $ku);
        let pressing = pressing_on(trajectory.point, motion, contact, end);
        let pressed = pressed_over(flight.h, pressing, then, motion_pressed_bound(motion, contact, $ku), end);
        lasts = lasts && !pressing.opens && pressed_lasts(pressed, late);
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
    // The longest flight that is known to last, and the shortest that is not.
    var lasting = sure;
    var failed = FAR;
    var reach = clear;
    var there = trajectory.point;
    for (var tries = 1u; tries <= HELD_FLIGHTS + 1u; tries++) {
        there = glided(reach);
        if reach <= lasting || tries > HELD_FLIGHTS {
            break;
        }
        let then = point_motion(there, contact);
        var next = clear;
        var lasts = true;
        //: each normal
        if contact_opens_along(contact, $ku) {
            let end = contact_end_along(contact, $ku);
            let pressing = pressing_on(trajectory.point, motion, contact, end);
            let pressed = pressed_over(reach, pressing, then, motion_pressed_bound(motion, contact, $ku), end);
            let tried = pressed_next(pressed, lasting, late);
            next = min(next, tried.next);
            lasts = lasts && tried.lasts;
        }
        //: end
        let last = tries == HELD_FLIGHTS;
        if lasts && (last || next <= reach + late || next >= failed) {
            break;
        }
        lasting = select(lasting, reach, lasts);
        failed = select(reach, failed, lasts);
        reach = select(next, lasting, last);
    }
    return HeldFlight(reach, there);
}

fn release(carry: bool, end: End) -> Move {
    let bound = point_bound(trajectory.point, end.normal);
    let half_window = 0.5 * (flight.h - trajectory.offset);
    let least = flight_least();
    let contact = contact_without(trajectory.contact, end.normal);
    trajectory.contact = contact;
    let motion = point_motion(trajectory.point, contact);
    let slope = end_sign(end) * along(flight.normals[end.normal].direction, motion.jerk);
    let drawn = max(select(least, -slope / (bound + bound), slope < 0.0), least);
    let ignored = contact_with(contact_with_opposite_ends(contact), end);
    let clear = min(drawn, clear_time(trajectory.point, motion, contact, ignored, half_window));
    // What presses on the other contacts may vanish soon without this one.
    let pulled = surely_held(motion, clear, least);
    glide(carry, pulled);
    trajectory_look_ahead(carry);
    return Move(EVENT_RELEASED, flight.normals[end.normal].stop[end.side], 0.0, 0.0, CONTACT_FREE, pulled);
}
