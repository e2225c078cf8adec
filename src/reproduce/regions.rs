//! The regions R1 to R7 of Fig. 5: what the paper's points in them settle on, and the connected cells around those.

use super::Claim;
use super::paper_point::{PaperPoint, words};
use crate::analysis::{Regime, Verdict};
use crate::paper::region_name;
use crate::plane::{Adjacency, Cell, RegionMap, connected};

/// How near to a point of the paper a region begins that it lies in, in cells: the point is beside the cells' middles.
const NEAR: u32 = 2;
/// N from which a motion counts as one of long period.
const LONG: u16 = 3;

/// A region of Fig. 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Region {
    /// One of a motion that repeats: R1, R2, R4, R5 or R6.
    Of(&'static str),
    /// R6 "and beyond": the cascade, and what it leads to.
    Cascade,
    /// R3 or R7: quasi-periodic, chaotic, or of long period.
    Irregular,
}

impl Region {
    /// Whether a cell, or a point, can be one of the region.
    pub fn has(self, verdict: &Verdict) -> bool {
        match self {
            Region::Of(name) => region_name(verdict) == Some(name),
            Region::Cascade => Region::Of("R6").has(verdict) || Region::Irregular.has(verdict),
            Region::Irregular => {
                let long = verdict.regime == Regime::Periodic && verdict.n >= LONG;
                let irregular =
                    matches!(verdict.regime, Regime::QuasiPeriodic | Regime::Chaotic | Regime::Unresolved);
                (irregular || long) && region_name(verdict).is_none()
            }
        }
    }
}

/// The points that the paper places in its regions.
const POINTS: [(&str, &str, Region, &[PaperPoint]); 7] = [
    ("R1", "stable 1-1-1 symmetric", Region::Of("R1"), &[PaperPoint::new(3.7, 0.1)]),
    ("R2", "1-1-1 unsymmetric", Region::Of("R2"), &[PaperPoint::new(3.5, 0.1)]),
    (
        "R3",
        "quasi-periodic around 1-1-1 unsymmetric, long periods, chaos",
        Region::Irregular,
        &[PaperPoint::new(3.03, 0.1), PaperPoint::new(2.83, 0.1)],
    ),
    ("R4", "1-2-2 symmetric", Region::Of("R4"), &[PaperPoint::new(1.72, 0.1)]),
    ("R5", "1-2-2 unsymmetric", Region::Of("R5"), &[PaperPoint::new(1.65, 0.1)]),
    ("R6", "period-doubled 1-2-2", Region::Of("R6"), &[PaperPoint::new(1.63, 0.1)]),
    (
        "R7",
        "quasi-periodic around 1-1-1 symmetric, long periods, chaos",
        Region::Irregular,
        &[PaperPoint::symmetric(2.57, 0.6, 8000)],
    ),
];

/// Each region is where the paper has it: its points settle on its motion, in one connected region of the map's cells; and
/// R7 is apart from R3.
pub(super) fn regions(map: &RegionMap) -> Vec<Claim> {
    let mut found: Vec<(&str, Option<Vec<Cell>>)> = Vec::new();
    let mut claims: Vec<Claim> = POINTS
        .iter()
        .map(|(name, motion, region, points)| {
            let settled: Vec<Verdict> = points.iter().map(PaperPoint::verdict).collect();
            let cells = around(map, *region, points);
            let holds = settled.iter().all(|verdict| region.has(verdict)) && cells.is_some();
            let at: Vec<String> = points
                .iter()
                .zip(&settled)
                .map(|(point, verdict)| format!("{} at {}", words(verdict), point.words()))
                .collect();
            let size = cells.as_ref().map_or_else(
                || "in no connected region of the map".to_owned(),
                |cells| {
                    let share = 100.0 * cells.len() as f64 / map.verdicts.len() as f64;
                    format!("in a connected region of {share:.2} % of the plane")
                },
            );
            found.push((name, cells));
            let places: Vec<String> = points.iter().map(PaperPoint::words).collect();
            let printed = format!("a region of the plane with {}", places.join(" and "));
            Claim::new(
                5,
                format!("region {name}: {motion}"),
                printed,
                format!("{}, {size}", at.join(", ")),
                holds,
            )
        })
        .collect();
    let cells =
        |wanted: &str| found.iter().find(|(name, _)| *name == wanted).and_then(|(_, cells)| cells.clone());
    claims.push(apart(cells("R3"), cells("R7")));
    claims
}

/// That two regions are not connected.
fn apart(third: Option<Vec<Cell>>, seventh: Option<Vec<Cell>>) -> Claim {
    let shared = match (&third, &seventh) {
        (Some(third), Some(seventh)) => Some(third[0] == seventh[0]),
        _ => None,
    };
    let computed = match shared {
        Some(false) => "two connected regions of the map",
        Some(true) => "one connected region of the map",
        None => "not both are found",
    };
    Claim::new(5, "R3 and R7 are apart", "two regions", computed, shared == Some(false))
}

/// The connected cells of a region about all of some points; none if there are none.
fn around(map: &RegionMap, region: Region, points: &[PaperPoint]) -> Option<Vec<Cell>> {
    let keys: Vec<Option<()>> =
        map.verdicts.iter().map(|verdict| region.has(verdict).then_some(())).collect();
    let near = |cell: &Cell, point: &PaperPoint| {
        let (column, row) = (map.plane.x.place(point.omega), map.plane.y.place(point.delta));
        (f64::from(cell.0) - column).abs() <= f64::from(NEAR)
            && (f64::from(cell.1) - row).abs() <= f64::from(NEAR)
    };
    let has_all = |cells: &Vec<Cell>| points.iter().all(|point| cells.iter().any(|cell| near(cell, point)));
    let found = connected(&keys, map.plane.x.count, map.plane.y.count, Adjacency::Corners);
    found.into_iter().filter(has_all).max_by_key(Vec::len)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Outcome;

    #[test]
    fn regions_tell_motions_apart() {
        let torus = PaperPoint::new(3.03, 0.1).verdict();
        let unsymmetric = PaperPoint::new(3.5, 0.1).verdict();
        assert!(Region::Irregular.has(&torus) && !Region::Of("R2").has(&torus));
        assert!(!Region::Irregular.has(&unsymmetric) && Region::Of("R2").has(&unsymmetric));
        assert!(Region::Cascade.has(&torus) && !Region::Cascade.has(&unsymmetric));
    }

    #[test]
    fn one_region_is_not_two() {
        let [one, other] = [vec![(0, 0), (0, 1)], vec![(5, 5)]];
        assert_eq!(apart(Some(one.clone()), Some(other)).verdict, Outcome::Agrees);
        assert_eq!(apart(Some(one.clone()), Some(one.clone())).verdict, Outcome::Differs);
        assert_eq!(apart(Some(one), None).verdict, Outcome::Differs);
    }
}
