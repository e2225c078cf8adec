//! Tiles of a store: written whole, found, and read.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;
use serde_json::Value;
use tempfile::Builder;
use zarrs::array::codec::CodecOptions;
use zarrs::array::{Array, ArrayError, ElementOwned};
use zarrs::filesystem::FilesystemStore;

use super::skeleton::{INDEX, kind_and_fill, nothing, shard_of};
use super::{HIDDEN, StoreError, ZarrStore};
use crate::plane::fields::{
    Assembled, CELL_FIELDS, CellField, CellResult, Cells, CellsError, Extras, Kind, Values, assembled, of_any,
};
use crate::plane::{Plane, RegionMap, Window};
use crate::store::OutputError;

impl ZarrStore {
    /// Writes the results of a tile's cells, row by row, as shards that appear whole, the regime last.
    ///
    /// # Errors
    /// What the file system reports; the tile is then not there.
    ///
    /// # Panics
    /// If there are not as many verdicts as the tile has cells.
    pub fn write_tile(&self, tile: u32, results: &Assembled) -> Result<(), StoreError> {
        let window = self.tiling.window(tile);
        let Assembled { verdicts, multipliers, extents } = results;
        assert_eq!(verdicts.len(), window.cells(), "a verdict for every cell of the tile");
        let (multipliers, extents) = (multipliers.as_deref(), extents.as_deref());
        let cells = || (0..verdicts.len()).map(|i| CellResult::of(i, verdicts, multipliers, extents));
        let write = |field: &'static CellField| {
            let inner = field.inner.len(self.plane.parameters.family());
            self.write_shard(field, tile, &field.values(cells(), inner))
        };
        let [regime, others @ ..] = CELL_FIELDS else { unreachable!("the table has fields") };
        others.par_iter().filter(|field| field.is_with(self.extras)).try_for_each(write)?;
        write(regime)
    }

    /// Which tiles are there, as whole as they were written.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn tiles_there(&self) -> Result<Vec<bool>, StoreError> {
        let [across, down] = self.tiling.shape();
        let mut found = vec![0_u32; self.tiling.count() as usize];
        let mut fields = 0;
        for field in CellField::of_plane(self.extras) {
            fields += 1;
            for row in 0..down {
                let folder = self.path.join(field.name).join("c").join(row.to_string());
                for column in columns_there(&folder).map_err(|source| self.io(source))? {
                    if column < across {
                        found[(row * across + column) as usize] += 1;
                    }
                }
            }
        }
        Ok(found.into_iter().map(|count| count == fields).collect())
    }

    /// Whether a tile is there.
    pub fn is_there(&self, tile: u32) -> bool {
        CellField::of_plane(self.extras).all(|field| is_whole(&self.shard(field, tile)))
    }

    /// The cells of a window as a map; it must be there altogether.
    ///
    /// # Errors
    /// What could not be read, and cells that were not computed.
    pub fn map_of(&self, window: Window) -> Result<RegionMap, CellsError> {
        let family = self.plane.parameters.family();
        let read = |field: &'static CellField| self.read(field, window);
        let assembled = assembled::<CellsError>(family, window.cells(), self.extras, read)?;
        Ok(assembled.map(window.plane(&self.plane), self.provenance.clone()))
    }

    /// Removes what interrupted processes left out of sight, and nothing else has been using for a day.
    pub fn tidy(&self) {
        const LONG: std::time::Duration = std::time::Duration::from_secs(24 * 3600);
        let Ok(entries) = fs::read_dir(self.path.join(HIDDEN)) else { return };
        for path in entries.flatten().map(|entry| entry.path()) {
            let is_part = path.extension().is_some_and(|extension| extension == "part");
            let age =
                fs::metadata(&path).and_then(|about| about.modified()).ok().and_then(|at| at.elapsed().ok());
            if is_part && age.is_some_and(|age| age > LONG) {
                let _ = fs::remove_file(path);
            }
        }
    }

    /// The file of a shard.
    fn shard(&self, field: &CellField, tile: u32) -> PathBuf {
        let [column, row] = self.tiling.place(tile);
        let mut path = self.path.join(field.name).join("c").join(row.to_string()).join(column.to_string());
        for _ in field.inner.dimensions(self.plane.parameters.family()) {
            path.push("0");
        }
        path
    }

    fn write_shard(&self, field: &'static CellField, tile: u32, values: &Values) -> Result<(), StoreError> {
        let path = self.shard(field, tile);
        let bytes = self.encoded(field, tile, values).map_err(|error| self.io(error))?;
        self.show(&path, &bytes).map_err(|source| StoreError::Output(OutputError::of_writing(&path, source)))
    }

    /// Puts bytes into a file that appears whole.
    fn show(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        let mut builder = Builder::new();
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask
        let mut file = builder.suffix(".part").tempfile_in(self.path.join(HIDDEN))?;
        file.write_all(bytes)?;
        file.as_file().sync_data()?;
        match file.persist(path) {
            Ok(_) => Ok(()),
            // Another process wrote the same.
            Err(_) if path.is_file() => Ok(()),
            Err(error) => Err(error.error),
        }
    }

    /// The bytes of a shard: the tile's values, and where the tile reaches beyond the plane what stands for nothing.
    fn encoded(&self, field: &'static CellField, tile: u32, values: &Values) -> io::Result<Vec<u8>> {
        let (window, side) = (self.tiling.window(tile), self.tiling.side);
        let shape = [&[u64::from(side); 2][..], &field.shape(&self.plane)[2..]].concat();
        let inner = field.inner.len(self.plane.parameters.family());
        let (kind, fill) = kind_and_fill(field);
        let nothing = nothing(field);
        of_any!(values, values => shard_of(&padded(values, window, inner, side, nothing as _), &shape, kind, fill))
            .map_err(io::Error::other)
    }

    fn indices(&self, field: &CellField, tile: u32) -> Vec<u64> {
        let [column, row] = self.tiling.place(tile);
        let inner = field.inner.dimensions(self.plane.parameters.family()).len();
        [row.into(), column.into()].into_iter().chain(std::iter::repeat_n(0, inner)).collect()
    }

    fn array(&self, field: &CellField) -> Result<Array<FilesystemStore>, StoreError> {
        let name = format!("/{}", field.name);
        Array::open(Arc::clone(&self.storage), &name).map_err(|error| StoreError::Foreign {
            path: self.path.clone(),
            reason: format!("its array {} is not there or not understood: {error}", field.name),
        })
    }

    /// A field of the cells of a window, tile by tile: only whole chunks are held against their checksums.
    fn elements<T: ElementOwned + Copy + Send + Sync>(
        &self,
        field: &'static CellField,
        window: Window,
        nothing: T,
    ) -> Result<Vec<T>, StoreError> {
        let array = self.array(field)?;
        let inner = field.inner.len(self.plane.parameters.family());
        let mut found = vec![nothing; window.cells() * inner];
        let touched = self.tiling.touched(&window);
        // Some tiles at a time, so that no more memory is needed than for the window and those.
        for tiles in touched.chunks(2 * rayon::current_num_threads().max(1)) {
            let chunk = |&tile: &u32| -> Result<(u32, Option<Vec<T>>), StoreError> {
                let mut options = CodecOptions::default();
                options.set_concurrent_target(1);
                let indices = self.indices(field, tile);
                let read = array.retrieve_chunk_elements_if_exists_opt::<T>(&indices, &options);
                let damaged = |error: ArrayError| StoreError::Damaged {
                    path: self.shard(field, tile),
                    reason: error.to_string(),
                };
                Ok((tile, read.map_err(damaged)?))
            };
            let read: Vec<(u32, Option<Vec<T>>)> = tiles.par_iter().map(chunk).collect::<Result<_, _>>()?;
            for (tile, values) in read {
                let Some(values) = values else { continue };
                let own = self.tiling.window(tile);
                let shared = own.shared(&window);
                let length = shared.columns as usize * inner;
                for row in shared.row..shared.row + shared.rows {
                    let from = ((row - own.row) as usize * self.tiling.side as usize
                        + (shared.column - own.column) as usize)
                        * inner;
                    let to = window.index((shared.column, row)) * inner;
                    found[to..to + length].copy_from_slice(&values[from..from + length]);
                }
            }
        }
        Ok(found)
    }
}

