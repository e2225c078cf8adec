//! Fig. 5: the (ω, δ) plane with its regions R1–R7 and curves L1–L7.

use serde_json::json;

use super::lines::lines;
use super::paper_point::{PaperPoint, words};
use super::regions::regions;
use super::{Claim, PaperFigure, Produced};
use crate::analysis::{Schedule, Verdict};
use crate::backend::Cpu;
use crate::curves::bifurcation_curves;
use crate::figure::Size;
use crate::plane::{Plane, Start};
use crate::render::{Shown, region_map_with_curves};
use crate::sweep::sweep;

/// Largest N of the motions whose curves are followed.
const CURVES: u32 = 2;

fn plane() -> Plane {
    let schedule = Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false };
    Plane::of_paper("omega=0.2:5:400", "delta=0.02:0.8:300", Start::Symmetric, schedule).expect("two axes")
}

/// The parameter plane.
pub(super) const FIGURE_5: PaperFigure = PaperFigure {
    number: 5,
    caption: "What the motion settles on in the (ω, δ) plane, started on the 1-1-1 motion where that exists, \
              with the curves on which motions lose their stability.",
    settings: || json!({ "plane": plane(), "curves": CURVES }),
    make: |_, watch| {
        let map = sweep(&plane(), &Cpu, watch)?;
        let size = Size::new(1600, 1200).expect("a size");
        let found = bifurcation_curves(&map, CURVES).expect("both axes are ranges of parameters");
        let curves = found.curves;
        let picture = region_map_with_curves(&map, &curves, Shown::Bounding, CURVES, size);
        let mut claims = regions(&map);
        claims.extend(mirrored());
        claims.extend(lines(&map, &curves));
        Ok(Produced::one(picture, claims))
    },
};

/// R5: a start and its mirror image, half a forcing period later, end on mirrored motions.
fn mirrored() -> Vec<Claim> {
    let point = PaperPoint::new(1.65, 0.1);
    let settled = point.verdict();
    let other = PaperPoint { start: mirror(&point, &settled), transient: 0, ..point }.verdict();
    let apart = settled.state.iter().zip(other.state.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
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
    let state = half.samples.get(1).map_or([0.0; 4], |s| <[f64; 4]>::from(s.state).map(|value| -value));
    Start::State(state.into())
}
