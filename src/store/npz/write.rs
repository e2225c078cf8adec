//! Writing a map.

use std::cmp::Reverse;
use std::io::{self, BufWriter, Cursor, Seek, Write};

use npyz::{AutoSerialize, DType, WriteOptions, WriterBuilder};
use rayon::prelude::*;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::fused::Fused;
use crate::plane::fields::{CellField, CellResult, Cells, of_any};
use crate::plane::{Plane, RegionMap};

/// Writes a map as a NumPy archive; `numpy.load` reads it, without pickles.
///
/// # Errors
/// What the file system reports.
pub fn write_map(map: &RegionMap, to: impl Write + Seek) -> io::Result<()> {
    write_with_config(map, &map.config(), to)
}

/// Writes the arrays of `map` with the given configuration text.
pub(super) fn write_with_config(map: &RegionMap, config: &str, to: impl Write + Seek) -> io::Result<()> {
    let plane = &map.plane;
    let (multipliers, extents) = (map.multipliers.as_deref(), map.extents.as_deref());
    let cells = (0..map.verdicts.len()).map(|i| CellResult::of(i, &map.verdicts, multipliers, extents));
    let mut archive = Archive::new(to);
    archive.cells(plane, CellField::of_plane(map.extras()), cells)?;
    archive.array("x", &[plane.x.count.into()], plane.x.values())?;
    archive.array("y", &[plane.y.count.into()], plane.y.values())?;
    archive.text("config", config)?;
    archive.finish()
}

/// An archive under way.
pub(super) struct Archive<W: Write + Seek> {
    zip: ZipWriter<Fused<W>>,
}

impl<W: Write + Seek> Archive<W> {
    /// An empty archive.
    pub fn new(to: W) -> Self {
        Archive { zip: ZipWriter::new(Fused::new(to)) }
    }

    /// Completes the archive.
    pub fn finish(self) -> io::Result<()> {
        self.zip.finish()?.end()
    }

    /// An array for each of some fields of a plane's cells, the largest first: all of them are compressed beside each other, and
    /// held until they are written.
    pub fn cells<'a, T: Sync>(
        &mut self,
        plane: &Plane<T>,
        fields: impl Iterator<Item = &'static CellField>,
        cells: impl Iterator<Item = CellResult<'a>> + Clone + Sync,
    ) -> io::Result<()> {
        let family = plane.parameters.family();
        let mut fields: Vec<_> = fields.collect();
        fields.sort_by_key(|field| Reverse(field.inner.len(family)));
        let compressed = fields.par_iter().with_max_len(1).map(|field| {
            let mut alone = ZipWriter::new(Cursor::new(Vec::new()));
            let values = field.values(cells.clone(), field.inner.len(family));
            of_any!(values, values => array_in(&mut alone, field.name, &field.shape(plane), values))?;
            Ok(alone.finish_into_readable()?)
        });
        for alone in compressed.collect::<io::Result<Vec<_>>>()? {
            self.zip.merge_archive(alone)?;
        }
        Ok(())
    }

    /// One array, row by row.
    pub fn array<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[u64],
        values: impl IntoIterator<Item = T>,
    ) -> io::Result<()> {
        array_in(&mut self.zip, name, shape, values)
    }

    /// A single text, which NumPy shows as an array without dimensions.
    pub fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let kind = format!("<U{}", text.chars().count()).parse().expect("a length in characters is a type");
        begin(&mut self.zip, name)?;
        let mut array = WriteOptions::<str>::new()
            .dtype(DType::Plain(kind))
            .shape(&[])
            .writer(&mut self.zip)
            .begin_nd()?;
        array.push(text)?;
        array.finish()
    }
}

/// Writes one array into an archive.
fn array_in<T: AutoSerialize>(
    zip: &mut ZipWriter<impl Write + Seek>,
    name: &str,
    shape: &[u64],
    values: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    begin(zip, name)?;
    let mut file = BufWriter::with_capacity(1 << 16, zip);
    let mut array = WriteOptions::new().default_dtype().shape(shape).writer(&mut file).begin_nd()?;
    array.extend(values)?;
    array.finish()?;
    file.flush()
}

/// Begins an array of an archive.
fn begin(zip: &mut ZipWriter<impl Write + Seek>, name: &str) -> io::Result<()> {
    // Most of an archive are states, which hardly compress, however long one tries.
    let options =
        SimpleFileOptions::default().last_modified_time(zip::DateTime::DEFAULT).compression_level(Some(2));
    Ok(zip.start_file(npyz::npz::file_name_from_array_name(name), options)?)
}
