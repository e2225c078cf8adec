//! Writing a map.

use std::io::{self, BufWriter, Seek, Write};

use npyz::{AutoSerialize, DType, WriteOptions, WriterBuilder};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::fused::Fused;
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
    let cells = [u64::from(plane.y.count), u64::from(plane.x.count)];
    let mut archive = Archive::new(to);
    write_verdicts(&mut archive, cells, &map.verdicts)?;
    if let Some(multipliers) = &map.multipliers {
        let count = 2 * plane.parameters.family().n();
        let none = vec![[f64::NAN; 2]; count];
        let numbers = multipliers.iter().flat_map(|cell| cell.as_ref().unwrap_or(&none)).flatten().copied();
        archive.array("multipliers", &[cells[0], cells[1], count as u64, 2], numbers)?;
    }
    archive.array("x", &[plane.x.count.into()], plane.x.values())?;
    archive.array("y", &[plane.y.count.into()], plane.y.values())?;
    archive.text("config", config)?;
    archive.finish()
}

/// Writes one array per field of the cells' verdicts.
pub(super) fn write_verdicts<W: Write + Seek>(
    archive: &mut Archive<W>,
    cells: [u64; 2],
    verdicts: &[Verdict],
) -> io::Result<()> {
    let verdicts = || verdicts.iter();
    archive.array("regime", &cells, verdicts().map(|v| v.regime.code()))?;
    archive.array("n", &cells, verdicts().map(|v| v.n))?;
    archive.array("p", &cells, verdicts().map(Verdict::p))?;
    archive.array("q", &cells, verdicts().map(Verdict::q))?;
    let stops = verdicts().map(|v| v.counts.len()).max().unwrap_or(0);
    let counts = verdicts().flat_map(|v| (0..stops).map(|k| v.counts.get(k).copied().unwrap_or(0)));
    archive.array("counts", &[cells[0], cells[1], stops as u64], counts)?;
    archive.array("symmetric", &cells, verdicts().map(|v| u8::from(v.symmetric)))?;
    archive.array("lyapunov", &cells, verdicts().map(|v| v.lyapunov))?;
    let components = verdicts().map(|v| v.state.len()).max().unwrap_or(0) as u64;
    archive.array("state", &[cells[0], cells[1], components], verdicts().flat_map(|v| v.state.to_vec()))?;
    archive.array("impacts", &cells, verdicts().map(|v| v.impacts))?;
    archive.array("peak_impact_velocity", &cells, verdicts().map(|v| v.peak_impact_velocity))?;
    archive.array("periods", &cells, verdicts().map(|v| v.periods))
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

    /// One array, row by row.
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
}
