//! Whether two maps are the same, bit for bit.

use crate::analysis::{Extent, Verdict};
use crate::plane::RegionMap;

/// The cells, counted row by row, in which two maps of the same plane differ in any bit of what is said of them: label,
/// exponent, state, impacts, power, time in contact, extents. Two numbers that are not measured are the same.
pub fn differing(ours: &RegionMap, theirs: &RegionMap) -> Vec<usize> {
    let extent = |map: &RegionMap, cell: usize| map.extents.as_ref().map(|extents| bits_of(&extents[cell]));
    (0..ours.verdicts.len().max(theirs.verdicts.len()))
        .filter(|&cell| match (ours.verdicts.get(cell), theirs.verdicts.get(cell)) {
            (Some(a), Some(b)) => !are_same(a, b) || extent(ours, cell) != extent(theirs, cell),
            _ => true,
        })
        .collect()
}

/// Whether two verdicts are the same, bit for bit.
pub fn are_same(a: &Verdict, b: &Verdict) -> bool {
    let whole = |v: &Verdict| {
        let counted = [v.impacts, v.impacts_total, v.periods, v.measures.observed];
        (v.regime, v.n, v.counts, v.symmetric, v.returning, counted)
    };
    let numbers = |v: &Verdict| {
        [v.lyapunov, v.peak_impact_velocity, v.measures.power, v.measures.contact].map(bits_of_number)
    };
    let state = |v: &Verdict| v.state.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
    whole(a) == whole(b) && numbers(a) == numbers(b) && state(a) == state(b)
}

fn bits_of(extent: &Extent) -> Vec<u32> {
    extent.rms.iter().chain(&extent.peak).map(|&value| bits_of_number(value)).collect()
}

/// All that are not a number are one.
fn bits_of_number(value: f32) -> u32 {
    if value.is_nan() { f32::NAN.to_bits() } else { value.to_bits() }
}
