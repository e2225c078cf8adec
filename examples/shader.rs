//! The shader by which hardware follows trajectories of a system, in WGSL.
//!
//! ```text
//! cargo run --release --example shader -- [SYSTEM]
//! ```
//!
//! SYSTEM is the name of a system that comes with the program (`impact-atlas systems` lists them); the paper's by default.

use impact_atlas::backend::hardware_shader;
use impact_atlas::model::{Setting, System};
use impact_atlas::system::{BUILTIN, Family};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "luo-ma-lv".to_owned());
    if !BUILTIN.iter().any(|family| family.name == name) {
        return Err(format!("no system named {name} comes with the program").into());
    }
    let system = System::new(Setting::defaults(Family::builtin(&name)))?;
    print!("{}", hardware_shader(&system));
    Ok(())
}
