//! The command line of Impact Atlas.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    cli::hush_drivers();
    let arguments = cli::Cli::parse();
    match cli::run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::complain(&error.to_string());
            error.exit_code()
        }
    }
}
