//! Panics become an error with a request to report it; users never see a raw one.

use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::Mutex;

use super::CliError;

/// The first panic, which the others may be a consequence of.
static FIRST: Mutex<Option<String>> = Mutex::new(None);

/// Runs something, a panic of which becomes [`CliError::Bug`].
pub fn shielded(action: impl FnOnce() -> Result<(), CliError>) -> Result<(), CliError> {
    panic::set_hook(Box::new(remember));
    panic::catch_unwind(AssertUnwindSafe(action)).unwrap_or_else(|_| Err(CliError::Bug(first())))
}

fn remember(panic: &PanicHookInfo) {
    let payload = panic.payload();
    let text = payload.downcast_ref::<&str>().copied();
    let what = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
    let place = panic.location().map(|place| format!(" ({place})")).unwrap_or_default();
    if let Ok(mut first) = FIRST.lock() {
        first.get_or_insert_with(|| format!("{what}{place}"));
    }
}

fn first() -> String {
    let first = FIRST.lock().ok().and_then(|mut first| first.take());
    first.unwrap_or_else(|| "unknown".to_owned())
}
