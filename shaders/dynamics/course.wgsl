// How a step of free flight goes along a contact normal: d·x, a polynomial in what is left of the step, from the step's end.

// The coefficients of uᵏ, u being the share of the step that is left; what d·x is at the end of the step is not asked.
struct Course {
    terms: array<f32, BACK_TERMS>,
}

// The course about a time: what multiplies wᵏ when u changes by w, up to the fourth power.
struct Here {
    place: f32,
    slope: f32,
    bend: f32,
    twist: f32,
    last: f32,
}

// Of the step that ends at a point, with a `speed` along one normal, as it would go without another impact.
fn course_to(end: Point, speed: f32, normal: u32) -> Course {
    var course: Course;
    course.terms[1] = -(speed * flight.h);
    //: each bend term
    course.terms[$k] = course_term(end, normal, $ku);
    //: end
    return course;
}

fn course_term(end: Point, normal: u32, term: u32) -> f32 {
    let of_places = flight.normals[normal].back_x[term];
    let of_speeds = flight.normals[normal].back_v[term];
    var sum = end.sin * course_of_sine(normal, term) + flight.normals[normal].back_one[term];
    sum = end.cos * course_of_cosine(normal, term) + sum;
    //: each coordinate
    sum = end.state.x$c * of_places$c + sum;
    //: end
    //: each coordinate
    sum = end.state.v$c * of_speeds$c + sum;
    //: end
    return sum;
}

// What the sine of the forcing phase multiplies.
fn course_of_sine(normal: u32, term: u32) -> f32 {
    return flight.normals[normal].back_sin[term];
}

// What its cosine multiplies.
fn course_of_cosine(normal: u32, term: u32) -> f32 {
    return flight.normals[normal].back_cos[term];
}

// What multiplies u² and u³.
fn course_bends(course: Course) -> vec2<f32> {
    return vec2(course.terms[2], course.terms[3]);
}

// About where the share u is left, on the way from a `place` where the share `since` was: by the quotient of Horner's scheme there,
// its quotient, and so on.
fn course_about(course: Course, u: f32, since: f32, place: f32) -> Here {
    var quotient = 0.0;
    var slopes = Here(0.0, 0.0, 0.0, 0.0, 0.0);
    //: each slope term
    quotient = quotient * since + course.terms[$k];
    slopes = Here(
        slopes.place * u + quotient,
        slopes.slope * u + slopes.place,
        slopes.bend * u + slopes.slope,
        slopes.twist * u + slopes.bend,
        slopes.last * u + slopes.twist,
    );
    //: end
    let way = u - since;
    return Here(
        way * slopes.place + place,
        way * slopes.slope + slopes.place,
        way * slopes.bend + slopes.slope,
        way * slopes.twist + slopes.bend,
        way * slopes.last + slopes.twist,
    );
}

// Where the motion is along each normal with the share u of the step left, `own` along the one that is met, on the way from where it
// was `before`, with the share `since`.
fn course_each(before: Alongs, end: Point, u: f32, since: f32, normal: u32, own: Along) -> Alongs {
    var each: Alongs;
    //: each normal
    each[$k] = own;
    //: end
    if NORMALS > 1u {
        //: each normal
        if $ku != normal {
            each[$k] = here_along(course_about(course_to(end, along_of(end, $ku).speed, $ku), u, since, before[$k].place));
        }
        //: end
    }
    return each;
}

fn here_along(here: Here) -> Along {
    return Along(here.place, -(here.slope * flight.inverse_h));
}

// By how much the share changes that is left until d·x is at a place near by.
fn here_change_to(here: Here, place: f32) -> f32 {
    let left = place - here.place;
    let inverse = 1.0 / here.slope;
    let straight = left * inverse;
    let bent = here.bend * inverse * straight;
    let nearly = ((bent + bent) * bent + -bent) * straight + straight;
    let far = (here.twist * nearly + here.bend) * nearly + here.slope;
    let steep = ((here.twist * 3.0) * nearly + (here.bend + here.bend)) * nearly + here.slope;
    return nearly - (far * nearly + -left) / steep;
}

// About the place after such a change, up to the second power.
fn here_changed(here: Here, w: f32) -> Here {
    let first = here.last * w + here.twist;
    let second = first * w + here.bend;
    let third = second * w + here.slope;
    let fourth = here.last * w + first;
    let fifth = fourth * w + second;
    return Here(third * w + here.place, fifth * w + third, (here.last * w + fourth) * w + fifth, 0.0, 0.0);
}

// d·x''.
fn here_pull(here: Here) -> f32 {
    return (here.bend + here.bend) * (flight.inverse_h * flight.inverse_h);
}
