//! Fig. 5: the (ω, δ) plane with its regions R1–R7 and curves L1–L7.

use serde_json::{Value, json};

use super::bench::{PaperPoint, words};
use super::{Claim, PaperFigure, Produced, ReproduceError};
use crate::analysis::{Regime, Schedule, Verdict};
use crate::backend::{Cpu, Watch};
use crate::curves::{Criticality, Curve, Kind, bifurcation_curves};
use crate::model::Parameters;
use crate::plane::{Plane, RegionMap, Start};
use crate::render::{Shown, Size, region_map_with_curves};
use crate::sweep::sweep;

/// The parameter plane.
pub(super) struct Figure5;

/// Largest N of the motions whose curves are followed.
const CURVES: u32 = 2;

fn plane() -> Plane {
    Plane {
        x: "omega=0.2:5:400".parse().expect("an axis"),
        y: "delta=0.02:0.8:300".parse().expect("an axis"),
        parameters: Parameters::default(),
        start: Start::Symmetric,
        schedule: Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false },
    }
}

impl PaperFigure for Figure5 {
    fn number(&self) -> u32 {
        5
    }

    fn caption(&self) -> &'static str {
        "What the motion settles on in the (ω, δ) plane, started on the 1-1-1 motion where that exists, with the curves on which \
         motions lose their stability."
    }

    fn config(&self) -> Value {
        json!({ "plane": plane(), "curves": CURVES })
    }

    fn produce(&self, watch: &dyn Watch) -> Result<Produced, ReproduceError> {
        let map = sweep(&plane(), &Cpu, watch)?;
        let size = Size::new(1600, 1200).expect("a size");
        let curves = bifurcation_curves(&map, CURVES).expect("both axes are ranges of parameters");
        let picture = region_map_with_curves(&map, &curves, Shown::Bounding, CURVES, size);
        let mut claims = regions(&map);
        claims.extend(mirrored());
        claims.extend(lines(&curves));
        Ok(Produced { pictures: vec![("", picture)], claims })
    }
}

/// Each region is there if cells of its motion are.
fn regions(map: &RegionMap) -> Vec<Claim> {
    let periodic = |n, p, q, symmetric: Option<bool>| {
        move |v: &Verdict| {
            v.regime == Regime::Periodic
                && (v.n, v.p, v.q) == (n, p, q)
                && symmetric.is_none_or(|said| v.symmetric == said)
        }
    };
    let irregular = |v: &Verdict| matches!(v.regime, Regime::Chaotic | Regime::QuasiPeriodic);
    let region = |name: &str, motion: &str, belongs: &dyn Fn(&Verdict) -> bool| {
        let cells = map.verdicts.iter().filter(|verdict| belongs(verdict)).count();
        let share = 100.0 * cells as f64 / map.verdicts.len() as f64;
        let claim = format!("region {name}: {motion}");
        Claim::new(5, claim, "a region of the plane", format!("{share:.2} % of the plane"), cells >= 4)
    };
    vec![
        region("R1", "stable 1-1-1 symmetric", &periodic(1, 1, 1, Some(true))),
        region("R2", "1-1-1 unsymmetric", &periodic(1, 1, 1, Some(false))),
        region("R3 and R7", "quasi-periodic and chaotic motions", &irregular),
        region("R4", "1-2-2 symmetric", &periodic(1, 2, 2, Some(true))),
        region("R5", "1-2-2 unsymmetric", &periodic(1, 2, 2, Some(false))),
        region("R6", "period-doubled 1-2-2", &periodic(2, 4, 4, None)),
    ]
}

/// R5: a start and its mirror image, half a forcing period later, end on mirrored motions.
fn mirrored() -> Vec<Claim> {
    let point = PaperPoint::new(1.65, 0.1);
    let settled = point.verdict();
    let other = PaperPoint { start: mirror(&point, &settled), transient: 0, ..point }.verdict();
    let apart = settled.state.iter().zip(other.state).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (first, second) = (words(&settled), words(&other));
    let holds = first == second && first == "1-2-2 unsymmetric" && apart > 1e-3;
    let computed = format!("{first} and {second}, strobe states {apart:.4} apart");
    let claim = format!("R5 has two mirrored forms, at {}", point.words());
    vec![Claim::new(5, claim, "two antisymmetrical forms", computed, holds)]
}

/// The mirror image of a settled motion's state, half a forcing period on.
fn mirror(point: &PaperPoint, settled: &Verdict) -> Start {
    let system = point.system();
    let half = crate::dynamics::record(&system, settled.state, 0, 1, 2);
    let state = half.samples.get(1).map_or([0.0; 4], |s| [-s.x1, -s.x2, -s.v1, -s.v2]);
    Start::State(state)
}

/// Each curve is there if the continuation finds it.
fn lines(curves: &[Curve]) -> Vec<Claim> {
    let line = |name: &str,
                printed: &str,
                kind: Kind,
                label: &str,
                symmetric: bool,
                criticality: Option<Criticality>| {
        let belongs = |curve: &&Curve| {
            curve.kind == kind && curve.motion.label() == label && curve.motion.symmetric == symmetric
        };
        let points: Vec<[f64; 2]> = (curves.iter().filter(belongs).flat_map(|curve| &curve.points))
            .filter(|point| point.bounding)
            .filter(|point| criticality.is_none() || point.criticality == criticality)
            .map(|point| [point.x, point.y])
            .collect();
        let range = |i: usize| {
            let (low, high) = points
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), point| (a.min(point[i]), b.max(point[i])));
            format!("{low:.3} to {high:.3}")
        };
        let computed = match points.len() {
            0 => "not found".to_owned(),
            count => format!("ω {}, δ {} ({count} points)", range(0), range(1)),
        };
        Claim::new(5, format!("curve {name}"), printed, computed, !points.is_empty())
    };
    let (sub, sup) = (Some(Criticality::Subcritical), Some(Criticality::Supercritical));
    let ns = Kind::NeimarkSacker;
    vec![
        line("L1", "supercritical Neimark–Sacker of 1-1-1 symmetric", ns, "1-1-1", true, sup),
        line("L2", "subcritical Neimark–Sacker of 1-1-1 symmetric", ns, "1-1-1", true, sub),
        line("L3", "pitchfork of 1-1-1 symmetric", Kind::Pitchfork, "1-1-1", true, None),
        line("L4", "Neimark–Sacker of 1-1-1 unsymmetric", ns, "1-1-1", false, None),
        line("L5", "1-2-2 symmetric appears out of chaos", Kind::Fold, "1-2-2", true, None)
            .noted("taken for the fold in which 1-2-2 symmetric begins"),
        line("L6", "pitchfork of 1-2-2 symmetric", Kind::Pitchfork, "1-2-2", true, None),
        line("L7", "period doubling of 1-2-2 unsymmetric", Kind::PeriodDoubling, "1-2-2", false, None),
    ]
}
