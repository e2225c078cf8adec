// Impacts that are approached from the safe side: restitution, and what follows where chatter is complete.

// The energy that an impact takes.
fn energy_taken(mass: f32, before: f32, after: f32) -> f32 {
    return 0.5 * mass * (before * before - after * after);
}

// The energy that clamps take besides, of an impact along the normal `struck` that throws masses on them, whose speeds it changes.
fn taken_by_clamps(contact: u32, struck: u32, kick: f32) -> f32 {
    var taken = 0.0;
    if !contact_is_clamped(contact) {
        return taken;
    }
    let contacts = contact_held(contact);
    let response = flight.normals[struck].response;
    //: each normal
    let thrown$k = select(0.0, kick * along(flight.normals[$k].direction, response), contact_is_clamped_along(contact, $ku));
    //: end
    //: each pair of normals
    taken = taken + 0.5 * flight.normals[$k].mass * thrown$k * (pressing_share(contacts, $ku, $lu) * thrown$l);
    //: end
    return taken;
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
    let rebound = -(stops.restitution[end.normal][end.side] * velocity);
    let kick = rebound - velocity;
    trajectory.point = arrived;
    trajectory.point.state = placed_on(arrived.state, end, rebound);
    trajectory.offset = trajectory.offset + reached.left;
    if before_contact != CONTACT_FREE {
        keep_pressed(end.normal, kick);
    }
    let after = point_motion(trajectory.point, trajectory.contact);
    let rest = (flight.h - trajectory.offset) * flight.inverse_h;
    let later = wake(end.normal, rest);
    let closed = strike_closed(end, rebound, after);
    // Of two stops without restitution either may seem to end it at once.
    let at_once = closed.gap_integral == 0.0 && closed.rebounds == 0.0;
    if NORMALS > 1u && (!closed.closes || at_once) && abs(velocity) > unresolved(end, arrived.state) {
        let squeeze = squeezed(trajectory.point, trajectory.contact, end);
        if squeeze.closes {
            return squeeze_collapse(carry, end, squeeze.beside, velocity, rebound, before);
        }
    }
    // Where an impact takes masses off a contact, which throws them back, each stop by itself seems to end that, again and again.
    let freed = trajectory.contact != before_contact;
    var corner = CONTACT_FREE;
    if !closed.closes || freed {
        corner = corner_closes(trajectory.point, trajectory.contact, end);
    }
    let closes = closed.closes && corner == CONTACT_FREE;
    // A speed that rounding cannot tell from 0 is no impact where the masses stay on the stop: it shifts nothing, and nothing
    // rebounds.
    let stays = closes && abs(velocity) <= unresolved(end, arrived.state);
    if carry && velocity != 0.0 && !stays {
        if trajectory.under_way == 1u {
            let pull = along(direction, before);
            let back = look_back(end.normal, rest);
            tangent = tangent_struck_ahead(tangent, back, velocity, kick, pull, later);
        } else {
            let contact = trajectory.contact;
            let impact = Saltation(end.normal, velocity, kick, before, after.acceleration, contact);
            tangent = tangent_struck(tangent, impact);
        }
    }
    let stop = flight.normals[end.normal].stop[end.side];
    if !closes && corner == CONTACT_FREE {
        let lost = unresolved(end, trajectory.point.state);
        if abs(rebound) <= lost {
            // Pulled off the stop as soon as it is met: rounding must not make that another impact.
            trajectory.point.state = placed_on(trajectory.point.state, end, -(sign * (lost + lost)));
        }
        bounce(carry, kick, later);
        return Move(EVENT_IMPACT, stop, velocity, rebound, CONTACT_FREE, 0.0);
    }
    // Caught: in the corner between several stops, or on this one.
    let single = contact_with(trajectory.contact, end);
    if closes {
        trajectory.point = closed.resting;
        if carry && abs(rebound) > 0.0 && !stays {
            let present = tangent_present(tangent);
            let contact = trajectory.contact;
            tangent = tangent_closed(present, contact, end, abs(rebound), closed.force, closed.gap_integral);
            trajectory.under_way = 0u;
        }
    }
    strike_catch(carry, select(corner, single, closes));
    if !closes {
        trajectory.point.state = rested(trajectory.point.state, corner);
        return Move(EVENT_COMPLETE_CHATTER, stop, velocity, rebound, corner & ~single, 0.0);
    }
    let event = select(EVENT_CAUGHT, EVENT_COMPLETE_CHATTER, !stays && abs(rebound) > 0.0);
    return Move(event, stop, select(velocity, 0.0, stays), rebound, CONTACT_FREE, closed.rebounds);
}

