//! Ctrl-C: a flag that whatever takes long looks at.

use std::panic;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use anyhow::Context;
use impact_atlas::backend::Watch;

use super::error::INTERRUPTED;
use super::{CliError, Result};

/// How often a wait looks at the flag.
const GLANCE: Duration = Duration::from_millis(20);

/// How long a wait goes on once the flag is up.
const GRACE: Duration = Duration::from_millis(500);

/// How long the program may take to end once the flag is up, before it is ended.
const PATIENCE: Duration = Duration::from_secs(5);

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Turns Ctrl-C (and a request to terminate) into a flag. What does not look at it in good time, or is asked a second
/// time, is ended.
pub fn listen() -> Result<()> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            end();
        }
        thread::spawn(|| {
            thread::sleep(PATIENCE);
            end();
        });
    })
    .context("cannot listen for Ctrl-C")
    .map_err(CliError::Machine)
}

/// Ends the program as interrupted.
fn end() -> ! {
    super::note(&CliError::Interrupted.to_string());
    process::exit(INTERRUPTED)
}

/// Whether Ctrl-C was pressed.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Ends the command here if Ctrl-C was pressed.
pub fn check() -> Result<()> {
    if requested() { Err(CliError::Interrupted) } else { Ok(()) }
}

/// A watch for what shows no progress.
#[derive(Clone, Copy, Debug)]
pub struct Interruptible;

impl Watch for Interruptible {
    fn cancelled(&self) -> bool {
        requested()
    }
}

/// Does something on a thread that Ctrl-C leaves behind if it does not end soon; it must not write anything.
pub fn abandonable<T: Send + 'static>(action: impl FnOnce() -> T + Send + 'static) -> Result<T> {
    let (result, arrived) = mpsc::channel();
    let worker = thread::spawn(move || {
        let _ = result.send(action());
    });
    let mut waited_in_vain = Duration::ZERO;
    while waited_in_vain < GRACE {
        match arrived.recv_timeout(GLANCE) {
            Ok(value) => return Ok(value),
            Err(RecvTimeoutError::Timeout) if requested() => waited_in_vain += GLANCE,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => panic::resume_unwind(panic),
                Ok(()) => unreachable!("a thread that did not panic sent its result"),
            },
        }
    }
    Err(CliError::Interrupted)
}
