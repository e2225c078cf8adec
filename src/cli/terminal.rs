//! The two output streams; writing to a closed pipe or terminal is no error.

use std::io::{self, ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context;
use serde::Serialize;

use super::{CliError, Result};

/// Whether nothing but results and errors is to be said.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Whether a file that was asked for as `-` has standard output.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// From now on notes and progress are kept back.
pub fn hush() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether notes and progress are kept back.
pub fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// From now on standard output is a file's, and what is printed otherwise goes to standard error.
pub fn give_away_standard_output() {
    TAKEN.store(true, Ordering::Relaxed);
}

/// Says something on standard error, unless nothing but results is wanted.
pub fn note(text: &str) {
    if !is_quiet() {
        complain(text);
    }
}

/// Says something on standard error in any case; whether anybody listens does not matter.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Prints a result on standard output.
pub fn print(text: &str) -> Result<()> {
    if TAKEN.load(Ordering::Relaxed) {
        note(text);
        return Ok(());
    }
    write(format!("{text}\n").as_bytes())
}

/// Writes to standard output. A reader that has gone away is content.
pub fn write(bytes: &[u8]) -> Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to standard output").map_err(CliError::Machine)
        }
        _ => Ok(()),
    }
}

/// Prints a result as JSON on standard output.
pub fn print_json(result: &impl Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(result).context("cannot put the result into JSON");
    let text = text.map_err(CliError::Machine)?;
    if TAKEN.load(Ordering::Relaxed) {
        complain(&text);
        return Ok(());
    }
    print(&text)
}
