// Displacements and velocities, and the cell whose constants are flown with.

struct State {
    x: X,
    v: X,
}

// state + a other.
fn state_plus(state: State, a: f32, other: State) -> State {
    return State(state.x + a * other.x, state.v + a * other.v);
}

// The sum of the products of the components.
fn state_dot(a: State, b: State) -> f32 {
    return along(a.x, b.x) + along(a.v, b.v);
}

fn state_scaled(a: f32, state: State) -> State {
    return State(a * state.x, a * state.v);
}

// `yes` where the condition holds, else `no`.
fn state_select(no: State, yes: State, condition: bool) -> State {
    return State(select(no.x, yes.x, condition), select(no.v, yes.v, condition));
}

fn state_is_finite(state: State) -> bool {
    return are_finite(state.x) && are_finite(state.v);
}

// The square of the Euclidean length.
fn state_square(state: State) -> f32 {
    return squares(state.x, state.v);
}

// The cell that this invocation works on.
var<private> cell: u32;
// Where the constants of its flow lie, which it shares with cells that differ in gaps and restitutions alone.
var<private> flow: u32;
