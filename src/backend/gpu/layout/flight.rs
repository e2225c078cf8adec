//! The constants of a flow, and what a cell has beside them: one list of members each says how the shader declares them and
//! how they are written.

use std::fmt::Display;

use crate::backend::gpu::shader::Shape;
use crate::model::{Bound, ContactNormal, Flight, OTHERS, Real, State, Step, StopsAlong, sets_of_others};

/// Terms of the polynomial of an impact in f32: up to its order.
pub const KICK_TERMS: usize = <f32 as Real>::KICK_ORDER + 1;

/// Terms of the polynomials of the way to the end of a step in f32.
pub const BACK_TERMS: usize = <f32 as Real>::BACK_ORDER + 1;

/// Terms of both polynomials of a normal: its wake and its look back.
pub const NORMAL_TERMS: usize = KICK_TERMS + BACK_TERMS;

/// Writes the members of a struct in their order: their words and, where wanted, their declarations in WGSL.
struct Members<'a, const N: usize> {
    words: &'a mut Vec<u32>,
    declared: Option<&'a mut String>,
}

impl<const N: usize> Members<'_, N> {
    fn member(&mut self, name: impl Display, kind: impl Display, words: impl IntoIterator<Item = u32>) {
        if let Some(text) = &mut self.declared {
            text.push_str(&format!("    {name}: {kind},\n"));
        }
        self.words.extend(words);
    }

    fn number(&mut self, name: &str, value: f32) {
        self.member(name, "f32", [value.to_bits()]);
    }

    fn integer(&mut self, name: &str, value: u32) {
        self.member(name, "u32", [value]);
    }

    fn numbers(&mut self, name: &str, values: impl ExactSizeIterator<Item = f32>) {
        let kind = format_args!("array<f32, {}>", values.len());
        self.member(name, kind, values.map(f32::to_bits));
    }

    fn integers(&mut self, name: &str, values: &[u32]) {
        self.member(name, format_args!("array<u32, {}>", values.len()), values.iter().copied());
    }

    fn pairs(&mut self, name: &str, values: impl ExactSizeIterator<Item = [f64; 2]>) {
        let kind = format_args!("array<array<f32, 2>, {}>", values.len());
        self.member(name, kind, values.flat_map(|pair| pair.map(|value| (value as f32).to_bits())));
    }

    /// Fills up to the alignment of vectors.
    fn align(&mut self) {
        let missing = self.words.len().next_multiple_of(vector_words::<N>()) - self.words.len();
        (0..missing).for_each(|filler| self.member(format_args!("unused{filler}"), "u32", [0]));
    }

    fn vector(&mut self, name: &str, value: &[f32; N]) {
        self.aligned(name, "X", [value]);
    }

    fn vectors(&mut self, name: &str, values: &[[f32; N]; N]) {
        self.aligned(name, "array<X, COORDINATES>", values);
    }

    fn rows<'v>(&mut self, name: &str, rows: impl ExactSizeIterator<Item = &'v [f32; N]>) {
        self.aligned(name, format_args!("array<X, {}>", rows.len()), rows);
    }

    fn state(&mut self, name: &str, State { x, v }: &State<f32, N>) {
        self.aligned(name, "State", [x, v]);
    }

    fn states(&mut self, name: &str, values: &[State<f32, N>; N]) {
        self.aligned(name, "array<State, COORDINATES>", values.iter().flat_map(|State { x, v }| [x, v]));
    }

    fn step(&mut self, before: &str, step: &Step<f32, N>) {
        self.states(&format!("{before}phi_x"), &step.phi_x);
        self.states(&format!("{before}phi_v"), &step.phi_v);
        self.state(&format!("{before}gamma_sin"), &step.gamma_sin);
        self.state(&format!("{before}gamma_cos"), &step.gamma_cos);
        self.state(&format!("{before}gamma_one"), &step.gamma_one);
    }

    /// Vectors, each up to the alignment of the next.
    fn aligned<'v>(
        &mut self,
        name: &str,
        kind: impl Display,
        vectors: impl IntoIterator<Item = &'v [f32; N]>,
    ) {
        self.member(name, kind, []);
        for vector in vectors {
            self.words.extend(vector.iter().map(|value| value.to_bits()));
            self.words.resize(self.words.len().next_multiple_of(vector_words::<N>()), 0);
        }
    }
}

/// Scalars first, then vectors, so that no member needs padding but those of vectors themselves.
fn flight_members<const N: usize>(flight: &Flight<f32, N>, members: &mut Members<N>) {
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
    members.number("forced", flight.forced);
    if flight.count > 1 {
        members.numbers("pressing", pressing(flight).into_iter());
    }
    let pressed = by_sets(flight, |normal| &normal.pressed);
    let sixth = by_sets(flight, |normal| &normal.sixth);
    members.numbers("pressed_forcing", pressed.iter().map(|bound| bound.forcing));
    members.numbers("sixth_forcing", sixth.iter().map(|bound| bound.forcing));
    members.align();
    members.step("", &flight.step);
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
    members.rows("pressed_x", pressed.iter().map(|bound| &bound.x));
    members.rows("pressed_v", pressed.iter().map(|bound| &bound.v));
    members.rows("sixth_x", sixth.iter().map(|bound| &bound.x));
    members.rows("sixth_v", sixth.iter().map(|bound| &bound.v));
}

