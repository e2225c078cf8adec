// The Taylor series of flight: one recurrence for motions and deviations.

// The unforced part of V(k+1) = s² K V(k-1) + s C V(k) (+ forcing), V(k) = v^(k) s^k for both masses.
struct Series {
    spring0: vec2<f32>,
    spring1: vec2<f32>,
    damper0: vec2<f32>,
    damper1: vec2<f32>,
    times: vec2<f32>,
    reach: f32,
}

fn series_new(s: f32, free: f32) -> Series {
    let damper = flight.inverse_mass * flight.coupling_damping;
    let first = s * free;
    let square = s * s;
    let spring = s * first;
    let damping = first * flight.coupling_damping;
    return Series(
        vec2(-spring, square * flight.inverse_mass),
        vec2(spring, -(square * (flight.inverse_mass + flight.ground_stiffness))),
        vec2(-damping, s * damper),
        vec2(damping, -(s * (damper + flight.ground_damping))),
        vec2(first, s),
        flight.rate * s,
    );
}

// V(1) from the displacements and V(0), the velocities.
fn series_first(series: Series, x: vec2<f32>, v: vec2<f32>) -> vec2<f32> {
    let stretch = x.y - x.x;
    let springs = vec2(stretch, -(flight.inverse_mass * stretch) - flight.ground_stiffness * x.y);
    let damped = v.x * series.damper0 + v.y * series.damper1;
    return damped + series.times * springs;
}

// V(k+1) from V(k-1), V(k) and what the forcing adds.
fn series_next(series: Series, before: vec2<f32>, last: vec2<f32>, forced: vec2<f32>) -> vec2<f32> {
    let known = (forced + before.x * series.spring0) + before.y * series.spring1;
    return known + (last.x * series.damper0 + last.y * series.damper1);
}
