//! `impact-atlas completions` and `impact-atlas man`: what shells and manuals want to know of the command line.

use anyhow::Context;
use clap::{Args, Command};
use clap_complete::Shell;

use super::terminal::write;
use super::{CliError, Result, wrong};

/// Prints completions for a shell
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas completions bash > ~/.local/share/bash-completion/completions/impact-atlas
  impact-atlas completions zsh > ~/.zfunc/_impact-atlas
  impact-atlas completions fish > ~/.config/fish/completions/impact-atlas.fish")]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the manual page of the program, or of one of its commands
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas man | man -l -
  impact-atlas man map > impact-atlas-map.1")]
pub struct ManArgs {
    /// The command [default: the program itself]
    #[arg(value_name = "COMMAND")]
    command: Option<String>,
}

/// Prints a shell's completions.
pub fn complete(args: &CompletionsArgs, mut program: Command) -> Result<()> {
    let name = program.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, name, &mut script);
    write(&script)
}

/// Prints a manual page.
pub fn manual(args: &ManArgs, mut program: Command) -> Result<()> {
    program.build();
    let page = match &args.command {
        None => program,
        Some(wanted) => match program.find_subcommand(wanted) {
            Some(command) => command.clone(),
            None => {
                let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
                let names = names.join(", ");
                return Err(wrong!("there is no command `{wanted}`: choose from {names}"));
            }
        },
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page)
        .render(&mut text)
        .context("cannot make the page")
        .map_err(CliError::Machine)?;
    write(&text)
}
