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

// Whether every component is a finite number, and together they are within BOUNDLESS.
fn state_is_bounded(state: State) -> bool {
    return state_is_finite(state) && state_square(state) < BOUNDLESS;
}

// The square of the Euclidean length.
fn state_square(state: State) -> f32 {
    return squares(state.x, state.v);
}

// The cell that this invocation works on.
var<private> cell: u32;
// Where the constants of its flow lie, which it shares with cells that differ in gaps and restitutions alone.
var<private> flow: u32;

// The constants, gaps and restitutions of the cell, in memory of the invocation: a compiler keeps in registers what is read often
// of them, and the rest lies so that neighbours read it together. In a buffer each would be read anew wherever it is used.
var<private> flight: Flight;
var<private> stops: Cell;
// Normal by normal: a compiler makes a choice of every place that an index which it does not know may mean.
var<private> normal_terms: array<array<State, NORMAL_TERMS>, NORMALS>;

// What a kernel calls when it knows its cell.
fn flight_load() {
    flow = cells[cell].flow;
    flight = flights[flow];
    stops = cells[cell];
    for (var term = 0u; term < NORMAL_TERMS; term++) {
        for (var normal = 0u; normal < NORMALS; normal++) {
            normal_terms[normal][term] = kicks[flow * NORMALS + normal][term];
        }
    }
}

// The shortest move that is made under contacts, where nothing is met: its square is lost in rounding.
fn flight_least() -> f32 {
    return flight.h * SQRT_EPSILON;
}

// How far, and how fast, masses may be carried at all: the largest of the unit, of what forces do, and of the gaps.
fn flight_reach() -> f32 {
    var reach = max(flights[flow].forced, stops.unit);
    //: each normal
    let upper$k = abs(stops.gap[$k][0]);
    reach = max(reach, select(0.0, upper$k, upper$k < FAR));
    let lower$k = abs(stops.gap[$k][1]);
    reach = max(reach, select(0.0, lower$k, lower$k < FAR));
    //: end
    return reach;
}

// A term of the polynomials of a normal: what a kick becomes, then what the end of a step says of the way to it.
fn normal_term(normal: u32, term: u32) -> State {
    return normal_terms[normal][term];
}
