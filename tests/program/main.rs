//! The program, from outside: every command as it is typed, its files, its refusals, and the explorer.

mod bad_files;
mod basins;
mod cells;
mod commands;
mod control;
mod control_systems;
mod curves;
mod explore;
mod extents;
mod extremes;
mod fields;
mod figures;
mod fuzz;
mod habits;
mod invocations;
mod python;
mod run;
mod stores;
mod systems;
mod theory;
