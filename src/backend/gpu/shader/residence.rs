//! Where a kernel reads the constants of its cell.

/// Where the constants of a cell are while its trajectory is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(test, derive(strum::VariantArray))]
pub enum Residence {
    /// Where they lie: hardware has few registers, and caches for the rest.
    Buffer,
    /// In memory of the invocation: a software adapter reads a buffer lane by lane, each time anew.
    Private,
}

impl Residence {
    /// What `flight` stands for in a shader.
    pub fn flight(self) -> &'static str {
        match self {
            Residence::Buffer => "flights[flow]",
            Residence::Private => "cell_flight",
        }
    }

    /// What `stops` stands for in a shader.
    pub fn stops(self) -> &'static str {
        match self {
            Residence::Buffer => "cells[cell]",
            Residence::Private => "cell_stops",
        }
    }

    /// Declares `flight_load`, which a kernel calls when it knows its cell, and `kick_term`.
    pub fn source(self) -> &'static str {
        match self {
            Residence::Buffer => {
                "fn flight_load() {
    flow = cells[cell].flow;
}

// The kick polynomials of the cell, normal by normal.
fn kick_term(at: u32) -> State {
    return kicks[flow * (NORMALS * KICK_TERMS) + at];
}
"
            }
            Residence::Private => {
                "var<private> cell_flight: Flight;
var<private> cell_stops: Cell;
var<private> cell_kicks: array<State, NORMALS * KICK_TERMS>;

fn flight_load() {
    flow = cells[cell].flow;
    cell_flight = flights[flow];
    cell_stops = cells[cell];
    for (var at = 0u; at < NORMALS * KICK_TERMS; at++) {
        cell_kicks[at] = kicks[flow * (NORMALS * KICK_TERMS) + at];
    }
}

// The kick polynomials of the cell, normal by normal.
fn kick_term(at: u32) -> State {
    return cell_kicks[at];
}
"
            }
        }
    }
}
