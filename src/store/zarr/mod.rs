//! A plane in a Zarr store (version 3): one array for every field, one shard for every tile.
//!
//! A store is made whole, empty, and renamed into place; shards are written out of sight and renamed into place, the
//! regime last. So a tile that is there is there altogether, whatever was interrupted, and processes that write into one
//! store work independently: where two write the same tile they write the same bytes. What every process did is
//! noted in the folder `.impact-atlas` of the store, which readers of Zarr do not see.

mod difference;
mod error;
mod log;
mod skeleton;
mod status;
mod tiles;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::Value;
use tempfile::Builder;
use zarrs::filesystem::FilesystemStore;
use zarrs::group::Group;

use self::skeleton::{FORMAT, Skeleton};
use super::OutputError;
use crate::plane::fields::Extras;
use crate::plane::{Made, Plane, Provenance, Tiling};

pub use error::StoreError;
pub use log::{Event, Log};
pub use status::{Failure, Status};

/// Where a store keeps what is not Zarr's.
const HIDDEN: &str = ".impact-atlas";

/// A plane in a Zarr store, of which some tiles are there.
#[derive(Debug)]
pub struct ZarrStore {
    path: PathBuf,
    plane: Plane,
    provenance: Provenance,
    configuration: Value,
    extras: Extras,
    tiling: Tiling,
    storage: Arc<FilesystemStore>,
}

/// A plane to be computed into a store, and by what.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// The plane.
    pub plane: &'a Plane,
    /// What computes it.
    pub provenance: &'a Provenance,
    /// What is computed beyond verdicts.
    pub extras: Extras,
    /// The side of its tiles; where it is none, that of the store, or the usual one of the plane.
    pub tile: Option<u32>,
}

impl Wanted<'_> {
    fn configuration(&self) -> Value {
        let mut configuration = self.provenance.configuration(self.plane);
        if self.extras.certified {
            configuration["certified"] = true.into();
        }
        if self.extras.extents {
            configuration["extents"] = true.into();
        }
        configuration
    }
}

impl ZarrStore {
    /// Opens the store of a plane at a path, or makes an empty one there.
    ///
    /// # Errors
    /// [`StoreError::Differs`] for a store of anything else, with what differs; whatever [`ZarrStore::open`] refuses; and
    /// what the file system reports.
    pub fn of(path: &Path, wanted: &Wanted) -> Result<Self, StoreError> {
        if !path.exists() {
            create(path, wanted)?;
        }
        let store = ZarrStore::open(path)?;
        let mut differences = difference::differences(&store.configuration, &wanted.configuration());
        if let Some(side) = wanted.tile.filter(|&side| side != store.tiling.side) {
            differences.push(format!("the tile is {} there and {side} here", store.tiling.side));
        }
        if differences.is_empty() {
            Ok(store)
        } else {
            Err(StoreError::Differs { path: path.to_owned(), differences })
        }
    }

    /// Opens a store.
    ///
    /// # Errors
    /// What is not there, is no store of this program, or has another format.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let foreign = |reason: String| StoreError::Foreign { path: path.to_owned(), reason };
        if !path.exists() {
            return Err(StoreError::Missing(path.to_owned()));
        }
        if !path.is_dir() {
            return Err(foreign("it is a file".to_owned()));
        }
        let storage = Arc::new(FilesystemStore::new(path).map_err(|error| foreign(error.to_string()))?);
        let group =
            Group::open(storage.clone(), "/").map_err(|_| foreign("it is no Zarr group".to_owned()))?;
        let about = group.attributes();
        let format = about.get("impact_atlas_format").and_then(Value::as_u64);
        let found = format.ok_or_else(|| foreign("another program wrote it".to_owned()))?;
        if found != FORMAT {
            let version = about.get("version").and_then(Value::as_str).unwrap_or("unknown").to_owned();
            return Err(StoreError::Format { path: path.to_owned(), found, known: FORMAT, version });
        }
        let text = about.get("config").and_then(Value::as_str).unwrap_or_default();
        let not_understood =
            |error: serde_json::Error| foreign(format!("its configuration is not understood: {error}"));
        let configuration: Value = serde_json::from_str(text).map_err(not_understood)?;
        let Made { provenance, plane, certified, extents } =
            serde_json::from_value(configuration.clone()).map_err(not_understood)?;
        let side = about.get("tile").and_then(Value::as_u64).and_then(|side| u32::try_from(side).ok());
        let side = side.filter(|side| (1..=Tiling::LARGEST).contains(side));
        let side = side.ok_or_else(|| foreign("it does not say how large its tiles are".to_owned()))?;
        let tiling = Tiling::of(&plane, side);
        let extras = Extras { certified, extents };
        Ok(ZarrStore { path: path.to_owned(), plane, provenance, configuration, extras, tiling, storage })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its plane.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// What computes it.
    pub fn provenance(&self) -> &Provenance {
        &self.provenance
    }

    /// Its tiles.
    pub fn tiling(&self) -> Tiling {
        self.tiling
    }

    fn io(&self, source: io::Error) -> StoreError {
        StoreError::Io { path: self.path.clone(), source }
    }
}

/// Makes an empty store, which appears whole. Where another process was faster, its store stays.
fn create(path: &Path, wanted: &Wanted) -> Result<(), StoreError> {
    if let Some(side) = wanted.tile.filter(|side| !(1..=Tiling::LARGEST).contains(side)) {
        return Err(StoreError::Tile(side));
    }
    let name = path.file_name().ok_or_else(|| OutputError::NoName(path.to_owned()))?;
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !parent.is_dir() {
        return Err(OutputError::NoParent { path: path.to_owned(), parent: parent.to_owned() }.into());
    }
    let unwritable =
        |source| OutputError::Unwritable { path: path.to_owned(), parent: parent.to_owned(), source };
    let hidden =
        Builder::new().prefix(".impact-atlas-").suffix(".part").tempdir_in(parent).map_err(unwritable)?;
    let tiling = match wanted.tile {
        Some(side) => Tiling::of(wanted.plane, side),
        None => Tiling::usual(wanted.plane),
    };
    let configuration = wanted.configuration();
    let Wanted { plane, provenance, extras, .. } = *wanted;
    // A folder of its own, with the permissions that any folder gets.
    let empty = hidden.path().join(name);
    let failed = |source| StoreError::Io { path: path.to_owned(), source };
    fs::create_dir_all(empty.join(HIDDEN)).map_err(failed)?;
    let skeleton = Skeleton { plane, provenance, configuration: &configuration, extras, tiling };
    skeleton.write(&empty).map_err(|error| failed(io::Error::other(error)))?;
    match fs::rename(&empty, path) {
        Err(error) if !path.is_dir() => Err(failed(error)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests;
