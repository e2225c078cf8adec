// How long a mass surely stays on its stop: what presses on the contact, looked at from both ends of a flight under it.

// What presses on a contact at both ends of a flight under it, its derivatives, a bound on the fourth derivative in between, and
// how long the flight takes.
struct Pressed {
    forces: vec2<f32>,
    slopes: vec2<f32>,
    bound: f32,
    time: f32,
}

// On the stop at an end, between what presses on it now and a motion a time later; by the slack more than it does.
fn pressed_over(time: f32, pressing: Pressing, then: Motion, bound: f32, end: End) -> Pressed {
    let sign = end_sign(end);
    let forces = vec2(pressing.force, sign * then.pressing[end.normal]) + pressing.slack;
    return Pressed(forces, vec2(pressing.slope, sign * then.pressing_rate[end.normal]), bound, time);
}

// Whether it surely presses all the time, but for about the last `late` of it, as it does at the beginning.
fn pressed_lasts(pressed: Pressed, late: f32) -> bool {
    let hull = hull_of(pressed.forces, pressed.slopes, pressed.bound, pressed.time);
    let presses = hull.lower > 0.0 && hull.lowest > 0.0;
    return presses && pressed.forces.y >= -(late * abs(pressed.slopes.y));
}

// About when it vanishes: FAR where it presses at the end and does not fall.
fn pressed_vanishes(pressed: Pressed) -> f32 {
    let opens = pressed.forces.y < 0.0;
    if !opens && pressed.slopes.y >= 0.0 {
        return FAR;
    }
    let start = select(1.0, quintic_chord(pressed.forces, -(pressed.slopes.x * pressed.time)), opens);
    return quintic_root(quintic_cubic(pressed.forces, pressed.slopes, pressed.time), start) * pressed.time;
}

// About for how long it would be seen to press if it went on as between both ends of this time: 0 where it does not press there.
fn pressed_seen(pressed: Pressed) -> f32 {
    let lowest = min(pressed.forces.x, hull_of(pressed.forces, pressed.slopes, 0.0, pressed.time).lowest);
    let square = lowest * SEEN_SHARE / pressed.bound;
    return select(0.0, sqrt(sqrt(max(square, 0.0))), square > 0.0);
}

// How long a flight is to be tried next, and whether this one may be made.
struct Tried {
    next: f32,
    lasts: bool,
}

fn pressed_next(pressed: Pressed, sure: f32, late: f32) -> Tried {
    // A little beyond, for the contact to open there whatever rounding adds.
    let vanishes = pressed_vanishes(pressed) + late * 0.5;
    if pressed_lasts(pressed, late) {
        return Tried(select(pressed.time, vanishes, vanishes > pressed.time), true);
    }
    if vanishes > sure && vanishes < pressed.time {
        return Tried(vanishes, false);
    }
    // What bounds the force may be too far from it to see that it lasts.
    let seen = pressed_seen(pressed);
    let next = select(sqrt(sure * pressed.time), seen, seen > sure);
    return Tried(select(sure, next, next > sure && next < pressed.time), false);
}
