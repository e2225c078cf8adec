// A part of a step, with the contacts that hold.

// Moves on for a time within the step, with the present contacts.
fn glide(carry: bool, time: f32) {
    glide_to(carry, glided(time), time);
}

// Where it is a time later within the step, with the present contacts.
fn glided(time: f32) -> Point {
    var point = point_flown(trajectory.point, time, trajectory.contact);
    point.state = rested(point.state, trajectory.contact);
    return point;
}

// Moves on to where it is a time later within the step, with the present contacts.
fn glide_to(carry: bool, point: Point, time: f32) {
    trajectory.point = point;
    if carry && trajectory.under_way == 0u {
        tangent = tangent_flown(tangent, time, trajectory.contact);
    }
    trajectory.offset = trajectory.offset + time;
}
