// Complete chatter: infinitely many rebounds in finite time, their sum in closed form.

// The rebound with which a sequence begins.
struct Rebound {
    speed: f32,
    restitution: f32,
    unresolved: f32,
    room: f32,
}

// Whether the sequence is closed, the integral of its gaps, how high its rebounds rise, and how long they last: about, and at most.
struct Closure {
    closes: bool,
    gap_integral: f32,
    height: f32,
    time: f32,
    lasts: f32,
}

fn chatter_close(normal: u32, rebound: Rebound, towards: Approach) -> Closure {
    let force = towards.acceleration;
    let speed = rebound.speed;
    if speed <= rebound.unresolved {
        return Closure(force >= -rebound.unresolved, 0.0, 0.0, 0.0, 0.0);
    }
    if force <= 0.0 {
        return Closure(false, 0.0, 0.0, 0.0, 0.0);
    }
    let r = rebound.restitution;
    if r < 1.0 {
        let time = (speed + speed) / (force * (1.0 - r));
        let change = time * (abs(towards.jerk) + 0.5 * towards.bound * time) / force + flight.rate * time;
        let cube = speed * speed * speed;
        let gap_integral = TWO_THIRDS * cube / (force * force * (1.0 - r * r * r));
        let effect = gap_integral * flight.normals[normal].coupling;
        let lasts = time + time;
        let closes = lasts <= rebound.room
            && change <= STEADY
            && effect * change <= CHATTER * stops.unit
            && stays_low(normal, speed, force);
        if closes {
            // A force that grows ends them sooner: to first order in its change, by a third of that.
            let sooner = time * time * towards.jerk / (3.0 * force);
            return Closure(true, gap_integral, speed * speed / force, time - sooner, lasts);
        }
    }
    if 1.0 - r <= NEARLY {
        return chatter_drag(normal, rebound, towards);
    }
    return Closure(false, 0.0, 0.0, 0.0, 0.0);
}

// Whether rebounds surely do not reach the stop at the other end of the normal.
fn stays_low(normal: u32, speed: f32, force: f32) -> bool {
    return speed * speed < (stops.gap[normal][0] + stops.gap[normal][1]) * force;
}

// Rebounds without loss, dragged down by the damping along the normal.
fn chatter_drag(normal: u32, rebound: Rebound, towards: Approach) -> Closure {
    let speed = rebound.speed;
    let damping = flight.normals[normal].drag;
    let force = towards.acceleration;
    let drift = abs(towards.jerk + damping * force);
    let steady = (speed + speed) * drift <= STEADY * (force * force);
    if !(damping > 0.0 && steady && speed <= FADING * stops.unit && stays_low(normal, speed, force)) {
        return Closure(false, 0.0, 0.0, 0.0, 0.0);
    }
    let most = speed * speed / ((force + force) * damping);
    let slow = speed * INVERSE_SLOW / stops.unit;
    var fades = slow <= 1.0;
    if !fades {
        let needed = 3.0 * logarithm(slow);
        fades = damping * rebound.room >= needed && damping * force >= (needed + needed) * drift;
    }
    if !(fades && most * flight.normals[normal].coupling <= PUSH * stops.unit) {
        return Closure(false, 0.0, 0.0, 0.0, 0.0);
    }
    let k = 1.5 * (1.0 - rebound.restitution) * force / damping;
    if k <= 0.0 {
        return Closure(true, most, 0.0, 0.0, 0.0);
    }
    let lost = k * (speed - k * logarithm(1.0 + speed / k)) / (force * damping);
    return Closure(true, max(most - lost, 0.0), 0.0, 0.0, 0.0);
}
