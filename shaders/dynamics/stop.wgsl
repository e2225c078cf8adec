// Stops, and which of them are in contact: bit k for the upper end of normal k, bit k + MOST for its lower end.

// An end of a contact normal: side 0 is met where d·x grows, side 1 where it falls.
struct End {
    normal: u32,
    side: u32,
}

fn end_sign(end: End) -> f32 {
    return select(-1.0, 1.0, end.side == 0u);
}

fn contact_with(contact: u32, end: End) -> u32 {
    return contact | (1u << (end.normal + MOST * end.side));
}

fn contact_without(contact: u32, normal: u32) -> u32 {
    return contact & ~((1u << normal) | (1u << (normal + MOST)));
}

// The normals that hold, bit by bit.
fn contact_held(contact: u32) -> u32 {
    return (contact | (contact >> MOST)) & ((1u << MOST) - 1u);
}

fn contact_with_opposite_ends(contact: u32) -> u32 {
    let held = contact_held(contact);
    return held | (held << MOST);
}

fn contact_includes(contact: u32, end: End) -> bool {
    return ((contact >> (end.normal + MOST * end.side)) & 1u) == 1u;
}

fn contact_is_clamped_along(contact: u32, normal: u32) -> bool {
    return (((contact >> normal) & (contact >> (normal + MOST))) & 1u) == 1u;
}

// Whether a normal holds with a contact that can open: both ends together clamp the masses for ever.
fn contact_opens_along(contact: u32, normal: u32) -> bool {
    return (contact_held(contact) >> normal & 1u) == 1u && !contact_is_clamped_along(contact, normal);
}

// Whether some normal holds at both ends.
fn contact_is_clamped(contact: u32) -> bool {
    return (contact & (contact >> MOST)) != 0u;
}

// Whether every contact is one that is clamped.
fn contact_is_clamped_only(contact: u32) -> bool {
    return contact != CONTACT_FREE && (contact & ((1u << MOST) - 1u)) == (contact >> MOST);
}

// The end at which a normal holds, the upper one where it is clamped; it must hold.
fn contact_end_along(contact: u32, normal: u32) -> End {
    return End(normal, select(1u, 0u, contact_includes(contact, End(normal, 0u))));
}
