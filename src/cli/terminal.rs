//! The two output streams; neither a closed pipe nor a closed terminal is a reason to panic.

use std::io::{self, ErrorKind, Write};

use anyhow::Context;
use serde::Serialize;

use super::CliError;

/// Says something on standard error; whether anybody listens does not matter.
pub fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Prints a result on standard output. A reader that has gone away is content.
pub fn print(text: &str) -> Result<(), CliError> {
    let mut stdout = io::stdout().lock();
    match writeln!(stdout, "{text}").and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to standard output").map_err(CliError::Machine)
        }
        _ => Ok(()),
    }
}

/// Prints a result as JSON on standard output.
pub fn print_json(result: &impl Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string_pretty(result).context("cannot put the result into JSON");
    print(&text.map_err(CliError::Machine)?)
}
