// What presses on a contact now, and whether that can be told from nothing.

// What presses on a contact that holds, as an acceleration towards the stop, its derivative, how far it may seem to fall below 0
// while the contact holds (not at all, but where rounding decides on its sign), and whether the contact opens now.
struct Pressing {
    force: f32,
    slope: f32,
    slack: f32,
    opens: bool,
}

// On the stop at an end, of those on which masses rest.
fn pressing_on(point: Point, motion: Motion, contact: u32, end: End) -> Pressing {
    let sign = end_sign(end);
    let force = sign * motion.pressing[end.normal];
    let slope = sign * motion.pressing_rate[end.normal];
    let unknown = unresolved(end, point.state);
    if slope * flight_least() < -unknown {
        return Pressing(force, slope, 0.0, force <= unknown);
    }
    let lost = unknown + pressing_lost(point, contact, end.normal);
    return Pressing(force, slope, select(0.0, lost, abs(force) <= lost), force < -lost);
}

// For how long it provably lasts, at most `window`, or does nothing to a speed that would not be lost in rounding; `bound` is on its
// second derivative.
fn pressing_lasts(pressing: Pressing, bound: f32, window: f32) -> f32 {
    return contact_pressed_time(pressing.force + pressing.slack * UNHEEDED, pressing.slope, bound, window);
}

// Whether masses on a stop, or as near to it as rounding tells, with a speed that cannot be told from 0, stay there beside the
// contacts that hold: a hop would be lost in rounding.
fn rests(point: Point, contact: u32, end: End) -> bool {
    let there = contact_with(contact, end);
    let pressing = pressing_on(point, point_motion(point, there), there, end);
    return pressing.force >= 0.0 || !pressing.opens;
}

// What may be lost in rounding of what presses on a contact.
fn pressing_lost(point: Point, contact: u32, normal: u32) -> f32 {
    var sizes = (abs(flight.load) + abs(flight.sin)) + abs(flight.cos);
    //: each coordinate
    let moved$i = abs(point.state.x$c) + abs(point.state.v$c) / flight.rate;
    sizes = moved$i * (flight.rate * abs(flight.damping[$i]) + abs(flight.stiffness[$i])) + sizes;
    //: end
    let held = contact_held(contact);
    var sum = 0.0;
    //: each normal
    sum = abs(pressing_share(held, normal, $ku)) * along(abs(flight.normals[$k].direction), sizes) + sum;
    //: end
    return LOST_SHARE * sum;
}
