// For how long a motion stays off the stops, bounded from what it is now.

// A safe time for the motion with the contacts that hold. Where that is not all of the window, and short, it is asked again with a
// bound that shrinks as the motion does.
fn clear_time(point: Point, motion: Motion, contact: u32, ignored: u32, window: f32) -> f32 {
    let safe = contact_safe_time(point, motion, ignored, window);
    if safe >= window || safe >= SHORT * flight.h {
        return safe;
    }
    if rests_at_any(point, contact, ignored) {
        return 0.0;
    }
    let onward = clear_onward(point, motion, contact);
    var bounds: array<f32, NORMALS>;
    //: each normal
    bounds[$k] = clear_fourth(motion, onward, contact, $ku, window);
    //: end
    return max(safe, contact_safe_where_bounded(point, motion, ignored, window, bounds));
}

// Whether masses rest on a stop, to be caught there, but for those at the ends that are ignored.
fn rests_at_any(point: Point, contact: u32, ignored: u32) -> bool {
    var rest = false;
    //: each normal
    rest = rest || (!contact_includes(ignored, End($ku, 0u)) && rests_at(point, contact, End($ku, 0u)));
    rest = rest || (!contact_includes(ignored, End($ku, 1u)) && rests_at(point, contact, End($ku, 1u)));
    //: end
    return rest;
}

// How x'' moves: it flows like x without loads, forced by −ω² times as much.
fn clear_onward(point: Point, motion: Motion, contact: u32) -> Motion {
    let forced = -(flight.omega * flight.omega);
    let second = Point(State(motion.acceleration, motion.jerk), forced * point.sin, forced * point.cos);
    return point_motion_under(second, contact, X(0.0));
}

// A bound on |(d·x)''''| for a time after the point, less than a step, along a normal on which nothing holds; the motions are those
// of x and of x''.
fn clear_fourth(motion: Motion, onward: Motion, contact: u32, normal: u32, time: f32) -> f32 {
    let at = others_place(contact, normal);
    let of_x = flights[flow].sixth_x[at];
    let of_v = flights[flow].sixth_v[at];
    let sixth = motion_bounded(motion, of_x, of_v, sixth_forcing(contact, normal));
    let direction = flight.normals[normal].direction;
    let now = abs(along(direction, onward.acceleration));
    let rate = abs(along(direction, onward.jerk));
    return now + time * (rate + 0.5 * time * sixth);
}

fn sixth_forcing(contact: u32, normal: u32) -> f32 {
    return flights[flow].sixth_forcing[others_place(contact, normal)];
}
