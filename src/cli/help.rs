//! The help of a command with the system that is named beside it: its parameters, stops and coordinates.

use std::ffi::OsString;

use clap::Command;
use impact_atlas::model::{Number, Parameter, Setting};
use impact_atlas::plane::Component;
use impact_atlas::system::Family;
use impact_atlas::theory::Label;

use super::system::{Chosen, parse_system};

/// The command line, its help about the system that `arguments` name where they ask for help.
pub fn about_system(command: Command, arguments: &[OsString]) -> Command {
    let texts: Vec<&str> = arguments.iter().filter_map(|argument| argument.to_str()).collect();
    let asked = texts.iter().any(|text| matches!(*text, "--help" | "-h"));
    let after = texts.windows(2).find(|pair| pair[0] == "--system").map(|pair| pair[1]);
    let named = texts.iter().find_map(|text| text.strip_prefix("--system=")).or(after);
    let family = named.filter(|_| asked).and_then(|name| parse_system(name).ok());
    let Some(Chosen(family)) = family else { return command };
    command.mut_subcommands(|subcommand| {
        if !subcommand.get_arguments().any(|argument| argument.get_long() == Some("system")) {
            return subcommand;
        }
        let examples = subcommand.get_after_help().map(|text| format!("{text}\n\n")).unwrap_or_default();
        subcommand.after_help(format!("{examples}{}", described(family)))
    })
}

/// What a family names.
fn described(family: &'static Family) -> String {
    let mut lines = vec![format!("The system {}: {}", family.origin, family.name)];
    let defaults = Setting::defaults(family);
    for parameter in Parameter::all(family) {
        let value = Number(defaults.get(parameter));
        let about = &parameter.about().about;
        let about = if about.is_empty() { String::new() } else { format!("{about}; ") };
        lines.push(format!("  {} = {value}: {about}{}", parameter.name(), parameter.about().range));
    }
    let components: Vec<&str> = Component::all(family.n()).map(Component::name).collect();
    lines.push(format!("  state and start: {}", components.join(",")));
    for (i, stop) in family.stops().iter().enumerate() {
        lines.push(format!("  stop {}: {}", stop.plain_name(), family.stop_place(i)));
    }
    let order = family.label_order().iter().map(|&stop| family.stops()[stop].plain_name());
    let order = order.collect::<Vec<_>>().join(", ");
    lines.push(format!("  labels: {}, impacts at {order}", Label::form(family.stops().len())));
    if let Some(plane) = &family.plane {
        lines.push(format!("  default plane of `map`: --x {} --y {}", plane.x, plane.y));
    }
    lines.join("\n")
}
