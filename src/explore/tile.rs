//! A tile: what its cells settle on, and its bytes on the way to a page.

use super::lattice::{SIDE, TileKey};
use crate::analysis::{Extent, Verdict};

/// The first byte of a message that holds a tile.
pub const TILE: u8 = 1;
/// The first byte of a message that holds a file.
pub const FILE: u8 = 2;
/// The version of the layout; a page of another version asks to be loaded anew.
pub const VERSION: u8 = 1;
/// The motion of a cell that the system does not have: its parameters are out of their ranges, or it cannot be followed.
pub const NOWHERE: u16 = u16::MAX;
/// The bytes before the fields.
pub const HEADER: usize = 32;
/// The bytes of a cell's fields: motion and N of 2 bytes, three numbers of 4.
pub const CELL: usize = 2 + 2 + 4 + 4 + 4;

/// The cells of a tile, row by row, the lowest row first; none where there is no such system.
pub type Cells = Vec<Option<Verdict>>;

/// How far the motions of a tile's cells go, in the same order; [`Extent::NONE`] where there is no such system, or it does not begin.
pub type Extents = Vec<Extent>;

/// A tile's message: the header, then one array per field, all little-endian; see the protocol.
///
/// `motions` has the motion of each cell by its number on the plane, `numbers` what the layer that is shown has of it, after
/// the layer's own number.
pub fn encoded(
    scene: u32,
    key: TileKey,
    cells: &Cells,
    motions: &[u16],
    (layer, numbers): (u32, &[f32]),
) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + cells.len() * CELL);
    bytes.extend([TILE, VERSION]);
    bytes.extend((SIDE as u16).to_le_bytes());
    bytes.extend(scene.to_le_bytes());
    bytes.extend(key.z.to_le_bytes());
    bytes.extend(layer.to_le_bytes());
    bytes.extend((key.i as f64).to_le_bytes());
    bytes.extend((key.j as f64).to_le_bytes());
    let number = |of: fn(&Verdict) -> f32| {
        cells.iter().flat_map(move |cell| cell.as_ref().map_or(f32::NAN, of).to_le_bytes())
    };
    bytes.extend(motions.iter().flat_map(|motion| motion.to_le_bytes()));
    bytes.extend(cells.iter().flat_map(|cell| cell.as_ref().map_or(0, |v| v.n).to_le_bytes()));
    bytes.extend(number(|v| v.lyapunov));
    bytes.extend(number(|v| v.peak_impact_velocity));
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes
}

