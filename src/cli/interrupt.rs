//! Ctrl-C: a flag that whatever takes long looks at.

use std::panic;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use anyhow::Context;

use super::CliError;

/// How often a wait looks at the flag.
const GLANCE: Duration = Duration::from_millis(20);

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Turns Ctrl-C (and a request to terminate) into a flag.
pub fn listen() -> Result<(), CliError> {
    ctrlc::set_handler(|| REQUESTED.store(true, Ordering::Relaxed))
        .context("cannot listen for Ctrl-C")
        .map_err(CliError::Machine)
}

/// Whether Ctrl-C was pressed.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Ends the command here if Ctrl-C was pressed.
pub fn check() -> Result<(), CliError> {
    if requested() { Err(CliError::Interrupted) } else { Ok(()) }
}

/// Does something that cannot be stopped, on a thread that Ctrl-C leaves behind; it must not write anything.
pub fn abandonable<T: Send + 'static>(action: impl FnOnce() -> T + Send + 'static) -> Result<T, CliError> {
    let (result, arrived) = mpsc::channel();
    let worker = thread::spawn(move || {
        let _ = result.send(action());
    });
    loop {
        match arrived.recv_timeout(GLANCE) {
            Ok(value) => return Ok(value),
            Err(RecvTimeoutError::Timeout) => check()?,
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => panic::resume_unwind(panic),
                Ok(()) => unreachable!("a thread that did not panic sent its result"),
            },
        }
    }
}
