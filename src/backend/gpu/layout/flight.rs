//! The constants of a flow, and what a cell has beside them: one list of members each says how the shader declares them and
//! how they are written.

use crate::backend::gpu::shader::Shape;
use crate::model::{ContactNormal, Flight, Real, State, StopsAlong};

/// Terms of the kick polynomial in f32: up to its order.
pub const KICK_TERMS: usize = <f32 as Real>::KICK_ORDER + 1;

/// Takes the members of a struct in their order.
trait Members<const N: usize> {
    fn number(&mut self, name: &str, value: f32);
    fn integer(&mut self, name: &str, value: u32);
    fn numbers(&mut self, name: &str, values: &[f32]);
    fn integers(&mut self, name: &str, values: &[u32]);
    fn pairs(&mut self, name: &str, values: &[[f32; 2]]);
    /// Fills up to the alignment of vectors.
    fn align(&mut self);
    fn vector(&mut self, name: &str, value: &[f32; N]);
    fn vectors(&mut self, name: &str, values: &[[f32; N]; N]);
    fn state(&mut self, name: &str, value: &State<f32, N>);
    fn states(&mut self, name: &str, values: &[State<f32, N>; N]);
}

/// Scalars first, then vectors, so that no member needs padding but those of vectors themselves.
fn flight_members<const N: usize>(flight: &Flight<f32, N>, members: &mut impl Members<N>) {
    members.integer("steps", flight.steps);
    members.integer("quiet_exists", u32::from(flight.quiet.exists));
    members.integer("quiet_decays", u32::from(flight.quiet.decays));
    members.integer("mirror_exists", u32::from(flight.mirror.is_some()));
    members.number("h", flight.h);
    members.number("inverse_h", flight.inverse_h);
    members.number("turn_sin", flight.turn_sin);
    members.number("turn_cos", flight.turn_cos);
    members.number("omega", flight.omega);
    members.number("rate", flight.rate);
    members.number("linear_exponent", flight.linear_exponent);
    if flight.count > 1 {
        members.numbers("pressing", &pressing(flight));
    }
    members.align();
    members.states("phi_x", &flight.phi_x);
    members.states("phi_v", &flight.phi_v);
    members.state("gamma_sin", &flight.gamma_sin);
    members.state("gamma_cos", &flight.gamma_cos);
    members.state("gamma_one", &flight.gamma_one);
    members.vectors("stiffness", &flight.stiffness);
    members.vectors("damping", &flight.damping);
    members.vector("sin", &flight.sin);
    members.vector("cos", &flight.cos);
    members.vector("load", &flight.load);
    members.state("quiet_forced", &flight.quiet.forced);
    members.vectors("quiet_xx", &flight.quiet.xx);
    members.vectors("quiet_xv", &flight.quiet.xv);
    members.vectors("quiet_vv", &flight.quiet.vv);
    members.vectors("mirror", &flight.mirror.unwrap_or([[0.0; N]; N]));
}

/// What [`Flight::pressing`] says for every set of contacts but none, row by row.
fn pressing<const N: usize>(flight: &Flight<f32, N>) -> Vec<f32> {
    let count = flight.count;
    (1..1 << count)
        .flat_map(|set| (0..count).flat_map(move |s| (0..count).map(move |t| flight.pressing[set][s][t])))
        .collect()
}

fn normal_members<const N: usize>(normal: &ContactNormal<f32, N>, members: &mut impl Members<N>) {
    members.integers("stop", &normal.stop.map(u32::from));
    members.numbers("reach", &normal.reach);
    members.number("bound_forcing", normal.bound_forcing);
    members.number("drag", normal.drag);
    members.number("coupling", normal.coupling);
    members.number("stretch", normal.stretch);
    members.number("mass", normal.mass);
    members.align();
    members.vector("direction", &normal.direction);
    members.vector("response", &normal.response);
    members.vector("bound_x", &normal.bound_x);
    members.vector("bound_v", &normal.bound_v);
}

/// What a cell has beside its flow: the stops at both ends of each normal, and the start.
fn cell_members<const N: usize>(
    flow: u32,
    stops: &[StopsAlong],
    start: &[f64],
    members: &mut impl Members<N>,
) {
    let ends =
        |of: fn(&StopsAlong) -> [f64; 2]| stops.iter().map(|s| of(s).map(|v| v as f32)).collect::<Vec<_>>();
    members.integer("flow", flow);
    members.pairs("gap", &ends(|along| along.gap));
    members.pairs("restitution", &ends(|along| along.restitution));
    members.numbers("start", &start.iter().map(|&value| value as f32).collect::<Vec<_>>());
}

/// Writes WGSL declarations.
#[derive(Default)]
struct Declaration {
    text: String,
    words: usize,
    fillers: usize,
}

impl Declaration {
    fn member(&mut self, name: &str, kind: &str) {
        self.text.push_str(&format!("    {name}: {kind},\n"));
    }
}