/// What [`Flight::pressing`] says for every set of contacts but none, row by row.
fn pressing<const N: usize>(flight: &Flight<f32, N>) -> Vec<f32> {
    let count = flight.count;
    (1..1 << count)
        .flat_map(|set| (0..count).flat_map(move |s| (0..count).map(move |t| flight.pressing[set][s][t])))
        .collect()
}

/// Bounds by sets of contacts, those that there are, normal by normal.
fn by_sets<const N: usize>(
    flight: &Flight<f32, N>,
    bounds: impl Fn(&ContactNormal<f32, N>) -> &[Bound<f32, N>; OTHERS],
) -> Vec<Bound<f32, N>> {
    let sets = sets_of_others(flight.count);
    flight.normals().iter().flat_map(|normal| &bounds(normal)[..sets]).copied().collect()
}

/// What the course of a step is found with stands here, and again among the [`write_kicks`] that a tangent is met with: a compiler
/// would keep what is read twice in registers in between.
fn normal_members<const N: usize>(normal: &ContactNormal<f32, N>, members: &mut Members<N>) {
    members.integers("stop", &normal.stop.map(u32::from));
    members.numbers("reach", normal.reach.into_iter());
    members.number("bound_forcing", normal.bound.forcing);
    members.number("drag", normal.drag);
    members.number("coupling", normal.coupling);
    members.number("stretch", normal.stretch);
    members.number("mass", normal.mass);
    let back = || normal.back[..BACK_TERMS].iter();
    members.numbers("back_sin", back().map(|row| row.sin));
    members.numbers("back_cos", back().map(|row| row.cos));
    members.numbers("back_one", back().map(|row| row.one));
    members.align();
    members.vector("direction", &normal.direction);
    members.vector("response", &normal.response);
    members.vector("bound_x", &normal.bound.x);
    members.vector("bound_v", &normal.bound.v);
    members.step("held_", &normal.held);
    members.rows("back_x", back().map(|row| &row.state.x));
    members.rows("back_v", back().map(|row| &row.state.v));
}

/// What a cell has beside its flow.
#[derive(Debug)]
pub struct CellConstants<'a> {
    /// Where the constants of its flow lie.
    pub flow: u32,
    /// [`Flight::unit`].
    pub unit: f32,
    /// The stops at both ends of each normal.
    pub stops: &'a [StopsAlong],
    /// Where it begins.
    pub start: &'a [f64],
}

fn cell_members<const N: usize>(cell: &CellConstants<'_>, members: &mut Members<N>) {
    let CellConstants { flow, unit, stops, start } = *cell;
    members.integer("flow", flow);
    members.number("unit", unit);
    members.pairs("gap", stops.iter().map(|along| along.gap));
    members.pairs("restitution", stops.iter().map(|along| along.restitution));
    members.numbers("start", start.iter().map(|&value| value as f32));
}

/// Words from one vector to the next in a buffer.
const fn vector_words<const N: usize>() -> usize {
    if N == 3 { 4 } else { N }
}

/// The structs `ContactNormal`, `Flight` and `Cell` as the shader declares them.
pub fn declarations<const N: usize>(shape: &Shape) -> String {
    let declared = |write: &dyn Fn(&mut Members<N>)| {
        let mut text = String::new();
        write(&mut Members { words: &mut Vec::new(), declared: Some(&mut text) });
        text
    };
    let none = Flight::<f32, N>::blank(shape.normals, 0.0);
    let stops = vec![StopsAlong::NONE; shape.normals];
    let normal = declared(&|members| normal_members(&none.normals[0], members));
    let flight = declared(&|members| flight_members(&none, members));
    let start = vec![0.0; 2 * N];
    let cell = CellConstants { flow: 0, unit: 0.0, stops: &stops, start: &start };
    let cell = declared(&|members| cell_members(&cell, members));
    format!(
        "struct ContactNormal {{\n{normal}}}\n\nstruct Flight {{\n{flight}    normals: array<ContactNormal, NORMALS>,\n}}\n\n\
         struct Cell {{\n{cell}}}\n"
    )
}

/// What a cell has beside its flow, as the shader reads it.
pub fn write_cell<const N: usize>(cell: &CellConstants<'_>, into: &mut Vec<u32>) {
    cell_members::<N>(cell, &mut Members { words: into, declared: None });
}

/// The constants of a flow as the shader reads them.
pub fn write_flight<const N: usize>(flight: &Flight<f32, N>, into: &mut Vec<u32>) {
    let members = &mut Members { words: into, declared: None };
    flight_members(flight, members);
    for normal in flight.normals() {
        normal_members(normal, members);
    }
}

/// The polynomials of a step, normal by normal: what a kick becomes, and then what the end says of the way to it.
pub fn write_kicks<const N: usize>(flight: &Flight<f32, N>, into: &mut Vec<u32>) {
    let mut members = Members { words: into, declared: None };
    for normal in flight.normals() {
        let back = normal.back[..BACK_TERMS].iter().map(|row| &row.state);
        for term in normal.kick[..KICK_TERMS].iter().chain(back) {
            members.state("", term);
        }
    }
}
