// Whether the motion is stationary: the spread of its strobe points early in the observation against that late in it.

struct Moments {
    sum: State,
    square: f32,
}

struct Spread {
    about: State,
    early: Moments,
    late: Moments,
}

fn spread_about(point: Point) -> Spread {
    let none = Moments(State(X(0.0), X(0.0)), 0.0);
    return Spread(point.state, none, none);
}

// With one more point, if that belongs to them.
fn moments_with(moments: Moments, away: State, belongs: bool) -> Moments {
    let sum = state_select(moments.sum, state_plus(moments.sum, 1.0, away), belongs);
    return Moments(sum, select(moments.square, moments.square + state_square(away), belongs));
}

fn spread_at_strobe(point: Point, late: bool) {
    let away = state_plus(point.state, -1.0, observer.spread.about);
    observer.spread.early = moments_with(observer.spread.early, away, !late);
    observer.spread.late = moments_with(observer.spread.late, away, late);
}

fn moments_variance(moments: Moments, count: f32) -> f32 {
    return moments.square / count - state_square(State(moments.sum.x / count, moments.sum.v / count));
}

fn spread_is_stationary(half: u32) -> bool {
    let count = f32(half);
    let early = moments_variance(observer.spread.early, count);
    let late = moments_variance(observer.spread.late, count);
    return early <= STATIONARY * late && late <= STATIONARY * early;
}
