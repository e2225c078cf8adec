//! Theory against simulation: the curves run along the boundaries that a map shows.

use impact_atlas::curves::{Curve, Kind};
use impact_atlas::model::Parameters;
use impact_atlas::validate::boundaries;

use super::{curves, map};

/// The curve somewhere else, up by some length.
fn moved(curve: &Curve, by: f64) -> Curve {
    let mut moved = curve.clone();
    for point in &mut moved.points {
        point.y += by;
    }
    moved
}

/// Cells as small as those of 800 × 600 cells on the plane of Fig. 5.
#[test]
fn the_curves_are_the_boundaries_of_the_map() {
    let map = map("omega=3:3.954:160", "delta=0.05:0.179:100", Parameters::default());
    let found = curves(&map);
    let agreement = boundaries(&map, &found);
    let kinds: Vec<Kind> = agreement.curves.iter().map(|curve| curve.kind).collect();
    for kind in [Kind::Pitchfork, Kind::PeriodDoubling, Kind::NeimarkSacker] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
    for curve in
        agreement.curves.iter().filter(|curve| curve.kind != Kind::Grazing && curve.motion == "1-1-1")
    {
        let distance = curve.distance.unwrap();
        assert!(distance.median <= 1.0 && distance.p95 <= 3.0, "{curve:?}");
        assert!(curve.compared * 10 >= curve.places * 9, "{curve:?}");
    }
    assert!(agreement.check().holds, "{agreement:?}");

    let pitchfork = found.iter().find(|curve| curve.kind == Kind::Pitchfork).unwrap();
    let off = boundaries(&map, &[moved(pitchfork, 4.0 * 0.0013)]);
    assert!(!off.check().holds, "a curve four cells off does not pass: {off:?}");
}
