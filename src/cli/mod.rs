//! The command line: arguments, checked options, one file per subcommand.
//!
//! Results go to standard output, everything else to standard error.

mod adapters;
mod bifurcation;
mod bifurcation_summary;
mod bits;
mod cell;
mod census;
mod classify;
mod compared;
mod control;
mod control_map;
mod control_report;
mod controlled;
mod curve_list;
mod curve_table;
mod curves;
mod defaults;
mod drawing;
mod error;
mod estimate;
mod explore;
mod files;
mod help;
mod interrupt;
mod lyapunov;
mod machine;
mod map;
mod map_args;
mod method;
mod motion;
mod multipliers;
mod options;
mod orbit;
mod orbit_shown;
mod orbit_table;
mod panics;
mod pictures;
mod progress;
mod render;
mod report;
mod reproduce;
mod scripts;
mod spans;
mod status;
mod stored;
mod symmetric;
mod system;
mod systems;
mod terminal;
mod validate;
mod values;

use std::ffi::OsString;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use error::wrong;
pub use error::{CliError, Result};
pub use machine::hush_drivers;
pub use terminal::{complain, note};

use values::counted;

/// Parameter planes of vibro-impact systems, explored on the GPU.
///
/// The system is a linear oscillator with rigid stops, given by --system: one that comes with the program (see `systems`)
/// or a file of your own. By default it is that of Luo, Ma and Lv, two masses, the first of which moves between two rigid
/// stops at x1 = ±delta, forced by sin(omega t). All quantities are non-dimensional. A periodic motion is labelled N-p-q: N
/// forcing periods, p impacts at the stop x1 = -delta and q impacts at the stop x1 = +delta in one period of the motion;
/// other systems state the order of their stops.
#[derive(Debug, Parser)]
#[command(name = "impact-atlas", version, after_long_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Says nothing but results and errors
    #[arg(long, short, global = true)]
    quiet: bool,

    /// Computes on so many threads of the processor [default: one for every core]
    #[arg(long, value_name = "N", global = true, value_parser = counted(1, machine::MOST_THREADS))]
    threads: Option<u32>,
}

const EXIT_CODES: &str = "\
Files: - is standard output; what is printed otherwise goes to standard error then. Files that are there are
replaced only with --force.

Exit codes: 0 done, 1 a check did not hold or what was asked for is not there, 2 the input is wrong, 3 the machine cannot do it, 130 interrupted.";

#[derive(Debug, Subcommand)]
enum Command {
    Map(Box<map_args::MapArgs>),
    Explore(Box<explore::ExploreArgs>),
    Render(render::RenderArgs),
    Status(status::StatusArgs),
    Classify(classify::ClassifyArgs),
    Orbit(orbit::OrbitArgs),
    Control(control::ControlArgs),
    Bifurcation(bifurcation::BifurcationArgs),
    Curves(curves::CurvesArgs),
    Symmetric(symmetric::SymmetricArgs),
    Motion(motion::MotionArgs),
    Lyapunov(lyapunov::LyapunovArgs),
    Reproduce(reproduce::ReproduceArgs),
    Validate(validate::ValidateArgs),
    Systems(systems::SystemsArgs),
    Adapters(adapters::AdaptersArgs),
    Completions(scripts::CompletionsArgs),
    Man(scripts::ManArgs),
}

/// Reads the arguments of the process; ends it where they cannot be used, or ask for help.
pub fn parsed() -> Cli {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    let command = help::about_system(Cli::command(), &arguments);
    let matches = command.get_matches_from(arguments);
    Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

/// Does what the arguments ask for.
pub fn run(cli: &Cli) -> Result<()> {
    if cli.quiet {
        terminal::hush();
    }
    interrupt::listen()?;
    machine::outlive_large_files()?;
    machine::start_threads(cli.threads)?;
    panics::shielded(|| match &cli.command {
        Command::Map(args) => map::run(args),
        Command::Explore(args) => explore::run(args),
        Command::Render(args) => render::run(args),
        Command::Status(args) => status::run(args),
        Command::Classify(args) => classify::run(args),
        Command::Orbit(args) => orbit::run(args),
        Command::Control(args) => control::run(args),
        Command::Bifurcation(args) => bifurcation::run(args),
        Command::Reproduce(args) => reproduce::run(args),
        Command::Curves(args) => curves::run(args),
        Command::Symmetric(args) => symmetric::run(args),
        Command::Motion(args) => motion::run(args),
        Command::Lyapunov(args) => lyapunov::run(args),
        Command::Validate(args) => validate::run(args),
        Command::Systems(args) => systems::run(args),
        Command::Adapters(args) => adapters::run(args),
        Command::Completions(args) => scripts::complete(args, Cli::command()),
        Command::Man(args) => scripts::manual(args, Cli::command()),
    })
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        super::Cli::command().debug_assert();
    }
}
