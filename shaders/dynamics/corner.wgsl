// Complete chatter in a corner: masses that rebound between several stops at once, ever faster, and come to rest on all.

// The contacts of masses that an impact at `end` leaves so slow, and so near to stops along other normals, that they may as
// well rest on all of them; CONTACT_FREE elsewhere.
fn corner_closes(point: Point, contact: u32, end: End) -> u32 {
    if NORMALS == 1u {
        return CONTACT_FREE;
    }
    let struck = contact_with(contact, end);
    var corner = struck;
    //: each normal
    if (contact_held(struck) >> $ku & 1u) == 0u {
        if stops.gap[$k][0] < FAR && corner_is_near(point, End($ku, 0u)) {
            corner = contact_with(corner, End($ku, 0u));
        } else if stops.gap[$k][1] < FAR && corner_is_near(point, End($ku, 1u)) {
            corner = contact_with(corner, End($ku, 1u));
        }
    }
    //: end
    if corner == struck {
        return CONTACT_FREE;
    }
    let motion = point_motion(point, corner);
    var closes = true;
    //: each normal
    if (contact_held(corner) >> $ku & 1u) == 1u && !contact_is_clamped_along(contact, $ku) {
        let end = contact_end_along(corner, $ku);
        let sign = end_sign(end);
        let speed = abs(along(flight.normals[$k].direction, point.state.v));
        let force = sign * motion.pressing[$k];
        let slope = sign * motion.pressing_rate[$k];
        let lossy = force * (1.0 - stops.restitution[$k][end.side]);
        let lost = HOPS * EPSILON * contact_extent(point, end);
        let completes = speed * speed <= corner_negligible(point, end) * lossy && -(slope * speed) <= STEADY * force * lossy;
        closes = closes && force > 0.0 && (completes || speed * speed <= lost * force);
    }
    //: end
    return select(CONTACT_FREE, corner, closes);
}

fn corner_is_near(point: Point, end: End) -> bool {
    return contact_gap_to(point, end) <= corner_negligible(point, end);
}

// The size of a gap that is left out.
fn corner_negligible(point: Point, end: End) -> f32 {
    return max(TOUCH * contact_extent(point, end), CHATTER * stops.unit);
}
