//! The comparison itself: a pure function of two maps.

use strum::VariantArray;

use super::agreement::{Agreement, FailedCells, Fault, RegimeAgreement, Tipped, WorstCell};
use super::alike::{Units, is_inside, same_label, same_motion};
use super::comparable::Comparable;
use super::continuation::Continued;
use super::spread::{Share, Spread};
use crate::analysis::{Regime, Verdict};
use crate::plane::{Reached, RegionMap};

/// How many of the worst cells are kept of each kind.
const WORST_OF_A_KIND: usize = 4;

/// Compares two maps of the same plane; strays count with their whole difference.
///
/// Under control the points on σ are compared, the hardest impact of a period, their phases the short way round.
///
/// # Panics
/// If the maps are not of the same plane.
pub fn compare<T: Comparable>(reference: &RegionMap<T>, candidate: &RegionMap<T>) -> Agreement {
    compare_continued(reference, candidate, &Continued::new())
}

/// Compares two maps of the same plane; `continued` holds the differences of strays that the reference continued.
///
/// # Panics
/// If the maps are not of the same plane.
pub fn compare_continued<T: Comparable>(
    reference: &RegionMap<T>,
    candidate: &RegionMap<T>,
    continued: &Continued,
) -> Agreement {
    assert_eq!(reference.plane, candidate.plane, "only maps of the same plane can be compared");
    let units = Units::of(reference);
    let cells: Vec<Cell> = (0..reference.verdicts.len())
        .map(|index| Cell::compare(reference, candidate, (continued, &units), index))
        .collect();
    // Where neither begins there is nothing to agree on.
    let begun = || cells.iter().filter(|cell| !cell.is_inadmissible());
    let of_regime = |regime| cells.iter().filter(move |cell: &&Cell| cell.reference.regime == regime);
    Agreement {
        cells: cells.len() as u64,
        confusion: confusion(&cells),
        inside: share(begun().filter(|cell| cell.inside)),
        boundary: share(begun().filter(|cell| !cell.inside)),
        non_chaotic: share(begun().filter(|cell| cell.reference.regime != Regime::Chaotic)),
        symmetry: symmetry(&cells),
        regimes: Regime::ALL
            .into_iter()
            .filter(|&regime| regime != Regime::Inadmissible && of_regime(regime).next().is_some())
            .map(|regime| regime_agreement(regime, &of_regime(regime).collect::<Vec<_>>()))
            .collect(),
        end_state: Spread::of(cells.iter().filter_map(|cell| cell.difference).collect()),
        continued: continued.len() as u64,
        tipped: Tipped::default(),
        layers: T::layers(reference, candidate),
        failed: FailedCells {
            reference: failed(cells.iter().map(|cell| cell.reference)),
            candidate: failed(cells.iter().map(|cell| cell.candidate)),
        },
        worst: worst(&cells, reference.plane.x.count),
    }
}

/// A cell in both maps.
struct Cell<'a> {
    index: usize,
    reference: &'a Verdict,
    candidate: &'a Verdict,
    agrees: bool,
    inside: bool,
    difference: Option<f64>,
    places: [&'a [f64]; 2],
}

