//! Writing a map.

use std::io::{self, BufWriter, Seek, Write};

use npyz::{AutoSerialize, DType, WriteOptions, WriterBuilder};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::plane::RegionMap;

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
    let mut archive = Archive::new(to);
    let cells = [u64::from(plane.y.count), u64::from(plane.x.count)];
    let verdicts = &map.verdicts;
    archive.field("regime", cells, verdicts, |v| v.regime.code())?;
    archive.field("n", cells, verdicts, |v| v.n)?;
    archive.field("p", cells, verdicts, |v| v.p)?;
    archive.field("q", cells, verdicts, |v| v.q)?;
    archive.field("symmetric", cells, verdicts, |v| u8::from(v.symmetric))?;
    archive.field("lyapunov", cells, verdicts, |v| v.lyapunov)?;
    archive.array("state", &[cells[0], cells[1], 4], verdicts.iter().flat_map(|v| v.state))?;
    archive.field("impacts", cells, verdicts, |v| v.impacts)?;
    archive.field("peak_impact_velocity", cells, verdicts, |v| v.peak_impact_velocity)?;
    archive.field("periods", cells, verdicts, |v| v.periods)?;
    archive.array("x", &[plane.x.count.into()], plane.x.values())?;
    archive.array("y", &[plane.y.count.into()], plane.y.values())?;
    archive.text("config", config)?;
    archive.finish()
}

/// An archive under way.
pub(super) struct Archive<W: Write + Seek> {
    zip: ZipWriter<W>,
}

impl<W: Write + Seek> Archive<W> {
    /// An empty archive.
    pub fn new(to: W) -> Self {
        Archive { zip: ZipWriter::new(to) }
    }

    /// One value per cell.
    pub fn field<R, T: AutoSerialize>(
        &mut self,
        name: &str,
        cells: [u64; 2],
        of_cells: &[R],
        of: impl Fn(&R) -> T,
    ) -> io::Result<()> {
        self.array(name, &cells, of_cells.iter().map(of))
    }

    /// Values in rows.
    pub fn array<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[u64],
        values: impl IntoIterator<Item = T>,
    ) -> io::Result<()> {
        self.entry(name)?;
        let mut file = BufWriter::with_capacity(1 << 16, &mut self.zip);
        let mut array = WriteOptions::new().default_dtype().shape(shape).writer(&mut file).begin_nd()?;
        array.extend(values)?;
        array.finish()?;
        file.flush()
    }

    /// A single text, which NumPy shows as an array without dimensions.
    pub fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let kind = format!("<U{}", text.chars().count()).parse().expect("a length in characters is a type");
        self.entry(name)?;
        let mut array = WriteOptions::<str>::new()
            .dtype(DType::Plain(kind))
            .shape(&[])
            .writer(&mut self.zip)
            .begin_nd()?;
        array.push(text)?;
        array.finish()
    }

    fn entry(&mut self, name: &str) -> io::Result<()> {
        let options = SimpleFileOptions::default().last_modified_time(zip::DateTime::DEFAULT);
        Ok(self.zip.start_file(npyz::npz::file_name_from_array_name(name), options)?)
    }

    /// Ends the archive.
    pub fn finish(self) -> io::Result<()> {
        self.zip.finish()?;
        Ok(())
    }
}
