// Which stop a leg has to meet, if any.

// The stop that a leg ends beyond, or that it may touch on its way and return, the last if there are several: whether there is
// exactly one, and the leg stays off all stops along other normals; whether it may touch it and return; and whether it stays off
// the stop at the other end of the normal.
struct Face {
    end: End,
    only: bool,
    returns: bool,
    opposite_clear: bool,
}

// The lanes of a processor keep what each leg stays off since it was found not to clear; here registers are dearer than the
// few operations that find it anew.
fn crossing_face(before: Alongs, end: Point, window: f32) -> Face {
    var found = false;
    var only = true;
    var returns = false;
    var opposite_clear = false;
    var normal = 0u;
    var upper = false;
    //: each normal
    {
        let after = along_of(end, $ku);
        let beyond_upper = stops.gap[$k][0] < after.place;
        let beyond = beyond_upper | (stops.gap[$k][1] < -after.place);
        let clear = leg_clearance(before[$k], after, window, point_bound(end, $ku), $ku);
        let both_clear = clear.upper & clear.lower;
        let returns_here = (clear.upper | clear.lower) & !(both_clear | beyond);
        let upper_here = beyond_upper | (returns_here & clear.lower);
        let found_here = beyond | returns_here;
        only = only & !(found_here & found) & (found_here | both_clear);
        found = found | found_here;
        returns = returns | returns_here;
        opposite_clear = opposite_clear | (upper_here & clear.lower) | (found_here & !upper_here & clear.upper);
        normal = select(normal, $ku, found_here);
        upper = select(upper, upper_here, found_here);
    }
    //: end
    return Face(End(normal, select(1u, 0u, upper)), only & found, returns, opposite_clear);
}

// How far from the stop a place on a leg to a state, so long before, may seem to be for rounding, `way` being the length of the way
// to it.
fn stop_rounding(end: End, state: State, window: f32, way: f32) -> f32 {
    let direction = flight.normals[end.normal].direction;
    var parts = 0.0;
    //: each coordinate
    parts = parts + abs(direction$c * state.x$c);
    //: end
    //: each coordinate
    parts = parts + abs(window * (direction$c * state.v$c));
    //: end
    return (abs(face_gap(end)) + abs(way) + parts) * (ROUNDINGS * EPSILON);
}

// The gap at an end.
fn face_gap(end: End) -> f32 {
    return select(stops.gap[end.normal][1], stops.gap[end.normal][0], end.side == 0u);
}
