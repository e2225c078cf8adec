// The gap to a stop along a leg, as the polynomial of fifth degree that agrees with it at both ends.

// Where the gap, open at u = 0 and closed beyond u = 1, closes.
fn quintic_root(gaps: vec2<f32>, speeds: vec2<f32>, pulls: vec2<f32>, window: f32) -> f32 {
    let square = window * window;
    let slope = -(speeds.x * window);
    let bend = -(pulls.x * square * 0.5);
    let place = gaps.y - gaps.x - slope - bend;
    let arrival = -(speeds.y * window) - slope - (bend + bend);
    let pull = (-(pulls.y * square) - (bend + bend)) * 0.5;
    let c3 = place * 10.0 + (arrival * -4.0 + pull);
    let c4 = place * -15.0 + (arrival * 7.0 + -(pull + pull));
    let c5 = place * 6.0 + (arrival * -3.0 + pull);

    let approach = speeds.x * window;
    let chord = gaps.y - gaps.x + approach;
    let discriminant = approach * approach + -(4.0 * chord * gaps.x);
    let sum = abs(approach) + sqrt(max(discriminant, 0.0));
    let approaching = 0.0 < approach;
    let above = select(sum, gaps.x + gaps.x, approaching);
    let below = select(-(chord + chord), sum, approaching);
    var u = above / below;
    let twice = bend + bend;
    let thrice = c3 * 3.0;
    let four = c4 * 4.0;
    let five = c5 * 5.0;
    // By pairs of terms, which wait for each other less than one term after the other does.
    //: each newton step
    {
        let v = u * u;
        let value = ((c5 * u + c4) * v + (c3 * u + bend)) * v + (slope * u + gaps.x);
        let steep = (five * u + four) * v + (thrice * u + twice);
        u = u - value / (steep * u + slope);
    }
    //: end
    return u;
}
