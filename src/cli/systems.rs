//! `impact-atlas systems`: the systems that come with the program.

use clap::Args;
use impact_atlas::system::{BUILTIN, Family, builtin};
use serde::Serialize;

use super::Result;
use super::terminal::{print, print_json};

/// Lists the systems that come with the program, or prints the file of one, to be copied and changed
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas systems
  impact-atlas systems bouncing-ball > mine.toml
  impact-atlas map --system mine.toml")]
pub struct SystemsArgs {
    /// Prints the file of this system
    #[arg(value_name = "NAME", value_parser = clap::builder::PossibleValuesParser::new(BUILTIN.map(|b| b.name)))]
    name: Option<String>,

    /// Prints JSON: [{name, title, source, coordinates, stops, parameters, plane}]
    #[arg(long, conflicts_with = "name")]
    json: bool,
}

/// A system as it is listed.
#[derive(Debug, Serialize)]
struct Entry {
    name: &'static str,
    title: &'static str,
    source: Option<&'static str>,
    coordinates: usize,
    stops: Vec<&'static str>,
    parameters: Vec<&'static str>,
    /// The default axes of `map`.
    plane: Option<[&'static str; 2]>,
}

/// Runs the command.
pub fn run(args: &SystemsArgs) -> Result<()> {
    if let Some(text) = args.name.as_deref().and_then(builtin) {
        return print(text.trim_end());
    }
    let entries: Vec<Entry> = BUILTIN.iter().map(|builtin| Entry::of(builtin.name)).collect();
    if args.json { print_json(&entries) } else { print(&text(&entries)) }
}

impl Entry {
    fn of(name: &'static str) -> Self {
        let family = Family::builtin(name);
        Entry {
            name,
            title: &family.name,
            source: family.source.as_deref(),
            coordinates: family.n(),
            stops: family.stops().iter().map(|stop| stop.name.as_str()).collect(),
            parameters: family.parameters.iter().map(|parameter| parameter.name.as_str()).collect(),
            plane: family.plane.as_ref().map(|plane| [plane.x.as_str(), plane.y.as_str()]),
        }
    }
}

fn text(entries: &[Entry]) -> String {
    let lines = entries.iter().map(|entry| {
        let source = entry.source.map(|source| format!("\n    {source}")).unwrap_or_default();
        let plane = entry.plane.map(|[x, y]| format!("\n    map: --x {x} --y {y}")).unwrap_or_default();
        format!("{}: {}{source}{plane}", entry.name, entry.title)
    });
    lines.collect::<Vec<_>>().join("\n")
}
