//! Where a kernel reads the constants of its cell, and keeps what it notes about its trajectory.

use super::kernel::Kernel;

/// Where the constants of a cell, and its observer, are while its trajectory is followed.
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

    /// What `observer` stands for in a kernel.
    pub fn observer(self, kernel: Kernel) -> &'static str {
        match (self, kernel) {
            (Residence::Buffer, Kernel::Follow | Kernel::Trace) => "observers[cell]",
            _ => "observer",
        }
    }

    /// Declares the observer, and for kernels that keep one how they go on with it and store it.
    pub fn observer_source(self, kernel: Kernel) -> &'static str {
        match (self, kernel) {
            (_, Kernel::Control | Kernel::Extent) => "var<private> observer: Observer;\n",
            (Residence::Buffer, _) => {
                "// Goes on with an observer, which stays where it is stored.
fn observer_resume() {
    trajectory = observers[cell].trajectory;
    tangent = observers[cell].tangent;
}

fn observer_save() {
    observers[cell].trajectory = trajectory;
    observers[cell].tangent = tangent;
}
"
            }
            (Residence::Private, _) => {
                "var<private> observer: Observer;

// Goes on with an observer that was stored.
fn observer_resume() {
    observer = observers[cell];
    trajectory = observer.trajectory;
    tangent = observer.tangent;
}

fn observer_save() {
    observer.trajectory = trajectory;
    observer.tangent = tangent;
    observers[cell] = observer;
}
"
            }
        }
    }

    /// Declares `flight_load`, which a kernel calls when it knows its cell, and `normal_term`.
    pub fn source(self) -> &'static str {
        match self {
            Residence::Buffer => {
                "fn flight_load() {
    flow = cells[cell].flow;
}

// A term of the polynomials of a normal: what a kick becomes, then what the end of a step says of the way to it.
fn normal_term(normal: u32, term: u32) -> State {
    return kicks[flow * NORMALS + normal][term];
}
"
            }
            Residence::Private => {
                "var<private> cell_flight: Flight;
var<private> cell_stops: Cell;
// Normal by normal: a compiler makes a choice of every place that an index which it does not know may mean.
var<private> cell_kicks: array<array<State, NORMAL_TERMS>, NORMALS>;

fn flight_load() {
    flow = cells[cell].flow;
    cell_flight = flights[flow];
    cell_stops = cells[cell];
    for (var term = 0u; term < NORMAL_TERMS; term++) {
        for (var normal = 0u; normal < NORMALS; normal++) {
            cell_kicks[normal][term] = kicks[flow * NORMALS + normal][term];
        }
    }
}

// A term of the polynomials of a normal: what a kick becomes, then what the end of a step says of the way to it.
fn normal_term(normal: u32, term: u32) -> State {
    return cell_kicks[normal][term];
}
"
            }
        }
    }
}
