//! A small plane from library code: computed on the best back end of this machine, and drawn.
//!
//! ```text
//! cargo run --release --example small_plane -- [FILE.png]
//! ```
//!
//! Without a name the picture goes to the folder for temporary files.

use std::path::PathBuf;

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Choice, Unwatched, open};
use impact_atlas::figure::Size;
use impact_atlas::model::Parameters;
use impact_atlas::plane::{Plane, Start};
use impact_atlas::render::region_map;
use impact_atlas::store::Output;
use impact_atlas::sweep::sweep;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path =
        std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("small_plane.png"), PathBuf::from);

    // The frequency across, the coefficient of restitution upwards; the other parameters are the paper's.
    let plane = Plane {
        x: "omega=2.4:3.8:80".parse()?,
        y: "r=0.5:0.95:60".parse()?,
        parameters: Parameters::default().into(),
        start: Start::Symmetric,
        task: Schedule { transient: 400, observe: 200, max_period: 32, fixed_periods: false },
    };
    let size = Size::new(800, 600)?;
    let picture = Output::prepare(path)?;
    let backend = open(Choice::Auto, None)?;
    let map = sweep(&plane, &*backend, &Unwatched)?;

    for (regime, cells) in map.census().into_iter().filter(|(_, cells)| *cells > 0) {
        println!("{cells:>6} cells {}", regime.name());
    }
    picture.write(|file| region_map(&map, size).write_png(file))?;
    println!("drawn on {}: {}", map.provenance.adapter, picture.path().display());
    Ok(())
}
