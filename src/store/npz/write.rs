//! Writing a map.

use std::io::{self, BufWriter, Seek, Write};

use npyz::{AutoSerialize, DType, WriteOptions, WriterBuilder};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::analysis::Verdict;
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
    let mut archive = Archive {
        zip: ZipWriter::new(to),
        cells: [u64::from(plane.y.count), u64::from(plane.x.count)],
        verdicts: &map.verdicts,
    };
    archive.field("regime", |v| v.regime.code())?;
    archive.field("n", |v| v.n)?;
    archive.field("p", |v| v.p)?;
    archive.field("q", |v| v.q)?;
    archive.field("symmetric", |v| u8::from(v.symmetric))?;
    archive.field("lyapunov", |v| v.lyapunov)?;
    archive.states()?;
    archive.field("impacts", |v| v.impacts)?;
    archive.field("peak_impact_velocity", |v| v.peak_impact_velocity)?;
    archive.field("periods", |v| v.periods)?;
    archive.array("x", &[plane.x.count.into()], plane.x.values())?;
    archive.array("y", &[plane.y.count.into()], plane.y.values())?;
    archive.text("config", config)?;
    archive.zip.finish()?;
    Ok(())
}

/// An archive under way.
struct Archive<'a, W: Write + Seek> {
    zip: ZipWriter<W>,
    cells: [u64; 2],
    verdicts: &'a [Verdict],
}

impl<W: Write + Seek> Archive<'_, W> {
    /// One value per cell.
    fn field<T: AutoSerialize>(&mut self, name: &str, of: impl Fn(&Verdict) -> T) -> io::Result<()> {
        self.array(name, &self.cells.clone(), self.verdicts.iter().map(of))
    }

    /// The four components of every cell's state.
    fn states(&mut self) -> io::Result<()> {
        let [rows, columns] = self.cells;
        self.array("state", &[rows, columns, 4], self.verdicts.iter().flat_map(|v| v.state))
    }

    fn array<T: AutoSerialize>(
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
    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
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
}
