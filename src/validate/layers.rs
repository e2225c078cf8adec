//! The layers of two maps, cell by cell.

use serde::Serialize;

use super::alike::same_label;
use super::spread::{Share, Spread};
use crate::analysis::Regime;
use crate::figure::Spread as Scale;
use crate::plane::fields::{Cells, Inner, Layer};
use crate::plane::{RegionMap, Window};

/// How well a layer of a candidate's map agrees with the reference's, in cells whose regime and label agree and that begin.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayerAgreement {
    /// The layer's name.
    pub layer: String,
    /// Cells that have a number in both maps, or in neither.
    pub defined: Share,
    /// Whether the differences are relative, to the greater of the two numbers: where the layer is drawn by equal ratios.
    pub relative: bool,
    /// The differences in cells that have a number in both.
    pub difference: Option<Spread>,
}

/// Every layer of numbers of two maps of the same plane but the end states, which are compared apart from these: where a
/// motion does not end in the same state twice, as in chaos, they say nothing.
pub(super) fn layers(reference: &RegionMap, candidate: &RegionMap) -> Vec<LayerAgreement> {
    let whole = Window::whole(&reference.plane);
    let values = |layer: &Layer, map: &RegionMap| {
        layer.values(map as &dyn Cells, whole).expect("a map in memory can be read")
    };
    let of = |layer: Layer| {
        let Layer::Number { field, drawn, .. } = layer else { return None };
        if field.inner == Inner::Components {
            return None;
        }
        let relative = drawn.spread == Scale::Ratios;
        let (ours, theirs) = (values(&layer, reference), values(&layer, candidate));
        let mut defined = Share::default();
        let mut differences = Vec::new();
        for i in 0..whole.cells() {
            let [ours_is, theirs_is] = [&reference.verdicts[i], &candidate.verdicts[i]];
            if !same_label(ours_is, theirs_is) || ours_is.regime == Regime::Inadmissible {
                continue;
            }
            let (a, b) = (f64::from(ours[i]), f64::from(theirs[i]));
            let alike = a.is_finite() == b.is_finite() && (a.is_finite() || a.is_nan() == b.is_nan());
            defined.count(alike);
            if a.is_finite() && b.is_finite() {
                let scale = if relative { a.abs().max(b.abs()) } else { 1.0 };
                differences.push(if a == b { 0.0 } else { (a - b).abs() / scale });
            }
        }
        Some(LayerAgreement { layer: layer.name(), defined, relative, difference: Spread::of(differences) })
    };
    let both = |layer: &Layer| layer.is_with(reference.extras()) && layer.is_with(candidate.extras());
    Layer::all(reference.plane.parameters.family()).into_iter().filter(both).filter_map(of).collect()
}
