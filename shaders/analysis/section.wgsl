// Sections: where a motion is looked at, what is read there, and whether its impacts chatter.

struct Rebounds {
    last: f32,
    run: u32,
    longest: u32,
}

// The codes of the section and of what is read there.
struct Probe {
    section: u32,
    reading: u32,
}

var<private> probe: Probe;
var<private> rebounds: Rebounds;

fn is_impact(taken: Move) -> bool {
    return taken.event >= EVENT_IMPACT && taken.event <= EVENT_COMPLETE_CHATTER && taken.velocity != 0.0;
}

// Whether a move ended on the section.
fn probe_meets(taken: Move) -> bool {
    if probe.section == SECTION_STROBE {
        return taken.event == EVENT_STROBE;
    }
    return is_impact(taken) && probe.section == taken.stop;
}

fn probe_read(taken: Move) -> f32 {
    switch probe.reading {
        case READING_V_BEFORE: {
            return taken.velocity;
        }
        case READING_V_AFTER: {
            return taken.rebound;
        }
        case READING_TAU: {
            let steps = f32(trajectory.step) + trajectory.offset * flight.inverse_h;
            return steps * (TAU / f32(flight.steps));
        }
        default: {
            if probe.reading == READING_V1 && probe.section != SECTION_STROBE {
                return taken.rebound;
            }
            var values = state_values(trajectory.point.state);
            return values[probe.reading - READING_X1];
        }
    }
}

fn rebounds_see(taken: Move) {
    if !is_impact(taken) {
        return;
    }
    let velocity = taken.velocity;
    let slower = velocity * rebounds.last > 0.0 && abs(velocity) < abs(rebounds.last);
    rebounds.run = select(1u, rebounds.run + 1u, slower);
    rebounds.longest = max(rebounds.longest, rebounds.run);
    rebounds.last = velocity;
}
