// The largest multiplier of a settled motion, from the linear map of one turn.

// The monodromy matrix column by column, `n` forcing periods each; 0 where none is measured.
struct Turn {
    n: u32,
    columns: array<State, COMPONENTS>,
    exponent: f32,
}

fn turn_over(n: u32) -> Turn {
    return Turn(n, array<State, COMPONENTS>(), EXPLODES);
}

// Sees the tangent vector after `turns` ≥ 1 turns.
fn turn_complete(turns: u32) {
    //: each component
    if turns == $ku + 1u {
        observer.turn.columns[$k] = tangent;
    }
    //: end
    if turns == COMPONENTS {
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
        var size = 0.0;
        //: each component
        size = max(size, largest_of(power[$k].x, power[$k].v));
        //: end
        if size == 0.0 {
            return FORGETS;
        }
        sum = sum + share * logarithm(size);
        let factor = 1.0 / size;
        //: each component
        power[$k] = state_scaled(factor, power[$k]);
        //: end
        let scaled = power;
        //: each component
        power[$k] = turn_applied(scaled, scaled[$k]);
        //: end
        share = 0.5 * share;
    }
    return sum / f32(observer.turn.n);
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
