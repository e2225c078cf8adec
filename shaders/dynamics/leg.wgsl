// The rest of a step of free flight, and whether it stays off the stops.

// Whether a leg provably stays off the stops at the two ends of a normal.
struct Clearance {
    upper: bool,
    lower: bool,
}

// Whether a leg stays off both stops of a normal, or one, from where it is `before` and to where it is `after`, so much later.
fn leg_clearance(before: Along, after: Along, window: f32, bound: f32, normal: u32) -> Clearance {
    let hull = hull_of(vec2(before.place, after.place), vec2(before.speed, after.speed), bound, window);
    let gap = stops.gap[normal][0];
    let sound = hull.lower < gap;
    let upper = sound & (max(hull.highest, after.place) < gap);
    return Clearance(upper, -stops.gap[normal][1] < min(hull.lowest, after.place));
}

// Whether the way to the end of a step, so much later, stays off all stops.
fn leg_clears(before: Alongs, end: Point, window: f32) -> bool {
    var clear = true;
    //: each normal
    let clearance$k = leg_clearance(before[$k], along_of(end, $ku), window, point_bound(end, $ku), $ku);
    clear = clear & clearance$k.upper & clearance$k.lower;
    //: end
    return clear;
}
