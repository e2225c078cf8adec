// The largest Lyapunov exponent, with a standard error.

struct Exponent {
    batch_periods: u32,
    aligning: u32,
    filled: u32,
    growth: f32,
    batches: u32,
    sum: f32,
    squares: f32,
}

fn exponent_over(observe: u32) -> Exponent {
    let batches = min(observe, BATCHES);
    return Exponent(observe / batches, batches / ALIGNING, 0u, 0.0, 0u, 0.0, 0.0);
}

// Counts a period, and measures what the tangent vector has grown by where a batch ends, where that is `asked` for, and where it is far
// from unit length: it is brought back to that then. Otherwise it is left to grow. The growth that was measured, 0 where none was.
fn exponent_at_strobe(asked: bool) -> f32 {
    let square = state_square(tangent);
    let far = !tangent_may_be_left(square);
    let ends = observer.exponent.filled + 1u >= observer.exponent.batch_periods;
    var growth = 0.0;
    if far | ends | asked {
        growth = tangent_bring_back(square);
    }
    exponent_add(growth);
    return growth;
}

// Adds the growth of one period (or iterate), ln of a factor.
fn exponent_add(growth: f32) {
    observer.exponent.growth = observer.exponent.growth + growth;
    observer.exponent.filled = observer.exponent.filled + 1u;
    if observer.exponent.filled < observer.exponent.batch_periods {
        return;
    }
    if observer.exponent.aligning > 0u {
        observer.exponent.aligning = observer.exponent.aligning - 1u;
    } else {
        let batch = observer.exponent.growth;
        observer.exponent.batches = observer.exponent.batches + 1u;
        observer.exponent.sum = observer.exponent.sum + batch;
        observer.exponent.squares = observer.exponent.squares + batch * batch;
    }
    observer.exponent.filled = 0u;
    observer.exponent.growth = 0.0;
}

fn exponent_per_period() -> f32 {
    return observer.exponent.sum / f32(observer.exponent.batches * observer.exponent.batch_periods);
}

fn exponent_standard_error() -> f32 {
    let count = f32(observer.exponent.batches);
    let mean = observer.exponent.sum / count;
    let variance = max(observer.exponent.squares / count - mean * mean, 0.0);
    return sqrt(variance / count) / f32(observer.exponent.batch_periods);
}