impl<'a> Cell<'a> {
    fn compare<T: Comparable>(
        reference: &'a RegionMap<T>,
        candidate: &'a RegionMap<T>,
        (continued, units): (&Continued, &Units<'_, T>),
        index: usize,
    ) -> Self {
        let both = [&reference.verdicts[index], &candidate.verdicts[index]];
        let [ours, theirs] = both.map(Reached::verdict);
        let direct = || T::difference(both[0], both[1], units.at(index));
        Cell {
            index,
            reference: ours,
            candidate: theirs,
            agrees: same_label(ours, theirs),
            inside: is_inside(reference, index),
            difference: same_motion(ours, theirs)
                .then(|| continued.get(&index).copied().unwrap_or_else(direct)),
            places: both.map(Reached::place),
        }
    }

    /// Whether it begins in neither.
    fn is_inadmissible(&self) -> bool {
        [self.reference, self.candidate].iter().all(|verdict| verdict.regime == Regime::Inadmissible)
    }

    fn fault(&self) -> Option<Fault> {
        match self {
            cell if cell.reference.regime == Regime::Failed => Some(Fault::Failed),
            cell if cell.candidate.regime == Regime::Failed => Some(Fault::Failed),
            Cell { agrees: false, inside: true, .. } => Some(Fault::LabelInside),
            Cell { agrees: false, inside: false, .. } => Some(Fault::LabelOnBoundary),
            Cell { difference: Some(difference), .. } if *difference > 0.0 => Some(Fault::EndState),
            _ => None,
        }
    }

    /// What cells of one fault are ranked by: the difference of the end states, otherwise how clearly stable or
    /// chaotic the reference is, since a marginal cell is the easiest to mistake.
    fn gravity(&self) -> f64 {
        match self.difference {
            Some(difference) if difference.is_nan() => f64::INFINITY,
            Some(difference) => difference,
            // Not measured: as marginal as can be.
            None if self.reference.lyapunov.is_nan() => 0.0,
            None => f64::from(self.reference.lyapunov).abs(),
        }
    }
}

fn share<'a>(cells: impl Iterator<Item = &'a Cell<'a>>) -> Share {
    cells.fold(Share::default(), |mut share, cell| {
        share.count(cell.agrees);
        share
    })
}

fn symmetry(cells: &[Cell]) -> Share {
    let mut share = Share::default();
    for cell in cells.iter().filter(|cell| same_motion(cell.reference, cell.candidate)) {
        share.count(cell.reference.symmetric == cell.candidate.symmetric);
    }
    share
}

fn confusion(cells: &[Cell]) -> [[u64; Regime::ALL.len()]; Regime::ALL.len()] {
    let mut confusion = [[0; Regime::ALL.len()]; Regime::ALL.len()];
    for cell in cells {
        confusion[usize::from(cell.reference.regime.code())][usize::from(cell.candidate.regime.code())] += 1;
    }
    confusion
}

fn failed<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> u64 {
    verdicts.filter(|verdict| verdict.regime == Regime::Failed).count() as u64
}

fn regime_agreement(regime: Regime, cells: &[&Cell]) -> RegimeAgreement {
    let agreeing = cells.iter().filter(|cell| cell.agrees);
    RegimeAgreement {
        regime: regime.name(),
        inside: share(cells.iter().copied().filter(|cell| cell.inside)),
        boundary: share(cells.iter().copied().filter(|cell| !cell.inside)),
        end_state: Spread::of(cells.iter().filter_map(|cell| cell.difference).collect()),
        lyapunov: Spread::of(agreeing.filter_map(|cell| lyapunov_difference(cell)).collect()),
    }
}

/// Zero where both are infinite alike, infinite where only one was measured; none where neither was.
fn lyapunov_difference(cell: &Cell) -> Option<f64> {
    let (reference, candidate) = (cell.reference.lyapunov, cell.candidate.lyapunov);
    match (reference.is_nan(), candidate.is_nan()) {
        (true, true) => None,
        (false, false) if reference == candidate => Some(0.0),
        (false, false) => Some(f64::from(reference - candidate).abs()),
        _ => Some(f64::INFINITY),
    }
}

fn worst(cells: &[Cell], columns: u32) -> Vec<WorstCell> {
    let of_a_kind = |fault| {
        let mut cells: Vec<&Cell> = cells.iter().filter(|cell| cell.fault() == Some(fault)).collect();
        cells.sort_by(|a, b| b.gravity().total_cmp(&a.gravity()));
        cells.into_iter().take(WORST_OF_A_KIND).map(move |cell| WorstCell {
            column: cell.index as u32 % columns,
            row: cell.index as u32 / columns,
            fault,
            reference: *cell.reference,
            candidate: *cell.candidate,
            places: cell.places.map(<[f64]>::to_vec),
            difference: cell.difference,
        })
    };
    Fault::VARIANTS.iter().copied().flat_map(of_a_kind).collect()
}
