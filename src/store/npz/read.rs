//! Reading a map back.

use std::io::{self, Read, Seek};

use npyz::{Deserialize as FromNpy, NpyFile};
use serde::Deserialize;
use thiserror::Error;
use zip::ZipArchive;

use crate::analysis::{Counts, Regime, Verdict};
use crate::model::StateVector;
use crate::plane::{Multipliers, Plane, Provenance, RegionMap};

/// Reads a map that [`write_map`](super::write_map) wrote.
///
/// What the file does not hold, the impacts over the whole trajectory, reads as 0.
///
/// # Errors
/// What is missing from the file or does not fit together in it.
pub fn read_map(from: impl Read + Seek) -> Result<RegionMap, ReadError> {
    #[derive(Deserialize)]
    struct Config {
        #[serde(flatten)]
        provenance: Provenance,
        #[serde(flatten)]
        plane: Plane,
    }
    let mut zip = ZipArchive::new(from).map_err(io::Error::from)?;
    let config = values::<String>(&mut zip, "config", &[])?.concat();
    let Config { provenance, plane } = serde_json::from_str(&config)?;
    let verdicts = verdicts(&mut zip, &plane)?;
    let multipliers = multipliers(&mut zip, &plane)?;
    Ok(RegionMap { plane, provenance, verdicts, multipliers })
}

/// Reads the configuration text of an archive of this crate.
///
/// # Errors
/// What is missing from the file.
pub fn read_config(from: impl Read + Seek) -> Result<String, ReadError> {
    let mut zip = ZipArchive::new(from).map_err(io::Error::from)?;
    Ok(values::<String>(&mut zip, "config", &[])?.concat())
}

/// The multipliers of a map that was certified.
fn multipliers(
    zip: &mut ZipArchive<impl Read + Seek>,
    plane: &Plane,
) -> Result<Option<Vec<Option<Multipliers>>>, ReadError> {
    if zip.index_for_name(&npyz::npz::file_name_from_array_name("multipliers")).is_none() {
        return Ok(None);
    }
    let count = 2 * plane.parameters.family().n();
    let shape = [plane.y.count.into(), plane.x.count.into(), count as u64, 2];
    let numbers: Vec<f64> = values(zip, "multipliers", &shape)?;
    let (pairs, _) = numbers.as_chunks::<2>();
    Ok(Some(pairs.chunks(count).map(|cell| (!cell[0][0].is_nan()).then(|| cell.to_vec())).collect()))
}

fn verdicts(zip: &mut ZipArchive<impl Read + Seek>, plane: &Plane) -> Result<Vec<Verdict>, ReadError> {
    let cells = [u64::from(plane.y.count), u64::from(plane.x.count)];
    let regimes: Vec<u8> = values(zip, "regime", &cells)?;
    let n: Vec<u16> = values(zip, "n", &cells)?;
    let stops = plane.parameters.family().stops().len();
    let counts: Vec<u16> = values(zip, "counts", &[cells[0], cells[1], stops as u64])?;
    let symmetric: Vec<u8> = values(zip, "symmetric", &cells)?;
    let lyapunov: Vec<f32> = values(zip, "lyapunov", &cells)?;
    let length = 2 * plane.parameters.family().n();
    let states: Vec<f64> = values(zip, "state", &[cells[0], cells[1], length as u64])?;
    let impacts: Vec<u32> = values(zip, "impacts", &cells)?;
    let peaks: Vec<f32> = values(zip, "peak_impact_velocity", &cells)?;
    let periods: Vec<u32> = values(zip, "periods", &cells)?;
    let verdict = |(i, &code): (usize, &u8)| {
        Ok(Verdict {
            regime: Regime::from_code(code).ok_or(ReadError::Regime(code))?,
            n: n[i],
            counts: Counts::new(&counts[stops * i..][..stops]),
            symmetric: symmetric[i] != 0,
            lyapunov: lyapunov[i],
            state: StateVector::from_slice(&states[length * i..][..length])
                .ok_or(ReadError::Shape("state"))?,
            impacts: impacts[i],
            impacts_total: 0,
            peak_impact_velocity: peaks[i],
            periods: periods[i],
            returning: 0,
        })
    };
    regimes.iter().enumerate().map(verdict).collect()
}

fn values<T: FromNpy>(
    zip: &mut ZipArchive<impl Read + Seek>,
    name: &'static str,
    shape: &[u64],
) -> Result<Vec<T>, ReadError> {
    let entry = zip.by_name(&npyz::npz::file_name_from_array_name(name)).map_err(io::Error::from)?;
    let array = NpyFile::new(entry)?;
    if array.shape() != shape {
        return Err(ReadError::Shape(name));
    }
    Ok(array.into_vec()?)
}

/// Why a map could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file is damaged, not an archive, lacks an array, or could not be read.
    #[error("the map's archive could not be read")]
    Io(#[from] io::Error),
    /// The configuration is not one of a map.
    #[error("the map's configuration is not understood")]
    Config(#[from] serde_json::Error),
    /// An array does not fit the axes.
    #[error("the array `{0}` does not fit the axes of the map")]
    Shape(&'static str),
    /// A code that no regime has.
    #[error("{0} is not the code of a regime")]
    Regime(u8),
}
