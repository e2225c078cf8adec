// The next contact with a stop, approached from the safe side.

fn contact_clears(before: Point, after: Point) -> bool {
    let third = flight.h * THIRD;
    let h2 = flight.h * flight.h;
    let room = flight.delta - (h2 * h2) * HERMITE * point_bound(before);
    let leaving = before.x1 + third * before.v1;
    let arriving = after.x1 - third * after.v1;
    return abs(before.x1) < room && abs(leaving) < room && abs(arriving) < room && abs(after.x1) < room;
}

// The time left to a stop if it is touched (0) or reached in one straight line; FAR otherwise.
fn contact_imminent(point: Point, side: f32) -> f32 {
    let gap = flight.delta - side * point.x1;
    let speed = side * point.v1;
    if flight.rate * abs(gap) < IMMINENT * speed {
        return gap / speed;
    }
    if gap <= TOUCH * flight.delta && (speed >= 0.0 || is_held(point, side)) {
        return 0.0;
    }
    return FAR;
}

// Whether a hop off the stop would be lost in rounding.
fn is_held(point: Point, side: f32) -> bool {
    return abs(point.v1) <= unresolved() && side * point_accelerations(point).x > 0.0;
}

// Speeds and accelerations up to this cannot be told from 0.
fn unresolved() -> f32 {
    return EPSILON * (flight.delta + 1.0);
}

fn contact_safe_time(point: Point, motion: Motion, window: f32) -> f32 {
    let at_a = safe_from_stop(flight.delta - point.x1, point.v1, motion.acceleration, motion, 1.0, window);
    let at_b = safe_from_stop(flight.delta + point.x1, -point.v1, -motion.acceleration, motion, -1.0, window);
    return min(at_a, at_b);
}

// A time for which a mass that leaves the stop at `side` provably does not reach the other one.
fn contact_safe_across(point: Point, motion: Motion, side: f32, window: f32) -> f32 {
    let gap = flight.delta + side * point.x1;
    return safe_from_stop(gap, -(side * point.v1), -(side * motion.acceleration), motion, -side, window);
}

// The bound on the mean acceleration towards the stop within a window.
fn steepest(acceleration: f32, jerk: f32, bound: f32, window: f32) -> f32 {
    return acceleration + max(window * (jerk + bound * window), 0.0);
}

// How one stop is approached.
struct Approach {
    gap: f32,
    speed: f32,
    acceleration: f32,
    jerk: f32,
    bound: f32,
}

fn safe_within(approach: Approach, window: f32) -> f32 {
    let steep = steepest(approach.acceleration, approach.jerk, approach.bound, window);
    return min(closing_time(approach.gap, approach.speed, steep), window);
}

// Whether a gap surely stays open for a time, by a glance.
fn stays_clear(gap: f32, speed: f32, acceleration: f32, time: f32) -> bool {
    return gap > time * (max(speed, 0.0) + 0.5 * max(acceleration, 0.0) * time);
}

fn safe_from_stop(
    distance: f32,
    speed: f32,
    acceleration: f32,
    motion: Motion,
    side: f32,
    window: f32,
) -> f32 {
    let gap = max(distance, 0.0);
    let jerk = side * motion.jerk * THIRD;
    let bound = motion.bound * TWELFTH;
    if stays_clear(gap, speed, steepest(acceleration, jerk, bound, window), window) {
        return window;
    }
    let approach = Approach(gap, speed, acceleration, jerk, bound);
    if speed <= 0.0 {
        let pulled_off = pulled_off_time(acceleration, jerk, bound);
        if pulled_off >= window {
            return window;
        }
        let expected = WIDENING * closing_time(gap, speed, acceleration);
        return max(safe_within(approach, min(expected, window)), pulled_off);
    }
    if acceleration < 0.0 {
        if safe_within(approach, window) >= window {
            return window;
        }
    }
    return safe_within(approach, min(WIDENING * gap / speed, window));
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
    return (root - jerk) / (2.0 * bound);
}

fn contact_pressed_time(force: f32, slope: f32, bound: f32, window: f32) -> f32 {
    return min(closing_time(max(force, 0.0), -slope, bound), window);
}
