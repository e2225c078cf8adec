//! One cell of a map that was computed before, from the map's own file.

use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::str::FromStr;

use anyhow::Context;
use impact_atlas::figure::carried_configuration;
use impact_atlas::plane::fields::{Cells, Extras};
use impact_atlas::plane::{Axis, Made, Plane};
use impact_atlas::store::{ZarrStore, read_config};
use serde::Serialize;
use thiserror::Error;

use super::{CliError, Result, wrong};

/// A place on a plane, `NAME=VALUE,NAME=VALUE`: a value for either axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Place([(String, f64); 2]);

impl FromStr for Place {
    type Err = PlaceError;

    fn from_str(text: &str) -> Result<Self, PlaceError> {
        let malformed = || PlaceError(text.to_owned());
        let value = |part: &str| -> Option<(String, f64)> {
            let (name, value) = part.split_once('=')?;
            let value: f64 = value.trim().parse().ok()?;
            value.is_finite().then_some((name.trim().to_owned(), value))
        };
        let parts: Option<Vec<_>> = text.split(',').map(value).collect();
        Ok(Place(parts.ok_or_else(malformed)?.try_into().map_err(|_| malformed())?))
    }
}

/// A text that is not a place.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "`{0}` is not a place: write NAME=VALUE,NAME=VALUE with the names of the map's axes, for example omega=3.7,delta=0.1"
)]
pub struct PlaceError(String);

/// Where a cell is on its plane.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cell {
    /// Its column.
    pub column: u32,
    /// Its row.
    pub row: u32,
    /// Its value on the horizontal axis.
    pub x: f64,
    /// Its value on the vertical axis.
    pub y: f64,
}

/// Reads the configuration that a map's picture or data carry.
pub fn made(path: &Path) -> Result<Made> {
    let name = path.display();
    if path.is_dir() {
        let store = ZarrStore::open(path)?;
        let (plane, provenance) = (store.plane().clone(), store.provenance().clone());
        let Extras { certified, extents } = store.extras();
        return Ok(Made { plane, provenance, certified, extents });
    }
    let bytes = fs::read(path).with_context(|| format!("cannot read `{name}`")).map_err(CliError::Input)?;
    let carried = if bytes.starts_with(b"PK") {
        read_config(Cursor::new(bytes)).ok()
    } else {
        carried_configuration(&bytes)
    };
    let none = || wrong!("`{name}` carries no configuration: give a file that `map` wrote");
    let value: serde_json::Value =
        carried.and_then(|text| serde_json::from_str(&text).ok()).ok_or_else(none)?;
    if value.get("control").is_some() {
        return Err(wrong!(
            "`{name}` is a map under control, and --from takes maps without: follow a cell with `control`, or repeat the command \
             that is in the picture"
        ));
    }
    let Ok(made) = serde_json::from_value::<Made>(value) else {
        return Err(wrong!("`{name}` is no map: give a file that `map` wrote"));
    };
    made.plane.check().map_err(CliError::input)?;
    Ok(made)
}

impl Cell {
    /// The cell of a plane that holds a place.
    pub fn holding(Place(values): &Place, Plane { x, y, .. }: &Plane) -> Result<Self> {
        let on = |axis: &Axis| {
            let value = values.iter().find(|(name, _)| name == axis.quantity.name()).map(|(_, value)| *value);
            value.ok_or_else(|| {
                wrong!(
                    "the map's axes are {} and {}: --at must give a value for either",
                    x.quantity.name(),
                    y.quantity.name()
                )
            })
        };
        let (column, row) = (index(x, on(x)?)?, index(y, on(y)?)?);
        Ok(Cell { column, row, x: x.value(column), y: y.value(row) })
    }
}

/// The index of the cell that holds a value.
fn index(axis: &Axis, value: f64) -> Result<u32> {
    let steps = f64::from(axis.count - 1);
    let at = if axis.count == 1 { value - axis.first } else { axis.place(value) };
    let rounding = 1e-9 * value.abs();
    let half = if axis.count == 1 { rounding } else { 0.5 };
    if !(-half..=steps + half).contains(&at) {
        return Err(wrong!("{} = {value} lies outside the map, whose axis is {axis}", axis.quantity.name()));
    }
    Ok(at.round().clamp(0.0, steps) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_belongs_to_the_nearest_cell() {
        let axis: Axis = "omega=1:3:5".parse().unwrap();
        for (value, expected) in [(1.0, 0), (1.24, 0), (1.26, 1), (3.0, 4), (0.76, 0), (3.24, 4)] {
            assert_eq!(index(&axis, value).unwrap(), expected, "{value}");
        }
        assert!(index(&axis, 0.74).is_err() && index(&axis, 3.26).is_err());
        let single: Axis = "delta=0.1:0.1:1".parse().unwrap();
        assert_eq!(index(&single, 0.1).unwrap(), 0);
        assert!(index(&single, 0.2).is_err());
    }

    #[test]
    fn on_an_axis_of_equal_ratios_the_nearest_cell_is_that_of_the_ratio() {
        let axis: Axis = "omega=0.1:10:5:log".parse().unwrap();
        for i in 0..5 {
            assert_eq!(index(&axis, axis.value(i)).unwrap(), i);
        }
        assert_eq!((index(&axis, 0.17).unwrap(), index(&axis, 0.18).unwrap()), (0, 1));
        assert!(index(&axis, 0.0).is_err() && index(&axis, -1.0).is_err());
    }

    #[test]
    fn places_are_read_and_bad_ones_are_named() {
        assert!("omega=3.7, delta=0.1".parse::<Place>().is_ok());
        for text in
            ["", "omega=1", "omega=1,delta", "omega=1,delta=x", "omega=1,delta=2,r=0.5", "omega=nan,delta=1"]
        {
            assert_eq!(text.parse::<Place>(), Err(PlaceError(text.to_owned())));
        }
    }
}
