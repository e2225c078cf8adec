//! How long control takes, cell by cell: iterates to convergence on a logarithmic colour scale.

use std::convert::Infallible;

use image::Rgb;

use super::axes::frame_of;
use super::colours::paint_of;
use super::motion::Motion;
use super::numbers::{Apart, Numbers, Sheet};
use super::regions::control_title;
use crate::analysis::Regime;
use crate::control::{NEVER, Outcome};
use crate::figure::{Bar, Colour, Paint, Palette, Picture, Size, Spread};
use crate::plane::{Control, RegionMap};

/// The colour of cells that took no time: none of the bar's.
const AT_ONCE: Colour = Rgb([255; 3]);

/// Draws how many iterates each cell of a plane took from switching control on until its points kept returning.
///
/// Cells whose points returned from the first one on, those that did not come to return, and those that would begin beyond a stop
/// have colours of their own.
pub fn convergence_map(map: &RegionMap<Control>, size: Size) -> Picture {
    let sheet = Sheet {
        frame: frame_of(&map.plane),
        title: control_title(map),
        bar: Some("iterates to convergence".to_owned()),
        config: map.config(),
    };
    let extent = [map.plane.x.count, map.plane.y.count];
    // The first row is at the bottom.
    let upper_first = map.verdicts.chunks(extent[0] as usize).rev().flatten();
    let inadmissible = |outcome: &Outcome| outcome.verdict.regime == Regime::Inadmissible;
    let apart = Apart::inadmissible(upper_first.clone().map(inadmissible).collect());
    // A hatch is of pixels, and there is one number for each cell.
    let apart = Apart { paint: Paint::plain(apart.paint.fill), ..apart };
    let numbers = numbers(upper_first.map(|outcome| outcome.converged_at), extent);
    let numbers = Numbers { apart: vec![apart], ..numbers };
    let Ok(picture) = sheet.draw(size, None, |_| Ok::<_, Infallible>(numbers));
    picture
}

/// Convergence times as they are shown: 0 and none at all have no place on a logarithmic scale.
fn numbers(times: impl Iterator<Item = u32>, extent: [u32; 2]) -> Numbers {
    let number = |time: u32| match time {
        NEVER => f32::NAN,
        0 => f32::NEG_INFINITY,
        time => time as f32,
    };
    let values: Vec<f32> = times.map(number).collect();
    let bar = Bar::of(&values, Spread::Ratios, None, Palette::suiting(Spread::Ratios));
    let unresolved = paint_of(Motion::without_label(Regime::Unresolved)).fill;
    Numbers {
        extent,
        apart: Vec::new(),
        values,
        bar,
        undefined: (unresolved, "not reached"),
        lost: (AT_ONCE, "0, at once"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;
    use crate::figure::faults;

    #[test]
    fn times_of_every_kind_are_drawn_whole() {
        let size = Size::new(580, 380).unwrap();
        let drawn = |times: &[u32]| {
            let extent = [times.len() as u32, 1];
            let sheet = Sheet {
                frame: frame_of(&example::map(3, 2).plane),
                title: Vec::new(),
                bar: Some("iterates to convergence".to_owned()),
                config: "{}".to_owned(),
            };
            let Ok(picture) =
                sheet.draw(size, None, |_| Ok::<_, Infallible>(numbers(times.iter().copied(), extent)));
            assert_eq!(faults(&picture, size), [""; 0], "{times:?}");
            picture
        };
        let said = |times: &[u32]| {
            ["iterates to convergence", ">0, at once<", ">not reached<", ">100<"]
                .map(|words| drawn(times).svg().contains(words))
        };
        assert_eq!(said(&[0, 3, 1200, NEVER]), [true; 4]);
        assert_eq!(said(&[3, 1200]), [true, false, false, true]);
        assert_eq!(said(&[37, 37]), [true, false, false, true]);
        assert_eq!(said(&[0, 0]), [false, true, false, false]);
        assert_eq!(said(&[NEVER, NEVER]), [false, false, true, false]);
    }

    #[test]
    fn what_has_no_place_on_a_logarithmic_scale_is_apart_from_it() {
        let all = numbers([0, 7, 900, NEVER].into_iter(), [4, 1]);
        let bar = all.bar.unwrap();
        assert_eq!(bar.parts()[0].0.ends(), [7.0, 900.0]);
        let apart = [all.undefined.0, all.lost.0];
        assert!(apart[0] != apart[1]);
        assert!([7.0, 80.0, 900.0].into_iter().all(|time| !apart.contains(&bar.colour(time))));
    }
}
