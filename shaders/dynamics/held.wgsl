// What contacts that hold take from accelerations and their derivatives.

// What contacts leave of accelerations, and what presses on each.
struct Held {
    rest: X,
    pressing: array<f32, NORMALS>,
}

// Accelerations (or their derivatives) with what the contacts that hold take from them, and what presses on each.
fn held(contact: u32, free: X) -> Held {
    var pressing = array<f32, NORMALS>();
    if contact == CONTACT_FREE {
        return Held(free, pressing);
    }
    let contacts = contact_held(contact);
    //: each normal
    let along$k = along(flight.normals[$k].direction, free);
    //: end
    //: each pair of normals
    pressing[$k] = pressing[$k] + pressing_share(contacts, $ku, $lu) * along$l;
    //: end
    var rest = free;
    //: each normal
    rest = rest - pressing[$k] * flight.normals[$k].response;
    //: end
    return Held(rest, pressing);
}

// What the contacts that hold spare of accelerations, or of what adds up to them: nothing where there are as many as coordinates.
fn spared(contact: u32, free: X) -> X {
    if countOneBits(contact_held(contact)) == COORDINATES {
        return X(0.0);
    }
    return held(contact, free).rest;
}
