//! `impact-atlas adapters`: what the GPU back end can run on, and how the CPU back end does.

use clap::Args;
use impact_atlas::backend::{self, Backend, Cpu};
use impact_atlas::model::Width;

use super::Result;
use super::terminal::{print, print_json};

/// Lists the adapters that the GPU back end can run on
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas adapters
  impact-atlas map --backend gpu --adapter llvmpipe")]
pub struct AdaptersArgs {
    /// Prints JSON: [{name, driver, api, kind, pci}], kind being hardware or software
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &AdaptersArgs) -> Result<()> {
    let adapters = backend::adapters();
    if args.json {
        return print_json(&adapters);
    }
    let mut lines: Vec<String> = (adapters.iter().enumerate())
        .map(|(i, a)| {
            let at = if a.pci.is_empty() { String::new() } else { format!(", {}", a.pci) };
            format!("#{i} {} ({}, {}, {}{at})", a.name, a.kind, a.api, a.driver)
        })
        .collect();
    if lines.is_empty() {
        lines.push("no adapter was found; --backend cpu needs none".to_owned());
    }
    let abreast = Width::widest().description::<f64>();
    lines.push(format!("--backend cpu: {}, trajectories side by side: {abreast}", Cpu.adapter()));
    print(&lines.join("\n"))
}
