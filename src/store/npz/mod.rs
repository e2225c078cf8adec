//! A map as a NumPy archive: one array per field of a verdict, the axes, and the configuration as JSON text.
//!
//! The arrays are those of the table in [`store`](crate::store). The same map gives the same bytes.

mod control;
mod diagram;
mod fused;
mod read;
mod write;

pub use control::{write_control, write_control_map};
pub use diagram::write_diagram;
pub use read::{ReadError, read_config, read_map};
pub use write::write_map;

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};

    use super::*;
    use crate::analysis::{INFINITELY_MANY, Regime, Schedule, Verdict};
    use crate::plane::{Plane, Provenance, RegionMap, Start};

    fn example() -> RegionMap {
        let schedule = Schedule { transient: 500, observe: 100, max_period: 16, fixed_periods: false };
        let start = Start::State([0.0, 0.1, -0.2, 1.0 / 3.0].into());
        let plane = Plane::of_paper("omega=0.2:5:3", "x1=-0.05:0.05:2", start, schedule).unwrap();
        let provenance =
            Provenance { version: "0.1.0".into(), backend: "cpu".into(), adapter: "Prüfstand ∞".into() };
        let verdict = |i: u16| Verdict {
            regime: Regime::ALL[usize::from(i)],
            n: i,
            counts: crate::analysis::Counts::new(&[i + 1, if i == 3 { INFINITELY_MANY } else { i + 2 }]),
            symmetric: i == 2,
            lyapunov: -0.1 * f32::from(i),
            state: [0.1, 0.2, 0.3, 0.4].map(|x| x * f64::from(i)).into(),
            impacts: 100 + u32::from(i),
            impacts_total: 0,
            peak_impact_velocity: 0.5 + f32::from(i),
            periods: 1000 + u32::from(i),
            returning: 0,
            measures: crate::analysis::Measures {
                observed: 40 + u32::from(i),
                power: 0.25 * f32::from(i),
                contact: 0.125,
            },
        };
        RegionMap::new(plane, provenance, (0..6).map(verdict).collect())
    }

    fn written(map: &RegionMap) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        write_map(map, &mut file).unwrap();
        file.into_inner()
    }

    #[test]
    fn a_map_reads_back_as_it_was_written() {
        let map = example();
        assert_eq!(read_map(Cursor::new(written(&map))).unwrap(), map);
    }

    #[test]
    fn a_certified_map_reads_back_with_its_multipliers() {
        let mut map = example();
        let of =
            |i: usize| (i != 2).then(|| vec![[0.5, 0.1], [0.5, -0.1], [0.1 * i as f64, 0.0], [0.0, 0.0]]);
        map.multipliers = Some((0..6).map(of).collect());
        assert_eq!(read_map(Cursor::new(written(&map))).unwrap(), map);
        assert!(read_config(Cursor::new(written(&map))).unwrap().contains(r#""certified":true"#));
    }

    #[test]
    fn a_map_with_extents_reads_back_with_them() {
        let mut map = example();
        let of = |i: usize| crate::analysis::Extent::of(&[0.25, i as f64], &[1.0, 2.5]);
        map.extents = Some((0..6).map(of).collect());
        assert_eq!(read_map(Cursor::new(written(&map))).unwrap(), map);
        assert!(read_config(Cursor::new(written(&map))).unwrap().contains(r#""extents":true"#));
        assert!(!read_config(Cursor::new(written(&example()))).unwrap().contains("extents"));
    }

    #[test]
    fn an_exponent_that_was_not_measured_reads_back_so() {
        let mut map = example();
        map.verdicts[1].lyapunov = f32::NAN;
        let read = read_map(Cursor::new(written(&map))).unwrap();
        assert!(read.verdicts[1].lyapunov.is_nan() && !read.verdicts[0].lyapunov.is_nan());
    }

    #[test]
    fn the_same_map_gives_the_same_bytes() {
        assert_eq!(written(&example()), written(&example()));
    }

    #[test]
    fn headers_are_numpys() {
        let mut zip = zip::ZipArchive::new(Cursor::new(written(&example()))).unwrap();
        let mut header = |name: &str| {
            let mut bytes = Vec::new();
            zip.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
            assert_eq!(&bytes[..6], b"\x93NUMPY");
            String::from_utf8_lossy(&bytes[10..]).lines().next().unwrap().to_owned()
        };
        for (name, kind, shape) in [
            ("regime", "|u1", "(2, 3"),
            ("n", "<u2", "(2, 3"),
            ("symmetric", "|u1", "(2, 3"),
            ("lyapunov", "<f4", "(2, 3"),
            ("state", "<f8", "(2, 3, 4"),
            ("impacts", "<u4", "(2, 3"),
            ("peak_impact_velocity", "<f4", "(2, 3"),
            ("periods", "<u4", "(2, 3"),
            ("x", "<f8", "(3,"),
            ("y", "<f8", "(2,"),
            ("config", "<U", "()"),
        ] {
            let header = header(&format!("{name}.npy"));
            assert!(header.contains(kind) && header.contains(shape), "{name}: {header}");
            assert!(header.contains("'fortran_order': False"), "{name}: {header}");
        }
    }

    #[test]
    fn a_damaged_file_is_refused() {
        let bytes = written(&example());
        assert!(matches!(read_map(Cursor::new(&bytes[..bytes.len() / 2])), Err(ReadError::Io(_))));
        // One bit in the middle of an array.
        let whole = written(&example());
        let mut zip = zip::ZipArchive::new(Cursor::new(whole.clone())).unwrap();
        for name in ["regime.npy", "lyapunov.npy", "config.npy"] {
            let entry = zip.by_name(name).unwrap();
            let last = (entry.data_start().unwrap() + entry.compressed_size()) as usize - 1;
            drop(entry);
            let mut damaged = whole.clone();
            damaged[last] ^= 1;
            assert!(read_map(Cursor::new(damaged)).is_err(), "{name}");
        }
        let mut map = example();
        map.verdicts.pop();
        assert!(matches!(read_map(Cursor::new(written_raw(&map))), Err(ReadError::Shape(_))));
    }

    /// An archive whose arrays are one cell short, in one row.
    fn written_raw(map: &RegionMap) -> Vec<u8> {
        let mut short = map.clone();
        short.plane.x.steps.count = 5;
        short.plane.y.steps.count = 1;
        let mut config = map.clone();
        config.verdicts.clear();
        let mut file = Cursor::new(Vec::new());
        write::write_with_config(&short, &config.config(), &mut file).unwrap();
        file.into_inner()
    }
}
