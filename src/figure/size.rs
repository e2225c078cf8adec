//! The size of a picture.

use thiserror::Error;

/// The size of a picture in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    width: u32,
    height: u32,
}

impl Size {
    /// The shortest side.
    pub const SMALLEST: u32 = 16;
    /// The longest side.
    pub const LARGEST: u32 = 20_000;
    /// The most pixels.
    pub const MOST_PIXELS: u64 = 200_000_000;

    /// A checked size.
    ///
    /// # Errors
    /// A side that is too short or too long, or too many pixels altogether.
    pub fn new(width: u32, height: u32) -> Result<Self, SizeError> {
        let sides = Self::SMALLEST..=Self::LARGEST;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(SizeError::Side { width, height });
        }
        if u64::from(width) * u64::from(height) > Self::MOST_PIXELS {
            return Err(SizeError::Pixels { width, height });
        }
        Ok(Size { width, height })
    }

    /// Pixels across.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(self) -> u32 {
        self.height
    }

    /// The smallest larger size in about the same proportion that is enough for something, in steps of a tenth.
    pub(crate) fn enough(self, is_enough: impl Fn(Size) -> bool) -> Option<Size> {
        let scaled = |side: u32, factor: f64| (f64::from(side) * factor).ceil() as u32;
        let factors = (0..60).map(|step| 1.1_f64.powi(step));
        factors
            .filter_map(|factor| Size::new(scaled(self.width, factor), scaled(self.height, factor)).ok())
            .find(|&size| is_enough(size))
    }

    /// The size of ordinary text in a picture of this size, in pixels: about 8 points where the picture fills
    /// the width of a printed page, and never too small to read on a screen.
    pub fn em(self) -> f64 {
        (f64::from(self.width) / 58.0).min(f64::from(self.height) / 43.0).max(9.5)
    }
}

/// Why a size was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum SizeError {
    /// A side is too short or too long.
    #[error(
        "a picture of {width} × {height} pixels cannot be drawn: give {} to {} for each side",
        Size::SMALLEST,
        Size::LARGEST
    )]
    Side {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// Too many pixels altogether.
    #[error(
        "a picture of {width} × {height} pixels is too large: at most {} million pixels are drawn",
        Size::MOST_PIXELS / 1_000_000
    )]
    Pixels {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absurd_sizes_are_named() {
        for (width, height) in [(0, 600), (800, 0), (15, 600), (20_001, 600), (u32::MAX, u32::MAX)] {
            let message = Size::new(width, height).unwrap_err().to_string();
            assert!(message.contains(&format!("{width} × {height}")), "{message}");
        }
        assert!(matches!(Size::new(20_000, 20_000), Err(SizeError::Pixels { .. })));
        assert!(Size::new(16, 20_000).is_ok() && Size::new(8000, 6000).is_ok());
    }
}
