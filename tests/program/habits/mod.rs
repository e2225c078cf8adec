//! What people rely on without asking: files that stay, streams, limits of the machine, help that tells the truth.

mod asked;
mod bits;
mod files;
mod machine;

use std::path::Path;
use std::process::Output;

use crate::run::{run_in, stderr};

/// A map that takes a moment only.
const SMALL: &str = "map --backend cpu --x omega=2.8:3.8:6 --y delta=0.1:0.3:4 --transient 20 --observe 10";

fn words(command: &str) -> Vec<&str> {
    command.split_whitespace().collect()
}

fn done(folder: &Path, command: &str) -> Output {
    let output = run_in(folder, &words(command));
    assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
    output
}
