// The rest of a step of free flight, and whether it stays off the stops.

// Whether a leg provably stays off the stops at the two ends of a normal.
struct Clearance {
    upper: bool,
    lower: bool,
}

fn leg_clearance(before: Point, after: Point, window: f32, normal: u32) -> Clearance {
    let direction = flight.normals[normal].direction;
    let begins = along(direction, before.state.x);
    let leaves = along(direction, before.state.v);
    let ends = along(direction, after.state.x);
    let arrives = along(direction, after.state.v);
    let quarter = window * 0.25;
    let square = window * window;
    let margin = (square * square) * (SWELLING * point_bound(before, normal));
    let second = leaves * quarter + begins;
    let fourth = ends - arrives * quarter;
    let turn = (leaves - arrives) * (window * SIXTH);
    let middle = (begins + ends) * 0.5 + turn;
    let highest = max(max(max(second, fourth), ends), middle + margin);
    let lowest = min(min(min(second, fourth), ends), middle - margin);
    let gap = stops.gap[normal][0];
    let sound = middle - margin < gap;
    return Clearance(sound & (highest < gap), -stops.gap[normal][1] < lowest);
}

fn leg_clears(before: Point, after: Point, window: f32) -> bool {
    var clear = true;
    //: each normal
    let clearance$k = leg_clearance(before, after, window, $ku);
    clear = clear & clearance$k.upper & clearance$k.lower;
    //: end
    return clear;
}
