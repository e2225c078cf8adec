//! What people rely on without asking: files that stay, streams, limits of the machine, help that tells the truth.

mod asked;
mod bits;
mod files;
mod machine;

/// A map that takes a moment only.
const SMALL: &str = "map --backend cpu --x omega=2.8:3.8:6 --y delta=0.1:0.3:4 --transient 20 --observe 10";
