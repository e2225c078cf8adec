// The gap to a stop along a leg, as the polynomial of fifth degree that agrees with it at both ends.

// Its coefficients.
struct Quintic {
    c0: f32,
    c1: f32,
    c2: f32,
    c3: f32,
    c4: f32,
    c5: f32,
}

// Where a gap is narrowest, how wide it is there, and its second derivative before the last of Newton's steps.
struct Narrowest {
    u: f32,
    gap: f32,
    bend: f32,
}

fn quintic_through(gaps: vec2<f32>, speeds: vec2<f32>, pulls: vec2<f32>, window: f32) -> Quintic {
    let square = window * window;
    let slope = -(speeds.x * window);
    let bend = -(pulls.x * square * 0.5);
    let place = gaps.y - gaps.x - slope - bend;
    let arrival = -(speeds.y * window) - slope - (bend + bend);
    let pull = (-(pulls.y * square) - (bend + bend)) * 0.5;
    return Quintic(
        gaps.x,
        slope,
        bend,
        place * 10.0 + (arrival * -4.0 + pull),
        place * -15.0 + (arrival * 7.0 + -(pull + pull)),
        place * 6.0 + (arrival * -3.0 + pull),
    );
}

// About where a gap, open at u = 0 and closed beyond u = 1, closes.
fn quintic_chord(gaps: vec2<f32>, approach: f32) -> f32 {
    let chord = gaps.y - gaps.x + approach;
    let discriminant = approach * approach + -(4.0 * chord * gaps.x);
    let sum = abs(approach) + sqrt(max(discriminant, 0.0));
    let approaching = 0.0 < approach;
    let above = select(sum, gaps.x + gaps.x, approaching);
    let below = select(-(chord + chord), sum, approaching);
    return above / below;
}

// Where the gap closes.
fn quintic_root(c: Quintic, start: f32) -> f32 {
    let twice = c.c2 + c.c2;
    let thrice = c.c3 * 3.0;
    let four = c.c4 * 4.0;
    let five = c.c5 * 5.0;
    var u = start;
    // By pairs of terms, which wait for each other less than one term after the other does.
    //: each newton step
    {
        let square = u * u;
        let value = ((c.c5 * u + c.c4) * square + (c.c3 * u + c.c2)) * square + (c.c1 * u + c.c0);
        let steep = (five * u + four) * square + (thrice * u + twice);
        u = u - value / (steep * u + c.c1);
    }
    //: end
    return u;
}

// Where the gap is narrowest if the motion comes near, turns and goes.
fn quintic_narrowest(c: Quintic, departure: f32) -> Narrowest {
    let twice = c.c2 + c.c2;
    let thrice = c.c3 * 3.0;
    let four = c.c4 * 4.0;
    let five = c.c5 * 5.0;
    let six = thrice + thrice;
    let twelve = four * 3.0;
    let twenty = five * 4.0;
    var u = c.c1 / (c.c1 + departure);
    var bend = twice;
    //: each newton step
    {
        let square = u * u;
        let steep = (five * u + four) * square + (thrice * u + twice);
        bend = (twenty * u + twelve) * square + (six * u + twice);
        u = u - (steep * u + c.c1) / bend;
    }
    //: end
    let square = u * u;
    let gap = ((c.c5 * u + c.c4) * square + (c.c3 * u + c.c2)) * square + (c.c1 * u + c.c0);
    return Narrowest(u, gap, bend);
}

// About where a gap that is closed there closes before.
fn narrowest_touch(narrowest: Narrowest) -> f32 {
    return narrowest.u - sqrt(max(-(narrowest.gap + narrowest.gap) / narrowest.bend, 0.0));
}