impl<const N: usize> Members<N> for Declaration {
    fn number(&mut self, name: &str, _: f32) {
        self.member(name, "f32");
        self.words += 1;
    }

    fn integer(&mut self, name: &str, _: u32) {
        self.member(name, "u32");
        self.words += 1;
    }

    fn numbers(&mut self, name: &str, values: &[f32]) {
        self.member(name, &format!("array<f32, {}>", values.len()));
        self.words += values.len();
    }

    fn integers(&mut self, name: &str, values: &[u32]) {
        self.member(name, &format!("array<u32, {}>", values.len()));
        self.words += values.len();
    }

    fn pairs(&mut self, name: &str, values: &[[f32; 2]]) {
        self.member(name, &format!("array<array<f32, 2>, {}>", values.len()));
        self.words += 2 * values.len();
    }

    fn align(&mut self) {
        while !self.words.is_multiple_of(vector_words::<N>()) {
            let name = format!("unused{}", self.fillers);
            self.member(&name, "u32");
            self.fillers += 1;
            self.words += 1;
        }
    }

    fn vector(&mut self, name: &str, _: &[f32; N]) {
        self.member(name, "X");
    }

    fn vectors(&mut self, name: &str, _: &[[f32; N]; N]) {
        self.member(name, "array<X, COORDINATES>");
    }

    fn state(&mut self, name: &str, _: &State<f32, N>) {
        self.member(name, "State");
    }

    fn states(&mut self, name: &str, _: &[State<f32, N>; N]) {
        self.member(name, "array<State, COORDINATES>");
    }
}

/// Writes the values, word by word.
struct Values<'a>(&'a mut Vec<u32>);

impl<const N: usize> Members<N> for Values<'_> {
    fn number(&mut self, _: &str, value: f32) {
        self.0.push(value.to_bits());
    }

    fn integer(&mut self, _: &str, value: u32) {
        self.0.push(value);
    }

    fn numbers(&mut self, _: &str, values: &[f32]) {
        self.0.extend(values.iter().map(|value| value.to_bits()));
    }

    fn integers(&mut self, _: &str, values: &[u32]) {
        self.0.extend(values);
    }

    fn pairs(&mut self, _: &str, values: &[[f32; 2]]) {
        self.0.extend(values.as_flattened().iter().map(|value| value.to_bits()));
    }

    fn align(&mut self) {
        while !self.0.len().is_multiple_of(vector_words::<N>()) {
            self.0.push(0);
        }
    }

    fn vector(&mut self, _: &str, value: &[f32; N]) {
        self.0.extend(value.iter().map(|value| value.to_bits()));
        <Self as Members<N>>::align(self);
    }

    fn vectors(&mut self, name: &str, values: &[[f32; N]; N]) {
        values.iter().for_each(|value| self.vector(name, value));
    }

    fn state(&mut self, name: &str, value: &State<f32, N>) {
        self.vector(name, &value.x);
        self.vector(name, &value.v);
    }

    fn states(&mut self, name: &str, values: &[State<f32, N>; N]) {
        values.iter().for_each(|value| self.state(name, value));
    }
}

/// Words from one vector to the next in a buffer.
const fn vector_words<const N: usize>() -> usize {
    if N == 3 { 4 } else { N }
}

/// The structs `ContactNormal`, `Flight` and `Cell` as the shader declares them.
pub fn declarations<const N: usize>(shape: &Shape) -> String {
    let none = Flight::<f32, N>::blank(shape.normals, 0.0);
    let mut normal = Declaration::default();
    normal_members(&none.normals[0], &mut normal);
    let mut flight = Declaration::default();
    flight_members(&none, &mut flight);
    let mut cell = Declaration::default();
    let stops = vec![StopsAlong::default(); shape.normals];
    cell_members::<N>(0, &stops, &vec![0.0; 2 * N], &mut cell);
    format!(
        "struct ContactNormal {{\n{}}}\n\nstruct Flight {{\n{}    normals: array<ContactNormal, NORMALS>,\n}}\n\n\
         struct Cell {{\n{}}}\n",
        normal.text, flight.text, cell.text
    )
}

/// What a cell has beside its flow, as the shader reads it.
pub fn write_cell<const N: usize>(flow: u32, stops: &[StopsAlong], start: &[f64], into: &mut Vec<u32>) {
    cell_members::<N>(flow, stops, start, &mut Values(into));
}

/// The constants of a flow as the shader reads them.
pub fn write_flight<const N: usize>(flight: &Flight<f32, N>, into: &mut Vec<u32>) {
    flight_members(flight, &mut Values(into));
    for normal in flight.normals() {
        normal_members(normal, &mut Values(into));
    }
}

/// The kick polynomials of a flow, normal by normal.
pub fn write_kicks<const N: usize>(flight: &Flight<f32, N>, into: &mut Vec<u32>) {
    for normal in flight.normals() {
        for term in &normal.kick[..KICK_TERMS] {
            Values(into).state("", term);
        }
    }
}
