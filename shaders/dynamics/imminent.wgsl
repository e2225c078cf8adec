// The stop that is met at once.

// A stop that is reached in one straight line, and the time left; FAR where there is none.
struct Reached {
    end: End,
    left: f32,
}

// The stop that is touched, or reached so soon that the square of the time left is lost in rounding; of several the first.
fn imminent(point: Point, contact: u32) -> Reached {
    let ignored = contact_with_opposite_ends(contact);
    var first = Reached(End(0u, 0u), FAR);
    //: each normal
    first = imminent_sooner(first, point, contact, ignored, End($ku, 0u));
    first = imminent_sooner(first, point, contact, ignored, End($ku, 1u));
    //: end
    return first;
}

// The sooner of what was found so far and one more end.
fn imminent_sooner(found: Reached, point: Point, contact: u32, ignored: u32, end: End) -> Reached {
    if stops.gap[end.normal][end.side] >= FAR || contact_includes(ignored, end) {
        return found;
    }
    let left = imminent_at(point, contact, end);
    if left < found.left {
        return Reached(end, left);
    }
    return found;
}

// The speed with which the gap to the stop at an end closes.
fn speed_towards(point: Point, end: End) -> f32 {
    return end_sign(end) * along(flight.normals[end.normal].direction, point.state.v);
}

// Whether masses rest on the stop at an end, or as near to it as rounding tells, with a speed that cannot be told from 0, and stay
// there beside the contacts that hold.
fn rests_at(point: Point, contact: u32, end: End) -> bool {
    let lost = unresolved(end, point.state);
    return abs(speed_towards(point, end)) <= lost && contact_gap_to(point, end) <= lost && rests(point, contact, end);
}

// The time left to one stop; FAR if it is not imminent.
fn imminent_at(point: Point, contact: u32, end: End) -> f32 {
    let gap = contact_gap_to(point, end);
    let speed = speed_towards(point, end);
    let touches = gap <= TOUCH * contact_extent(point, end);
    if (touches && speed > 0.0) || rests_at(point, contact, end) {
        return 0.0;
    }
    if touches {
        return FAR;
    }
    if flight.rate * gap < IMMINENT * speed {
        return gap / speed;
    }
    return FAR;
}
