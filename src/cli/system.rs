//! The system that a command is about: a family that comes with the program, or one from a file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use impact_atlas::system::{BUILTIN, Family};

/// The longest family file that is read, in bytes.
const LONGEST: u64 = 1 << 20;

/// A family as an option's value.
#[derive(Clone, Copy, Debug)]
pub struct Chosen(pub &'static Family);

/// Reads the value of --system: the name of a family that comes with the program, or a file.
pub fn parse_system(text: &str) -> Result<Chosen, String> {
    if let Some(builtin) = BUILTIN.iter().find(|builtin| builtin.name == text) {
        return Ok(Chosen(Family::builtin(builtin.name)));
    }
    let path = Path::new(text);
    let names: Vec<&str> = BUILTIN.iter().map(|builtin| builtin.name).collect();
    let known = names.join(", ");
    let file = File::open(path).map_err(|error| {
        format!("neither a system that comes with the program ({known}) nor a file that can be read: {error}")
    })?;
    let unreadable = |error: &dyn std::fmt::Display| format!("the file cannot be read: {error}");
    let mut bytes = Vec::new();
    // What a device or a pipe gives has no length beforehand.
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
    if bytes.len() as u64 > LONGEST {
        return Err(format!("the file has more than {LONGEST} bytes: a system is described in fewer"));
    }
    let text = String::from_utf8(bytes).map_err(|error| unreadable(&error))?;
    let family = Family::kept(&text, &path.display().to_string());
    family.map(Chosen).map_err(|error| error.to_string())
}
