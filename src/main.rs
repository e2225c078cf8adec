//! The command line of Impact Atlas.

mod cli;

use std::process::ExitCode;

use mimalloc::MiMalloc;

/// Systems of cells are many small blocks, and tiles large ones that come and go.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    cli::hush_drivers();
    let arguments = cli::parsed();
    match cli::run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::complain(&error.to_string());
            error.exit_code()
        }
    }
}
