//! Cells that would begin beyond a stop: none of them moves, and all others do as they would alone.

use impact_atlas::analysis::{Extent, Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, decide};
use impact_atlas::control::methods::Sign;
use impact_atlas::model::{Setting, System};
use impact_atlas::plane::{Axis, Plane, PlaneError, Start, StartError, Window};
use impact_atlas::sweep::{certify, measure_extents, sample, sweep, sweep_windows};
use impact_atlas::system::Family;

use crate::common::adapter::gpu;
use crate::control::{delay, maps};

/// Two masses that meet each other, and one of them a wall: what may begin is a slanted strip.
const STRIP: &str = r#"
name = "strip"
[parameters]
[system]
frequency = "1.3"
mass = [["1", "0"], ["0", "0.5"]]
stiffness = [["2", "-1"], ["-1", "1"]]
damping = [["0.2", "-0.1"], ["-0.1", "0.1"]]
force_sin = ["1", "0.3"]
[[stop]]
name = "A"
direction = ["1", "-1"]
gap = "0.2"
restitution = "0.6"
[[stop]]
name = "B"
direction = ["0", "-1"]
gap = "0.5"
restitution = "0.8"
"#;

const SCHEDULE: Schedule = Schedule { transient: 60, observe: 60, max_period: 8, fixed_periods: false };

fn plane(family: &'static Family, x: &str, y: &str) -> Plane {
    let axis = |text: &str| Axis::of_family(text, family).unwrap();
    let parameters = Setting::defaults(family);
    Plane { x: axis(x), y: axis(y), parameters, start: Start::Rest, task: SCHEDULE }
}

/// The strip's plane, and whether x1 − x2 ≤ 0.2 and −x2 ≤ 0.5 in a cell.
fn strip() -> (Plane, impl Fn((u32, u32)) -> bool) {
    let family = Family::kept(STRIP, "strip.toml").unwrap();
    let plane = plane(family, "x1=-1:1:17", "x2=-1:1:13");
    let (x, y) = (plane.x, plane.y);
    (plane, move |(column, row)| x.value(column) - y.value(row) <= 0.2 && -y.value(row) <= 0.5)
}

/// The verdict on one cell, followed by itself.
fn alone(plane: &Plane, (column, row): (u32, u32), backend: &dyn Backend) -> Verdict {
    let system = System::new(plane.parameters_at(column, row)).unwrap();
    let start = plane.start_at(column, row).state(&system);
    decide(backend, &[Job { system, start }], &plane.task, &Unwatched).unwrap()[0]
}

#[test]
fn cells_that_begin_beyond_a_stop_are_inadmissible_and_no_others() {
    let (plane, begins) = strip();
    for backend in [&Cpu as &dyn Backend, gpu()] {
        let map = sweep(&plane, backend, &Unwatched).unwrap();
        let mut counts = [0; 2];
        for (place, verdict) in Window::whole(&plane).places().zip(&map.verdicts) {
            counts[usize::from(begins(place))] += 1;
            assert_eq!(verdict.regime != Regime::Inadmissible, begins(place), "{place:?}");
            if begins(place) {
                assert_eq!(
                    format!("{verdict:?}"),
                    format!("{:?}", alone(&plane, place, backend)),
                    "{place:?}"
                );
                continue;
            }
            let Start::State(start) = plane.start_at(place.0, place.1) else {
                panic!("the axes vary the start")
            };
            assert_eq!((verdict.state, verdict.periods, verdict.impacts), (start, 0, 0));
            let measured = [verdict.lyapunov, verdict.peak_impact_velocity, verdict.measures.power];
            assert!(measured.iter().all(|value| value.is_nan()) && verdict.impacts_per_period().is_nan());
        }
        assert!(counts.iter().all(|&cells| cells > 60), "{counts:?}");
        // In parts it is the same.
        let windows: Vec<Window> =
            (0..13).step_by(5).map(|row| Window { column: 2, row, columns: 9, rows: 2 }).collect();
        let parts = sweep_windows(&plane, &windows, backend, &Unwatched).unwrap();
        for (place, verdict) in windows.iter().flat_map(Window::places).zip(parts.iter().flatten()) {
            assert_eq!(format!("{verdict:?}"), format!("{:?}", map.at(place.0, place.1)), "{place:?}");
        }
    }
    // A sample is of what is followed.
    let cells: Vec<u64> = (0..plane.cells()).collect();
    let followed = Window::whole(&plane).places().filter(|&place| begins(place)).count();
    assert_eq!(sample(&plane, &Cpu, &cells, &Unwatched).unwrap().len(), followed);
}

/// The gap varies, the start does not; on the stop a motion begins.
#[test]
fn a_start_is_held_to_the_gap_of_each_cell() {
    let mut plane = Plane::of_paper("omega=2:4:3", "delta=0.05:0.25:5", Start::Rest, SCHEDULE).unwrap();
    let on_the_stop = plane.y.value(2);
    plane.start = Start::State([on_the_stop, 0.0, -0.5, 0.0].into());
    let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let inadmissible = |row: u32| (0..3).all(|column| map.at(column, row).regime == Regime::Inadmissible);
    let none = |row: u32| (0..3).all(|column| map.at(column, row).regime != Regime::Inadmissible);
    assert!(inadmissible(0) && inadmissible(1) && none(2) && none(3) && none(4));
    // A gap that is smallest within the axis.
    let file = r#"
name = "waist"
[parameters]
b = 0
[system]
frequency = "1"
mass = [["1"]]
stiffness = [["1"]]
damping = [["0.1"]]
force_sin = ["1"]
[[stop]]
name = "A"
direction = ["1"]
gap = "0.6 - 0.5*cos(3*b)"
restitution = "0.5"
"#;
    let family = Family::kept(file, "waist.toml").unwrap();
    let regimes = |y: &str| {
        let map = sweep(&self::plane(family, "b=-1:1:5", y), &Cpu, &Unwatched).unwrap();
        let upper = (0..5).map(|column| map.at(column, 1).regime == Regime::Inadmissible);
        upper.collect::<Vec<_>>()
    };
    assert_eq!(regimes("x1=0.05:0.5:2"), [false, false, true, false, false]);
    assert_eq!(regimes("x1=0.05:0.09:2"), [false; 5]);
}

