//! The engine, used as a library: held to an independent oracle, to closed forms, to the paper, and its back ends to each other.

mod against_oracle;
mod common;
mod control;
mod curves;
mod diagram;
mod extents;
mod forgetting;
mod general;
mod growing;
mod inadmissible;
mod labels;
mod lanes;
mod losses;
mod oracle_self;
mod physics;
mod sweep;
mod theory;
mod twins;
mod validate;