impl Cells for ZarrStore {
    fn plane(&self) -> Plane<()> {
        self.plane.asking(())
    }

    fn configuration(&self) -> Value {
        self.configuration.clone()
    }

    fn extras(&self) -> Extras {
        self.extras
    }

    fn read(&self, field: &'static CellField, window: Window) -> Result<Values, CellsError> {
        let nothing = nothing(field);
        Ok(match field.kind() {
            Kind::U8 => Values::U8(self.elements(field, window, nothing as u8)?),
            Kind::U16 => Values::U16(self.elements(field, window, nothing as u16)?),
            Kind::U32 => Values::U32(self.elements(field, window, nothing as u32)?),
            Kind::F32 => Values::F32(self.elements(field, window, nothing as f32)?),
            Kind::F64 => Values::F64(self.elements(field, window, nothing)?),
        })
    }

    fn band(&self) -> u32 {
        self.tiling.side
    }
}

/// The columns of the tiles whose shards are in a folder of one row of tiles.
fn columns_there(folder: &Path) -> io::Result<Vec<u32>> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries?,
    };
    let mut columns = Vec::new();
    for entry in entries {
        let entry = entry?;
        let Some(column) = entry.file_name().to_str().and_then(|name| name.parse().ok()) else { continue };
        // A field of several values for every cell has its shards one or two folders further down.
        let mut path = entry.path();
        while path.is_dir() && path.join("0").exists() {
            path.push("0");
        }
        if is_whole(&path) {
            columns.push(column);
        }
    }
    Ok(columns)
}

/// Whether a shard is there, and no shorter or longer than its index says. What was changed within it, reading finds by its checksum.
fn is_whole(path: &Path) -> bool {
    let length = || -> io::Result<bool> {
        let mut file = File::open(path)?;
        let mut index = [0; INDEX];
        file.seek(SeekFrom::End(-(INDEX as i64)))?;
        file.read_exact(&mut index)?;
        let number = |at: usize| u64::from_le_bytes(std::array::from_fn(|i| index[at + i]));
        Ok(number(0) == 0 && Some(number(8)) == file.metadata()?.len().checked_sub(INDEX as u64))
    };
    length().unwrap_or(false)
}

/// A tile's values in a square of its side.
fn padded<T: Copy>(values: &[T], window: Window, inner: usize, side: u32, nothing: T) -> Vec<T> {
    let (row, full) = (window.columns as usize * inner, side as usize * inner);
    if window.columns == side && window.rows == side {
        return values.to_vec();
    }
    let mut square = vec![nothing; full * side as usize];
    for (from, to) in values.chunks_exact(row).zip(square.chunks_exact_mut(full)) {
        to[..row].copy_from_slice(from);
    }
    square
}
