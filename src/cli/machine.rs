//! What the program asks of the machine before it begins: threads, signals, and drivers without messages of their own.

use std::env;

use anyhow::Context;

use super::{CliError, Result, wrong};

/// The most threads that are started.
pub const MOST_THREADS: u32 = 1024;

/// The variable that rayon takes the number of threads from.
const THREADS: &str = "RAYON_NUM_THREADS";

/// Starts so many threads for computing; without a number those of the environment, or one for every core.
///
/// # Errors
/// A number in the environment that cannot be used, or threads that the machine does not give.
pub fn start_threads(asked: Option<u32>) -> Result<()> {
    let threads = match asked {
        Some(threads) => threads,
        None => threads_of(env::var(THREADS).ok().as_deref())?,
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads as usize)
        .build_global()
        .context("cannot start the threads that compute: choose fewer with --threads")
        .map_err(CliError::Machine)
}

/// The number of threads that the environment asks for; 0 where it leaves that open.
fn threads_of(variable: Option<&str>) -> Result<u32> {
    let text = variable.map_or("", str::trim);
    if text.is_empty() {
        return Ok(0);
    }
    text.parse().ok().filter(|&threads| threads <= MOST_THREADS).ok_or_else(|| {
        wrong!("{THREADS}={text} cannot be used: set it to 1 to {MOST_THREADS}, unset it, or give --threads")
    })
}

/// Lets a file that grows beyond the shell's limit be an error of writing instead of the end of the process.
#[cfg(unix)]
pub fn outlive_large_files() -> Result<()> {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    let unread = Arc::new(AtomicBool::new(false));
    signal_hook::flag::register(signal_hook::consts::SIGXFSZ, unread)
        .context("cannot listen for the limit on the size of files")
        .map_err(CliError::Machine)?;
    Ok(())
}

/// There is no such limit elsewhere.
#[cfg(not(unix))]
pub fn outlive_large_files() -> Result<()> {
    Ok(())
}

/// Begins anew with an environment in which the Vulkan loader's device selection layer stays out.
///
/// Without a session's XDG_RUNTIME_DIR that layer complains on standard error each time a device is looked for, and
/// what it would order is ordered here. The process stays the same, and so do its number and its streams.
#[cfg(target_os = "linux")]
pub fn hush_drivers() {
    use std::os::unix::process::CommandExt;
    use std::path::Path;
    use std::process::Command;

    let in_session = env::var_os("XDG_RUNTIME_DIR").is_some_and(|folder| Path::new(&folder).is_absolute());
    let settled = ["NODEVICE_SELECT", "MESA_VK_DEVICE_SELECT"].iter().any(|name| env::var_os(name).is_some());
    let mut arguments = env::args_os();
    let (false, Ok(program), Some(name)) = (in_session || settled, env::current_exe(), arguments.next())
    else {
        return;
    };
    // This returns only if it fails, and then the complaint does no harm.
    let _ = Command::new(program).arg0(name).args(arguments).env("NODEVICE_SELECT", "1").exec();
}

/// The layer is Linux's.
#[cfg(not(target_os = "linux"))]
pub fn hush_drivers() {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_environment_asks_for_a_number_of_threads_that_there_can_be() {
        for (text, threads) in
            [(None, 0), (Some(""), 0), (Some("0"), 0), (Some(" 3 "), 3), (Some("1024"), 1024)]
        {
            assert_eq!(threads_of(text).unwrap(), threads, "{text:?}");
        }
        for text in ["1025", "100000", "99999999999999999999", "-1", "many"] {
            let message = threads_of(Some(text)).unwrap_err().to_string();
            assert!(
                message.contains(&format!("{THREADS}={text}")) && message.contains("--threads"),
                "{message}"
            );
        }
    }
}
