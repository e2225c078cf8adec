//! Functions that vanish at the points of codimension two on a curve.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Complex, DVector};

use super::condition::Kind;
use super::curve::Special;
use super::locus::Locus;
use crate::theory::NormalForm;

/// A function along a curve, and what its zeros are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Monitor {
    pub special: Special,
    /// None where it is not defined.
    pub value: Option<f64>,
}

/// What is watched along a curve of some kind.
pub(super) fn monitors(
    locus: &Locus,
    tangent: &DVector<f64>,
    form: &NormalForm<'_>,
    coefficient: Option<f64>,
    critical: &[Complex<f64>],
    others: &[Complex<f64>],
) -> Vec<Monitor> {
    let monitor = |special, value: Option<f64>| Monitor { special, value };
    // Products over the other multipliers are real, since those are real or come in pairs.
    let from = |value: f64| Some(others.iter().map(|other| other - value).product::<Complex<f64>>().re);
    let beside = |special| monitor(special, pair_beside(others));
    match locus.kind {
        Kind::Fold => {
            // The null vector's sign is free: the path's own direction, which it is at a cusp, settles it.
            let along = tangent.rows(0, locus.unknowns.size()).into_owned();
            vec![
                monitor(Special::Cusp, form.fold(&along)),
                monitor(Special::Resonance11, from(1.0)),
                monitor(Special::FoldFlip, from(-1.0)),
                beside(Special::FoldNeimarkSacker),
            ]
        }
        Kind::PeriodDoubling | Kind::Pitchfork => vec![
            monitor(Special::GeneralisedFlip, coefficient),
            monitor(Special::Resonance12, from(-1.0)),
            monitor(Special::FoldFlip, from(1.0)),
            beside(Special::FlipNeimarkSacker),
        ],
        Kind::NeimarkSacker => {
            let angle = critical[0].arg().abs();
            vec![
                monitor(Special::Chenciner, coefficient),
                monitor(Special::Resonance13, Some(angle - 2.0 * PI / 3.0)),
                monitor(Special::Resonance14, Some(angle - FRAC_PI_2)),
                monitor(Special::FoldNeimarkSacker, from(1.0)),
                monitor(Special::FlipNeimarkSacker, from(-1.0)),
                beside(Special::DoubleNeimarkSacker),
            ]
        }
        Kind::Grazing => {
            vec![
                monitor(Special::GrazingFold, from(1.0)),
                monitor(Special::GrazingFlip, from(-1.0)),
                beside(Special::GrazingNeimarkSacker),
            ]
        }
    }
}

/// Vanishes where a complex pair among the other multipliers lies on the unit circle; none if they are all real.
fn pair_beside(others: &[Complex<f64>]) -> Option<f64> {
    let mut pairs = others.iter().filter(|value| value.im > 1e-9).map(|value| value.norm() - 1.0).peekable();
    pairs.peek()?;
    Some(pairs.product())
}