// Whether closing the rebounds that follow an impact is as good as following them, where they end at rest, and how long they take.
struct Closed {
    closes: bool,
    resting: Point,
    rebounds: f32,
    // What of them a deviation changes, 0 where they are over at once, and what presses.
    gap_integral: f32,
    force: f32,
}

fn strike_closed(end: End, rebound: f32, after: Motion) -> Closed {
    let approach = point_approach(trajectory.point, after, end.normal);
    let sign = end_sign(end);
    let towards = Approach(sign * approach.acceleration, sign * approach.jerk, approach.bound);
    let room = f32(flight.steps - trajectory.step) * flight.h - trajectory.offset;
    let restitution = stops.restitution[end.normal][end.side];
    let least = unresolved(end, trajectory.point.state);
    if abs(rebound) <= least && rests(trajectory.point, trajectory.contact, end) {
        return Closed(true, at_rest(end, 0.0), 0.0, 0.0, towards.acceleration);
    }
    let closure = chatter_close(end.normal, Rebound(abs(rebound), restitution, least, room), towards);
    if !closure.closes {
        return Closed(false, trajectory.point, 0.0, 0.0, towards.acceleration);
    }
    let resting = at_rest(end, closure.gap_integral);
    let contact = contact_with(trajectory.contact, end);
    let clears = contact_clears_elsewhere(resting, contact, end, closure.height, closure.lasts);
    // Without height they are over at once, or damping alone ends what is as good as rest.
    let gap_integral = select(0.0, closure.gap_integral, closure.height > 0.0);
    return Closed(clears, resting, closure.time, gap_integral, towards.acceleration);
}

// An impact that ends in flight: the end of the step is where the kick takes it.
fn bounce(carry: bool, kick: f32, later: State) {
    if trajectory.under_way == 0u {
        trajectory_look_ahead(carry);
        return;
    }
    trajectory.kicks = trajectory.kicks + 1u;
    if trajectory.kicks <= MOST_KICKS {
        trajectory.ahead = point_kicked(trajectory.ahead, kick, later);
    }
}

// From now on these contacts hold.
fn strike_catch(carry: bool, contact: u32) {
    if carry {
        tangent = tangent_caught(tangent_present(tangent), contact);
    }
    trajectory.under_way = 0u;
    trajectory.contact = contact;
}

// The end of a chatter sequence: springs and dampers acted on the masses that are free, and now the contact holds.
fn at_rest(end: End, gap_integral: f32) -> Point {
    let contact = contact_with(trajectory.contact, end);
    let sways = closing_sways(contact, end.normal);
    let signed_integral = -(end_sign(end) * gap_integral);
    let state = trajectory.point.state;
    let moved = State(state.x + signed_integral * sways.x, state.v + signed_integral * sways.v);
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
        let lost = unresolved(end, trajectory.point.state) + KICK_ROUNDINGS * EPSILON * abs(kick);
        if !contact_is_clamped_along(trajectory.contact, $ku) && abs(change) > lost {
            trajectory.contact = contact_without(trajectory.contact, $ku);
        }
    }
    //: end
    trajectory.point.state = rested(trajectory.point.state, trajectory.contact);
}
