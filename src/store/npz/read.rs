//! Reading a map back.

use std::io::{self, Read, Seek};

use npyz::{Deserialize as FromNpy, NpyFile};
use serde_json::Value;
use thiserror::Error;
use zip::ZipArchive;

use crate::plane::fields::{CellField, CellsError, Extras, Kind, Values, assembled};
use crate::plane::{Made, Plane, RegionMap, Window};

/// Reads a map that [`write_map`](super::write_map) wrote.
///
/// What the file does not hold, the impacts over the whole trajectory, reads as 0.
///
/// # Errors
/// What is missing from the file or does not fit together in it.
pub fn read_map(from: impl Read + Seek) -> Result<RegionMap, ReadError> {
    let mut zip = ZipArchive::new(from).map_err(io::Error::from)?;
    let config = values::<String>(&mut zip, "config", &[])?.concat();
    let config: Value = serde_json::from_str(&config)?;
    if config.get("control").is_some() {
        return Err(ReadError::UnderControl);
    }
    let Made { provenance, plane, .. } = serde_json::from_value(config)?;
    let has = |name: &str| zip.index_for_name(&npyz::npz::file_name_from_array_name(name)).is_some();
    let extras = Extras { certified: has("multipliers"), extents: has("rms") };
    let cells = Window::whole(&plane).cells();
    let family = plane.parameters.family();
    let assembled = assembled::<ReadError>(family, cells, extras, |of| field(&mut zip, &plane, of))?;
    Ok(assembled.map(plane, provenance))
}

/// Reads the configuration text of an archive of this crate.
///
/// # Errors
/// What is missing from the file.
pub fn read_config(from: impl Read + Seek) -> Result<String, ReadError> {
    let mut zip = ZipArchive::new(from).map_err(io::Error::from)?;
    Ok(values::<String>(&mut zip, "config", &[])?.concat())
}

/// A field of all cells.
fn field(
    zip: &mut ZipArchive<impl Read + Seek>,
    plane: &Plane,
    field: &'static CellField,
) -> Result<Values, ReadError> {
    let shape = field.shape(plane);
    Ok(match field.kind() {
        Kind::U8 => Values::U8(values(zip, field.name, &shape)?),
        Kind::U16 => Values::U16(values(zip, field.name, &shape)?),
        Kind::U32 => Values::U32(values(zip, field.name, &shape)?),
        Kind::F32 => Values::F32(values(zip, field.name, &shape)?),
        Kind::F64 => Values::F64(values(zip, field.name, &shape)?),
    })
}

fn values<T: FromNpy>(
    zip: &mut ZipArchive<impl Read + Seek>,
    name: &'static str,
    shape: &[u64],
) -> Result<Vec<T>, ReadError> {
    let mut entry = zip.by_name(&npyz::npz::file_name_from_array_name(name)).map_err(io::Error::from)?;
    let array = NpyFile::new(&mut entry)?;
    if array.shape() != shape {
        return Err(ReadError::Shape(name));
    }
    let values = array.into_vec()?;
    // The archive compares its checksum where an entry ends.
    io::copy(&mut entry, &mut io::sink())?;
    Ok(values)
}

/// Why a map could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file is damaged, not an archive, lacks an array, or could not be read.
    #[error("the map's archive could not be read")]
    Io(#[from] io::Error),
    /// It is a map under control.
    #[error("it is a map under control: `map --control` draws it, and its times, anew")]
    UnderControl,
    /// The configuration is not one of a map.
    #[error("the map's configuration is not understood")]
    Config(#[from] serde_json::Error),
    /// An array does not fit the axes.
    #[error("the array `{0}` does not fit the axes of the map")]
    Shape(&'static str),
    /// A value that cannot be.
    #[error(transparent)]
    Cells(#[from] CellsError),
}