/// A file's message: which task it answers, then its bytes.
pub fn file(task: u32, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(8 + content.len());
    bytes.extend([FILE, VERSION, 0, 0]);
    bytes.extend(task.to_le_bytes());
    bytes.extend(content);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Regime;
    use crate::explore::lattice::SIDE;

    const SCRIPT: &str = include_str!("page/protocol.js");
    const DOCUMENT: &str = include_str!("protocol.md");

    fn verdict() -> Verdict {
        let motion = Verdict::of_motion(Regime::Periodic, [2, 3, 4], false);
        Verdict { lyapunov: -0.25, impacts: 70, peak_impact_velocity: 1.5, periods: 450, ..motion }
    }

    #[test]
    fn a_tile_is_laid_out_as_the_protocol_says() {
        let mut cells: Cells = vec![None; 256];
        cells[17] = Some(verdict());
        let motions: Vec<u16> = (0..256).map(|i| if i == 17 { 5 } else { NOWHERE }).collect();
        let key = TileKey { z: -2, i: -3, j: 1 << 40 };
        let numbers: Vec<f32> = (0..256_u16).map(f32::from).collect();
        let bytes = encoded(7, key, &cells, &motions, (3, &numbers));
        assert_eq!(bytes.len(), HEADER + 256 * CELL);
        assert_eq!(bytes[..4], [1, 1, 16, 0]);
        assert_eq!(bytes[4..8], 7_u32.to_le_bytes());
        assert_eq!(bytes[8..12], (-2_i32).to_le_bytes());
        assert_eq!(bytes[12..16], 3_u32.to_le_bytes());
        assert_eq!(bytes[16..24], (-3.0_f64).to_le_bytes());
        assert_eq!(bytes[24..32], (2.0_f64.powi(40)).to_le_bytes());
        let at = |field: usize, width: usize, cell: usize| {
            let start = HEADER + field * 256 + width * cell;
            &bytes[start..start + width]
        };
        assert_eq!(at(0, 2, 17), 5_u16.to_le_bytes());
        assert_eq!(at(0, 2, 18), NOWHERE.to_le_bytes());
        assert_eq!(at(2, 2, 17), 2_u16.to_le_bytes());
        assert_eq!(at(4, 4, 17), (-0.25_f32).to_le_bytes());
        assert_eq!(at(8, 4, 17), 1.5_f32.to_le_bytes());
        assert_eq!(at(12, 4, 17), 17.0_f32.to_le_bytes());
        assert!(f32::from_le_bytes(at(4, 4, 0).try_into().unwrap()).is_nan());
    }

    #[test]
    fn both_ends_have_the_same_numbers() {
        let said = |name: &str, value: u32| {
            assert!(SCRIPT.contains(&format!("export const {name} = {value};")), "{name} = {value}");
        };
        said("VERSION", VERSION.into());
        said("SIDE", SIDE);
        said("TILE", TILE.into());
        said("FILE", FILE.into());
        said("NOWHERE", NOWHERE.into());
        said("HEADER", HEADER as u32);
        assert!(!SCRIPT.contains("export const SIDE = 17;"));
        assert!(DOCUMENT.contains("begins with 32 bytes") && DOCUMENT.contains("16 × 16 cells"));
    }

    /// The quoted words of a list in the script.
    fn listed(name: &str) -> Vec<&'static str> {
        let list = SCRIPT.split_once(&format!("export const {name} = [")).unwrap().1;
        let list = list.split_once(']').unwrap().0;
        list.split(',').map(|word| word.trim().trim_matches('\'')).filter(|word| !word.is_empty()).collect()
    }

    #[test]
    fn both_ends_have_the_same_messages() {
        let plane = r#"{"system":{"name":"luo-ma-lv"},"x":"omega=1:2:3","y":"delta=0:1:4","set":{"r":0.5},
            "start":"rest","transient":1,"observe":1,"max_period":1,"backend":"cpu"}"#;
        let window = r#"{"z":0,"columns":[0,3],"rows":[0,2]}"#;
        let examples = [
            ("open", format!(r#""ask":1,"plane":{plane}"#)),
            ("want", r#""scene":1,"tiles":[[0,1,-2]],"layer":null"#.to_owned()),
            ("legend", r#""ask":1,"scene":1,"cells":[[0,12]],"rows":9"#.to_owned()),
            ("axes", r#""ask":1,"scene":1,"x":[0,1],"y":[0,1],"size":[300,200],"em":13"#.to_owned()),
            ("bar", format!(r#""ask":1,"scene":1,"layer":"peak","window":{window},"length":200,"em":12"#)),
            ("probe", r#""ask":1,"scene":1,"cell":[0,1,2],"width":300"#.to_owned()),
            ("curves", format!(r#""ask":1,"scene":1,"window":{window},"max_period":2,"all":false"#)),
            ("slice", r#""ask":1,"scene":1,"from":[0,1],"to":[2,3],"columns":9,"width":500"#.to_owned()),
            (
                "save",
                format!(r#""ask":1,"scene":1,"window":{window},"format":"png","size":[9,9],"curves":null"#),
            ),
            ("command", format!(r#""ask":1,"scene":1,"window":{window},"size":[9,9],"curves":2"#)),
            ("cancel", r#""ask":1"#.to_owned()),
        ];
        assert_eq!(listed("REQUESTS"), examples.each_ref().map(|(name, _)| *name));
        for (name, rest) in examples {
            let read = |text: String| serde_json::from_str::<crate::explore::request::Request>(&text);
            read(format!(r#"{{"type":"{name}",{rest}}}"#)).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(read(format!(r#"{{"type":"{name}",{rest},"more":1}}"#)).is_err(), "{name}");
            assert!(DOCUMENT.contains(&format!("| `{name}` |")), "{name}");
        }
        for name in listed("MESSAGES") {
            assert!(DOCUMENT.contains(&format!("`{name}`")), "{name}");
        }
    }
}
