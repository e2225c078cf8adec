// How long a mass surely stays on its stop: what presses on the contact, looked at from both ends of a flight under it.

// What presses on a contact at both ends of a flight under it, its derivatives, a bound on the fourth derivative in between, and
// how long the flight takes.
struct Pressed {
    forces: vec2<f32>,
    slopes: vec2<f32>,
    bound: f32,
    time: f32,
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
    // What bounds the force may be too far from it to see that it lasts.
    let next = select(sure + sure, vanishes, vanishes < pressed.time);
    return Tried(select(sure, next, next > sure && next < pressed.time), false);
}
