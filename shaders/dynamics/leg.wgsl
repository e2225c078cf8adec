// The rest of a step of free flight, and whether it stays off the stops.

// Whether a leg provably stays off the stops at the two ends of a normal.
struct Clearance {
    upper: bool,
    lower: bool,
}

fn leg_clearance(before: Point, after: Point, window: f32, normal: u32) -> Clearance {
    let direction = flight.normals[normal].direction;
    let places = vec2(along(direction, before.state.x), along(direction, after.state.x));
    let speeds = vec2(along(direction, before.state.v), along(direction, after.state.v));
    let hull = hull_of(places, speeds, point_bound(before, normal), window);
    let gap = stops.gap[normal][0];
    let sound = hull.lower < gap;
    let upper = sound & (max(hull.highest, places.y) < gap);
    return Clearance(upper, -stops.gap[normal][1] < min(hull.lowest, places.y));
}

fn leg_clears(before: Point, after: Point, window: f32) -> bool {
    var clear = true;
    //: each normal
    let clearance$k = leg_clearance(before, after, window, $ku);
    clear = clear & clearance$k.upper & clearance$k.lower;
    //: end
    return clear;
}
