// What impacts take from a trajectory, and how long contacts hold.

struct Loss {
    energy: f32,
    rested: f32,
    since: f32,
    held: u32,
}

fn loss_none(contact: u32) -> Loss {
    return Loss(0.0, 0.0, 0.0, contact);
}

fn loss_note(taken: Move) {
    let strobe = taken.event == EVENT_STROBE;
    let steps = select(trajectory.step, flight.steps, strobe);
    let now = f32(steps) * flight.h + trajectory.offset;
    let holds = trajectory.contact;
    let held = observer.loss.held != CONTACT_FREE;
    if held {
        let opened = taken.event == EVENT_RELEASED && holds == CONTACT_FREE;
        let until = select(now, now - taken.apart, opened);
        observer.loss.rested = observer.loss.rested + max(until - observer.loss.since, 0.0);
    }
    // Unless another contact holds on.
    let caught = (taken.event == EVENT_CAUGHT || taken.event == EVENT_COMPLETE_CHATTER)
        && (observer.loss.held & holds) == CONTACT_FREE;
    // Rebounds end before the next strobe, but perhaps after phase π.
    let ended = now + select(0.0, taken.apart, caught);
    let since = select(ended, max(observer.loss.since, ended), held);
    observer.loss.since = select(since, 0.0, strobe);
    observer.loss.held = holds;
    if event_is_impact(taken.event) {
        let after = select(0.0, taken.rebound, taken.event == EVENT_IMPACT);
        loss_take(holds, taken.stop, taken.velocity, after);
    }
}

fn loss_take(holds: u32, stop: u32, before: f32, after: f32) {
    var struck = 0u;
    var mass = 0.0;
    //: each normal
    if flight.normals[$k].stop[0] == stop || flight.normals[$k].stop[1] == stop {
        struck = $ku;
        mass = flight.normals[$k].mass;
    }
    //: end
    observer.loss.energy = observer.loss.energy + energy_taken(mass, before, after);
    observer.loss.energy = observer.loss.energy + taken_by_clamps(holds, struck, after - before);
}
