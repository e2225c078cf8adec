//! A family of systems from a string: its plane computed and drawn, without anything of the command line.
use impact_atlas::backend::{Cpu, Unwatched};
use impact_atlas::plane::{Axis, Plane, Start};
use impact_atlas::{analysis::Schedule, figure::Size, model::Setting};
use impact_atlas::{render::region_map, sweep::sweep, system::Family};

const FAMILY: &str = r#"
name = "A driven mass on a spring, beside a stop"
[parameters]
omega = { default = 2.5, symbol = "ω", about = "frequency of the forcing", at_least = 0.1 }
r = { default = 0.8, about = "coefficient of restitution", at_least = 0, at_most = 1 }
[system]
frequency = "omega"
mass = [["1"]]
damping = [["0.1"]]
stiffness = [["1"]]
force_sin = ["1"]
[[stop]]
name = "A"
direction = ["1"]
gap = 0.1
restitution = "r"
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let family = Family::kept(FAMILY, "the string above")?;
    let plane = Plane {
        x: Axis::of_family("omega=1:6:200", family)?,
        y: Axis::of_family("r=0.3:0.95:150", family)?,
        parameters: Setting::defaults(family),
        start: Start::Rest,
        task: Schedule { transient: 400, observe: 200, max_period: 32, fixed_periods: false },
    };
    let map = sweep(&plane, &Cpu, &Unwatched)?;
    let path = std::env::args().nth(1).unwrap_or("own_family.png".to_owned());
    Ok(region_map(&map, Size::new(800, 600)?).write_png(std::fs::File::create(path)?)?)
}
