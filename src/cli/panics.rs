//! A panic is reported as an error, with a request to report it.

use std::panic::{self, AssertUnwindSafe, PanicHookInfo};

use parking_lot::Mutex;

use super::{CliError, Result};

/// The first panic, which the others may be a consequence of.
static FIRST: Mutex<Option<String>> = Mutex::new(None);

/// Runs something, a panic of which becomes [`CliError::Bug`].
pub fn shielded(action: impl FnOnce() -> Result<()>) -> Result<()> {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(remember));
    let result = panic::catch_unwind(AssertUnwindSafe(action));
    panic::set_hook(usual);
    result.unwrap_or_else(|_| Err(CliError::Bug(first())))
}

fn remember(panic: &PanicHookInfo) {
    let payload = panic.payload();
    let text = payload.downcast_ref::<&str>().copied();
    let what = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
    let place = panic.location().map(|place| format!(" ({place})")).unwrap_or_default();
    FIRST.lock().get_or_insert_with(|| format!("{what}{place}"));
}

fn first() -> String {
    FIRST.lock().take().unwrap_or_else(|| "unknown".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::interrupt;

    #[test]
    fn a_panic_anywhere_becomes_a_request_to_report_it() {
        let here = shielded(|| panic!("out of {}", "range"));
        let elsewhere = shielded(|| interrupt::abandonable(|| panic!("on another thread")));
        for (result, what) in [(here, "out of range"), (elsewhere, "on another thread")] {
            let message = result.unwrap_err().to_string();
            assert!(message.contains(what) && message.contains("panics.rs"), "{message}");
            assert!(message.contains("please report it"), "{message}");
        }
    }
}
