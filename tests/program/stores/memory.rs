//! Memory that does not grow with the plane.

#[cfg(target_os = "linux")]
#[test]
fn a_plane_whose_results_do_not_fit_into_memory_is_computed_into_a_store() {
    use std::process::Command;

    use crate::run::stderr;

    /// What a process may take, in KiB; the results of the plane take more.
    const LIMIT: u32 = 300_000;
    let folder = tempfile::tempdir().unwrap();
    let program = env!("CARGO_BIN_EXE_impact-atlas");
    let limited = |more: &str| {
        let plane = "--x omega=3:4:1200 --y delta=0.1:0.2:900 --transient 0 --observe 1 --fixed-periods";
        let command = format!(
            "ulimit -v {LIMIT}; exec {program} map --backend cpu --threads 2 --start rest {plane} {more}"
        );
        Command::new("bash").args(["-c", &command]).current_dir(folder.path()).output().unwrap()
    };
    let refused = limited("");
    assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
    assert!(stderr(&refused).contains("do not fit into this machine's memory"), "{}", stderr(&refused));
    let stored = limited("--data plane.zarr");
    assert_eq!(stored.status.code(), Some(0), "{}", stderr(&stored));
}

/// Columns and rows of the store that is drawn; a larger one is asked for by IMPACT_ATLAS_DRAWN=4000x3000.
#[cfg(target_os = "linux")]
fn drawn() -> (u32, u32) {
    let text = std::env::var("IMPACT_ATLAS_DRAWN").unwrap_or_else(|_| "1000x750".to_owned());
    let (columns, rows) = text.split_once('x').unwrap();
    (columns.parse().unwrap(), rows.parse().unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn a_store_is_drawn_in_memory_that_does_not_hold_it() {
    use std::process::Command;
    use std::time::Instant;

    use impact_atlas::analysis::{Counts, Measures, Regime, Schedule, Verdict};
    use impact_atlas::backend::{Backend, Cpu};
    use impact_atlas::model::Parameters;
    use impact_atlas::plane::fields::Extras;
    use impact_atlas::plane::{Plane, Start};
    use impact_atlas::store::{Wanted, ZarrStore};

    use crate::run::stderr;

    let (columns, rows) = drawn();
    let folder = tempfile::tempdir().unwrap();
    let plane = Plane {
        x: format!("omega=0.2:5:{columns}").parse().unwrap(),
        y: format!("delta=0.02:0.8:{rows}").parse().unwrap(),
        parameters: Parameters::default().into(),
        start: Start::Rest,
        task: Schedule { transient: 1, observe: 1, max_period: 8, fixed_periods: true },
    };
    let provenance = impact_atlas::sweep::provenance(&Cpu as &dyn Backend);
    let wanted = Wanted { plane: &plane, provenance: &provenance, extras: Extras::NONE, tile: None };
    let store = ZarrStore::of(&folder.path().join("plane.zarr"), &wanted).unwrap();
    // Slanted bands of motions, and in the last of them numbers that no two cells share.
    let cell = |(column, row): (u32, u32)| {
        let band = (6 * column / columns + 4 * row / rows) % 7;
        let noise = f64::from((column.wrapping_mul(0x9e37_79b9) ^ row.wrapping_mul(0x85eb_ca6b)) >> 8);
        Verdict {
            regime: if band < 5 { Regime::Periodic } else { Regime::Chaotic },
            n: if band < 5 { 1 + band as u16 } else { 0 },
            counts: Counts::new(&[band as u16, 1]),
            symmetric: false,
            lyapunov: noise as f32 / 1.7e7 - 0.5,
            state: [noise, -noise, 0.5 * noise, f64::from(column)].into(),
            impacts: column,
            impacts_total: 0,
            peak_impact_velocity: 0.5,
            periods: row,
            returning: 0,
            measures: Measures { observed: 40, power: 0.1, contact: 0.0 },
        }
    };
    for tile in 0..store.tiling().count() {
        let verdicts: Vec<Verdict> = store.tiling().window(tile).places().map(cell).collect();
        store.write_tile(tile, &verdicts.into()).unwrap();
    }
    // What the states alone take would not fit beside the program and the picture.
    let limit = 300_000;
    for layer in ["motion", "lyapunov"] {
        let began = Instant::now();
        let program = env!("CARGO_BIN_EXE_impact-atlas");
        let command = format!(
            "ulimit -v {limit}; exec {program} render plane.zarr --threads 2 --out {layer}.png --layer {layer}"
        );
        let output = Command::new("bash").args(["-c", &command]).current_dir(folder.path()).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        println!("{layer} of {columns} × {rows} cells: {:.2} s", began.elapsed().as_secs_f64());
    }
}
