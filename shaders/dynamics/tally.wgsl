// What the impacts of a trajectory came to.

// Impacts from free flight to free flight, counted since they were last taken, and what has been summed up of them.
struct Tally {
    // At the upper and the lower end of each normal.
    impacts: array<vec2<u32>, NORMALS>,
    fastest: f32,
    energy: f32,
}

var<private> tally: Tally;

// Counts anew, and goes on from what was summed up before.
fn tally_begin(fastest: f32, energy: f32) {
    tally = Tally(array<vec2<u32>, NORMALS>(), fastest, energy);
}

fn tally_count(end: End, before: f32, after: f32, observed: bool) {
    var mass = 0.0;
    //: each normal
    if end.normal == $ku {
        tally.impacts[$k] = tally.impacts[$k] + vec2(1u - end.side, end.side);
        mass = flight.normals[$k].mass;
    }
    //: end
    tally.fastest = max(tally.fastest, abs(before));
    if observed {
        tally.energy = tally.energy + energy_taken(mass, before, after);
    }
}
