//! A writer that fails once.

use std::io::{self, Seek, SeekFrom, Write};

/// Passes everything on until the first error, and swallows whatever follows it.
///
/// What completes an archive when it is dropped would otherwise fail a second time, where only standard error is left
/// to hear of it.
#[derive(Debug)]
pub(super) struct Fused<W> {
    to: W,
    /// The first error, after which nothing is passed on any more.
    broken: Option<io::ErrorKind>,
    /// Where the next byte goes.
    at: u64,
    end: u64,
}

impl<W: Write + Seek> Fused<W> {
    pub fn new(to: W) -> Self {
        Fused { to, broken: None, at: 0, end: 0 }
    }

    /// Success if there was no error, even one that whoever wrote took no notice of.
    pub fn end(self) -> io::Result<()> {
        self.broken.map_or(Ok(()), |kind| Err(kind.into()))
    }

    fn passed<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        let error = result.as_ref().err().map(io::Error::kind);
        self.broken = error.filter(|&kind| kind != io::ErrorKind::Interrupted);
        result
    }

    fn moved(&mut self, to: u64) {
        self.at = to;
        self.end = self.end.max(to);
    }
}

impl<W: Write + Seek> Write for Fused<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = match self.broken {
            Some(_) => bytes.len(),
            None => {
                let written = self.to.write(bytes);
                self.passed(written)?
            }
        };
        self.moved(self.at + written as u64);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.broken.is_some() {
            return Ok(());
        }
        let flushed = self.to.flush();
        self.passed(flushed)
    }
}

impl<W: Write + Seek> Seek for Fused<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let place = match self.broken {
            Some(_) => match to {
                SeekFrom::Start(place) => place,
                SeekFrom::End(from) => self.end.saturating_add_signed(from),
                SeekFrom::Current(from) => self.at.saturating_add_signed(from),
            },
            None => {
                let place = self.to.seek(to);
                self.passed(place)?
            }
        };
        self.moved(place);
        Ok(place)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::store::npz::write::Archive;

    /// A disk with room for so many bytes, which counts its errors.
    struct Full {
        room: usize,
        errors: usize,
        to: Cursor<Vec<u8>>,
    }

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if self.to.position() as usize + bytes.len() > self.room {
                self.errors += 1;
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.to.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.to.seek(to)
        }
    }

    fn archived(room: usize) -> (io::Result<()>, usize) {
        let mut full = Full { room, errors: 0, to: Cursor::new(Vec::new()) };
        let mut archive = Archive::new(&mut full);
        let noise = (0..5000_u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let filled = archive
            .array("noise", &[5000], noise)
            .and_then(|()| archive.text("config", "{}"))
            .and_then(|()| archive.finish());
        (filled, full.errors)
    }

    #[test]
    fn a_full_disk_is_one_error_wherever_it_ends() {
        let (filled, errors) = archived(1 << 20);
        assert!(filled.is_ok() && errors == 0);
        for room in (0..42_000).step_by(1500) {
            let (filled, errors) = archived(room);
            if errors > 0 {
                assert_eq!(filled.unwrap_err().kind(), io::ErrorKind::StorageFull, "{room}");
                assert_eq!(errors, 1, "{room}");
            }
        }
        assert!(archived(0).1 > 0 && archived(39_000).1 > 0);
    }
}
