// The largest multiplier of a motion that returns, and where it goes, from the linear map of one turn.

// The monodromy matrix column by column, `n` forcing periods each; 0 where none is measured.
struct Turn {
    n: u32,
    columns: array<State, COMPONENTS>,
    exponent: f32,
    // How far the state was from its anchor before the last leap.
    missed: f32,
}

fn turn_over(n: u32) -> Turn {
    return Turn(n, array<State, COMPONENTS>(), EXPLODES, FARTHEST);
}

// Sees the tangent vector after `turns` ≥ 1 turns; with the `last` of them all columns are measured.
fn turn_complete(turns: u32, last: bool) {
    //: each component
    observer.turn.columns[$k] = state_select(observer.turn.columns[$k], tangent, turns == $ku + 1u);
    //: end
    if last {
        observer.turn.exponent = turn_measured();
    }
}

// ln of the spectral radius over n: the limit of ln ‖Mᵏ‖ / (kn).
fn turn_measured() -> f32 {
    var power = observer.turn.columns;
    var finite = true;
    //: each component
    finite = finite && state_is_finite(power[$k]);
    //: end
    if !finite {
        return EXPLODES;
    }
    var sum = 0.0;
    var share = 1.0;
    for (var k = 0u; k <= SQUARINGS; k++) {
        let size = turn_largest(power);
        let factor = 1.0 / size;
        // A long turn may leave nothing that is a number.
        if size == 0.0 || !is_finite(factor) {
            return FORGETS;
        }
        sum = sum + share * logarithm(size);
        //: each component
        power[$k] = state_scaled(factor, power[$k]);
        //: end
        power = turn_squared(power);
        share = 0.5 * share;
    }
    return sum / f32(observer.turn.n);
}

// Where a deviation that is added to itself, turned once, turned twice and so on ends, the more terms of it at a time as the
// matrix is squared.
fn turn_followed_for_ever(y: State) -> State {
    var power = observer.turn.columns;
    var sum = y;
    for (var k = 0u; k <= SQUARINGS; k++) {
        sum = state_plus(sum, 1.0, turn_applied(power, sum));
        if turn_largest(power) < EPSILON {
            break;
        }
        power = turn_squared(power);
    }
    return sum;
}

// The largest magnitude of an entry.
fn turn_largest(columns: array<State, COMPONENTS>) -> f32 {
    var size = 0.0;
    //: each component
    size = max(size, largest_of(columns[$k].x, columns[$k].v));
    //: end
    return size;
}

fn turn_squared(columns: array<State, COMPONENTS>) -> array<State, COMPONENTS> {
    var squared = columns;
    //: each component
    squared[$k] = turn_applied(columns, columns[$k]);
    //: end
    return squared;
}

// The matrix times a vector.
fn turn_applied(columns: array<State, COMPONENTS>, to: State) -> State {
    let weights = state_values(to);
    var sum = state_scaled(weights[0], columns[0]);
    //: each further component
    sum = state_plus(sum, weights[$k], columns[$k]);
    //: end
    return sum;
}
