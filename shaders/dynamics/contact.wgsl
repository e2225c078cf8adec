// The next contact with a stop, approached from the safe side.

// A time for which the motion provably stays off all stops but those at the ends that `ignored` includes.
fn contact_safe_time(point: Point, motion: Motion, ignored: u32, window: f32) -> f32 {
    var bounds: array<f32, NORMALS>;
    //: each normal
    bounds[$k] = point_bound(point, $ku);
    //: end
    return contact_safe_where_bounded(point, motion, ignored, window, bounds);
}

// The same, with bounds on |(d·x)''''| along each normal.
fn contact_safe_where_bounded(
    point: Point,
    motion: Motion,
    ignored: u32,
    window: f32,
    bounds: array<f32, NORMALS>,
) -> f32 {
    var safe = window;
    //: each normal
    {
        let direction = flight.normals[$k].direction;
        let place = along(direction, point.state.x);
        let speed = along(direction, point.state.v);
        let approach = motion_approach(motion, direction, bounds[$k]);
        let upper = stops.gap[$k][0];
        if upper < FAR && !contact_includes(ignored, End($ku, 0u)) {
            safe = min(safe, safe_from_stop(upper - place, speed, approach, 1.0, window));
        }
        let lower = stops.gap[$k][1];
        if lower < FAR && !contact_includes(ignored, End($ku, 1u)) {
            safe = min(safe, safe_from_stop(lower + place, -speed, approach, -1.0, window));
        }
    }
    //: end
    return safe;
}

// The gap to the stop at an end.
fn contact_gap_to(point: Point, end: End) -> f32 {
    let place = along(flight.normals[end.normal].direction, point.state.x);
    return stops.gap[end.normal][end.side] - end_sign(end) * place;
}

// The size of the numbers whose difference the gap is.
fn contact_extent(point: Point, end: End) -> f32 {
    let normal = end.normal;
    let parts = largest_part(flight.normals[normal].direction, point.state.x);
    return max(abs(stops.gap[normal][end.side]), parts);
}

// Speeds and accelerations up to this cannot be told from 0: d·v is a difference of velocities.
fn unresolved(end: End, state: State) -> f32 {
    var size = abs(stops.gap[end.normal][end.side]) + stops.unit;
    //: each coordinate
    size = size + abs(flight.normals[end.normal].direction$c * state.v$c);
    //: end
    return EPSILON * size;
}

// Whether a point lies within all stops but those at the ends that `ignored` includes.
fn contact_is_within(point: Point, ignored: u32) -> bool {
    var within = true;
    //: each normal
    {
        let place = along(flight.normals[$k].direction, point.state.x);
        within = within && (contact_includes(ignored, End($ku, 0u)) || place <= stops.gap[$k][0]);
        within = within && (contact_includes(ignored, End($ku, 1u)) || -place <= stops.gap[$k][1]);
    }
    //: end
    return within;
}

// Whether masses that hop on a stop, never higher than `height` and for no longer than `time`, surely stay off all stops
// along other normals.
fn contact_clears_elsewhere(point: Point, contact: u32, end: End, height: f32, time: f32) -> bool {
    if NORMALS == 1u || time == 0.0 {
        return true;
    }
    let motion = point_motion(point, contact);
    let ignored = contact_with_opposite_ends(contact);
    var raised = point;
    raised.state.x = point.state.x + -(end_sign(end) * height) * flight.normals[end.normal].response;
    return contact_is_within(point, ignored)
        && contact_is_within(raised, ignored)
        && contact_safe_time(point, motion, ignored, time) >= time
        && contact_safe_time(raised, motion, ignored, time) >= time;
}

// The bound on the mean acceleration towards the stop within a window.
fn steepest(acceleration: f32, jerk: f32, bound: f32, window: f32) -> f32 {
    return acceleration + max(window * (jerk + bound * window), 0.0);
}

fn safe_within(gap: f32, speed: f32, acceleration: f32, jerk: f32, bound: f32, window: f32) -> f32 {
    return min(closing_time(gap, speed, steepest(acceleration, jerk, bound, window)), window);
}

// Whether a gap surely stays open for a time, by a glance.
fn stays_clear(gap: f32, speed: f32, acceleration: f32, time: f32) -> bool {
    return gap > time * (max(speed, 0.0) + 0.5 * max(acceleration, 0.0) * time);
}

fn safe_from_stop(distance: f32, speed: f32, approach: Approach, sign: f32, window: f32) -> f32 {
    let gap = max(distance, 0.0);
    let acceleration = sign * approach.acceleration;
    let jerk = sign * approach.jerk * THIRD;
    let bound = approach.bound * TWELFTH;
    if stays_clear(gap, speed, steepest(acceleration, jerk, bound, window), window) {
        return window;
    }
    if speed <= 0.0 {
        let pulled_off = pulled_off_time(acceleration, jerk, bound);
        if pulled_off >= window {
            return window;
        }
        let expected = WIDENING * closing_time(gap, speed, acceleration);
        return max(safe_within(gap, speed, acceleration, jerk, bound, min(expected, window)), pulled_off);
    }
    if acceleration < 0.0 {
        if safe_within(gap, speed, acceleration, jerk, bound, window) >= window {
            return window;
        }
    }
    return safe_within(gap, speed, acceleration, jerk, bound, min(WIDENING * gap / speed, window));
}

fn closing_time(gap: f32, speed: f32, acceleration: f32) -> f32 {
    let discriminant = speed * speed + (gap + gap) * acceleration;
    if (acceleration <= 0.0 && speed <= 0.0) || discriminant < 0.0 {
        return FAR;
    }
    let root = sqrt(discriminant);
    if speed > 0.0 {
        return (gap + gap) / (speed + root);
    }
    return (root - speed) / acceleration;
}

fn pulled_off_time(acceleration: f32, jerk: f32, bound: f32) -> f32 {
    if acceleration > 0.0 || (acceleration == 0.0 && jerk >= 0.0) {
        return 0.0;
    }
    let root = sqrt(jerk * jerk - 4.0 * acceleration * bound);
    if jerk > 0.0 {
        return -(2.0 * acceleration) / (jerk + root);
    }
    if root == jerk {
        // Nothing ever changes the acceleration.
        return FAR;
    }
    return (root - jerk) / (2.0 * bound);
}

fn contact_pressed_time(force: f32, slope: f32, bound: f32, window: f32) -> f32 {
    return min(closing_time(max(force, 0.0), -slope, bound), window);
}
