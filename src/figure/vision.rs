//! Which colours can be told apart, also by eyes that lack one kind of cones.

use image::Rgb;
use palette::color_difference::Ciede2000;
use palette::white_point::D65;
use palette::{Clamp, IntoColor, Lab, LinSrgb, Srgb};

use super::shapes::Colour;

/// What an eye sees of linear sRGB: that of most people, and the red-, green- and blue-blind one (Machado, Oliveira and
/// Fernandes 2009).
const EYES: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
];

/// Two colours that differ by so much are told apart in a legend (CIEDE2000; a difference of 2 is just seen side by side).
pub(crate) const DISTINCT: f64 = 6.0;

/// A colour as each of the eyes sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen([Lab<D65, f64>; 4]);

impl Seen {
    /// How the eyes see a colour.
    pub fn of(Rgb([r, g, b]): Colour) -> Self {
        let linear: LinSrgb<f64> = Srgb::new(r, g, b).into_linear();
        let channels = [linear.red, linear.green, linear.blue];
        Seen(EYES.map(|eye| {
            let [r, g, b] = eye.map(|row| row.iter().zip(channels).map(|(share, value)| share * value).sum());
            LinSrgb::new(r, g, b).clamp().into_color()
        }))
    }

    /// The difference that each of the eyes sees (CIEDE2000).
    pub fn differences(&self, other: &Self) -> [f64; 4] {
        std::array::from_fn(|eye| self.0[eye].difference(other.0[eye]))
    }

    /// The smallest difference that any of the eyes sees (CIEDE2000).
    pub fn difference(&self, other: &Self) -> f64 {
        self.differences(other).into_iter().fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_that_a_colour_blind_eye_confuses_are_found() {
        let difference = |a, b| Seen::of(Rgb(a)).difference(&Seen::of(Rgb(b)));
        // Pairs that only the red- or green-blind, and only the blue-blind, take for one another.
        for (a, b) in [([190, 120, 60], [140, 140, 60]), ([60, 150, 160], [70, 150, 125])] {
            let [plain, ..] = Seen::of(Rgb(a)).differences(&Seen::of(Rgb(b)));
            assert!(plain > 2.0 * DISTINCT && difference(a, b) < DISTINCT, "{plain} {}", difference(a, b));
        }
        assert_eq!(difference([10, 20, 30], [10, 20, 30]), 0.0);
        assert!(difference([0; 3], [255; 3]) > 90.0);
    }
}
