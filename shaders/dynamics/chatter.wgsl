// Complete chatter: infinitely many rebounds in finite time, closed in one go.

// Whether the sequence is closed, and the integral of its gaps.
struct Closure {
    closes: bool,
    gap_integral: f32,
}

fn chatter_close(speed: f32, motion: Motion, room: f32) -> Closure {
    let force = motion.acceleration;
    if speed <= unresolved() {
        return Closure(force >= -unresolved(), 0.0);
    }
    if force <= 0.0 {
        return Closure(false, 0.0);
    }
    if flight.r >= 1.0 {
        return chatter_drag(speed, motion);
    }
    let r = flight.r;
    let time = (speed + speed) / (force * (1.0 - r));
    let change = time * (abs(motion.jerk) + 0.5 * motion.bound * time) / force + flight.rate * time;
    let cube = speed * speed * speed;
    let gap_integral = TWO_THIRDS * cube / (force * force * (1.0 - r * r * r));
    let effect = gap_integral * flight.inverse_mass * (1.0 + flight.coupling_damping);
    let closes = time + time <= room
        && change <= STEADY
        && effect * change <= CHATTER
        && stays_low(speed, force);
    return Closure(closes, gap_integral);
}

// Whether rebounds surely do not reach the other stop.
fn stays_low(speed: f32, force: f32) -> bool {
    return speed * speed < (flight.delta + flight.delta) * force;
}

// Rebounds without loss, dragged down by the damper.
fn chatter_drag(speed: f32, motion: Motion) -> Closure {
    let damping = flight.coupling_damping;
    let force = motion.acceleration;
    if damping <= 0.0 {
        return Closure(false, 0.0);
    }
    let lasts = damping * force >= DRAGGED * abs(motion.jerk);
    return Closure(lasts && speed <= SLOW && stays_low(speed, force), speed * speed / ((force + force) * damping));
}
