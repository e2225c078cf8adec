// Where a motion is along a contact normal: d·x and d·v.

struct Along {
    place: f32,
    speed: f32,
}

// The same along each normal.
alias Alongs = array<Along, NORMALS>;

fn along_of(point: Point, normal: u32) -> Along {
    let direction = flight.normals[normal].direction;
    return Along(along(direction, point.state.x), along(direction, point.state.v));
}

fn along_each(point: Point) -> Alongs {
    var each: Alongs;
    //: each normal
    each[$k] = along_of(point, $ku);
    //: end
    return each;
}

// Along one of them: a compiler keeps in memory what is read at an index that it does not know.
fn along_at(each: Alongs, normal: u32) -> Along {
    var own = each[0];
    //: each further normal
    own.place = select(own.place, each[$k].place, normal == $ku);
    own.speed = select(own.speed, each[$k].speed, normal == $ku);
    //: end
    return own;
}