/// Values of an axis are rounded: what stands for a place on a stop begins there.
#[test]
fn rounding_puts_no_start_beyond_a_stop() {
    let plane = plane(Family::paper(), "x1=-0.3:0.3:31", "v1=-1:1:2");
    let values: Vec<f64> = [10, 20].map(|column| plane.x.value(column)).into();
    assert!(values.iter().any(|x| x.abs() > 0.1), "the axis rounds to either side: {values:?}");
    for backend in [&Cpu as &dyn Backend, gpu()] {
        let map = sweep(&plane, backend, &Unwatched).unwrap();
        for (place, verdict) in Window::whole(&plane).places().zip(&map.verdicts) {
            assert_eq!(verdict.regime != Regime::Inadmissible, (10..=20).contains(&place.0), "{place:?}");
        }
        let beyond = alone(&plane, (20, 1), backend);
        assert_eq!(format!("{beyond:?}"), format!("{:?}", map.at(20, 1)));
    }
    let system = System::new(plane.parameters_at(20, 1)).unwrap();
    assert_eq!(plane.start_at(20, 1).state(&system)[0], 0.1, "on the stop");
    // A gap of 0 leaves no number to be rounded: the axis itself is exact there.
    let floor = self::plane(Family::builtin("bouncing-ball"), "x1=-0.1:0.5:7", "v1=-1:1:2");
    let map = sweep(&floor, &Cpu, &Unwatched).unwrap();
    let begins: Vec<bool> = (0..7).map(|column| map.at(column, 0).regime != Regime::Inadmissible).collect();
    assert_eq!(begins, [false, true, true, true, true, true, true]);
    // A place that is merely close is beyond it.
    let close = self::plane(Family::paper(), "x1=0:0.10000000001:2", "v1=-1:1:2");
    assert_eq!(sweep(&close, &Cpu, &Unwatched).unwrap().at(1, 0).regime, Regime::Inadmissible);
}

#[test]
fn a_plane_that_begins_nowhere_is_refused() {
    let nowhere = plane(Family::paper(), "x1=0.2:0.4:3", "v1=-1:1:3");
    let refused = nowhere.check().unwrap_err();
    assert!(matches!(refused, PlaneError::Nowhere(StartError::OutsideStops { .. })), "{refused:?}");
    assert!(sweep(&nowhere, &Cpu, &Unwatched).is_err());
    // Of larger planes it is found out when they are computed.
    let large = plane(Family::paper(), "x1=-200:201:2000", "v1=-1:1:2");
    assert!(large.check().is_ok());
    // The one cell that begins is none of those along the border.
    let wide = plane(Family::paper(), "x1=-4:4:3", "v1=-1:1:3");
    assert_eq!(wide.check(), Ok(()));
    assert!(plane(Family::paper(), "x1=-4:4:2", "v1=-1:1:3").check().is_err());
}

#[test]
fn nothing_is_measured_of_what_does_not_begin() {
    let (plane, begins) = strip();
    let mut map = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let before = map.verdicts.clone();
    measure_extents(&mut map, &Cpu, &Unwatched).unwrap();
    let certified = certify(&mut map, &Cpu, &Unwatched).unwrap();
    assert!(certified.periodic > 30, "{certified:?}");
    let (extents, multipliers) = (map.extents.as_ref().unwrap(), map.multipliers.as_ref().unwrap());
    let mut measured = 0;
    for (i, place) in Window::whole(&plane).places().enumerate() {
        if begins(place) {
            measured += usize::from(extents[i].rms[0] > 0.0);
            continue;
        }
        assert_eq!(format!("{:?}", map.verdicts[i]), format!("{:?}", before[i]));
        assert_eq!(format!("{:?}", extents[i]), format!("{:?}", Extent::NONE));
        assert_eq!(multipliers[i], None);
    }
    let followed = Window::whole(&plane).places().filter(|&place| begins(place)).count();
    assert_eq!(measured, followed);
}

#[test]
fn control_of_what_does_not_begin_is_inadmissible() {
    let plane = maps::plane(delay(0.5, Sign::Stabilising), "x1=-0.2:0.2:5", "v1=-1:1:3");
    for backend in [&Cpu as &dyn Backend, crate::control::gpu()] {
        let map = maps::map(&plane, backend);
        for (place, outcome) in Window::whole(&plane).places().zip(&map.verdicts) {
            let beyond = plane.x.value(place.0).abs() > 0.1001;
            assert_eq!(outcome.verdict.regime == Regime::Inadmissible, beyond, "{place:?}");
            assert_eq!(outcome.iterates == 0, beyond, "{place:?}");
        }
    }
}
