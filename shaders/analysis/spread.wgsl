// Is the motion stationary? The spread of its strobe points, early against late.

struct Moments {
    x2: f32,
    v2: f32,
    square: f32,
}

struct Spread {
    x2: f32,
    v2: f32,
    early: Moments,
    late: Moments,
}

fn spread_about(point: Point) -> Spread {
    let none = Moments(0.0, 0.0, 0.0);
    return Spread(point.x2, point.v2, none, none);
}

fn moments_with(moments: Moments, x2: f32, v2: f32) -> Moments {
    return Moments(moments.x2 + x2, moments.v2 + v2, moments.square + (x2 * x2 + v2 * v2));
}

fn spread_at_strobe(point: Point, late: bool) {
    let x2 = point.x2 - observer.spread.x2;
    let v2 = point.v2 - observer.spread.v2;
    if late {
        observer.spread.late = moments_with(observer.spread.late, x2, v2);
    } else {
        observer.spread.early = moments_with(observer.spread.early, x2, v2);
    }
}

fn moments_variance(moments: Moments, count: f32) -> f32 {
    let x2 = moments.x2 / count;
    let v2 = moments.v2 / count;
    return moments.square / count - (x2 * x2 + v2 * v2);
}

fn spread_is_stationary(half: u32) -> bool {
    let count = f32(half);
    let early = moments_variance(observer.spread.early, count);
    let late = moments_variance(observer.spread.late, count);
    return early <= STATIONARY * late && late <= STATIONARY * early;
}
