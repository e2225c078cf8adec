//! Bifurcation diagrams: the same points on both back ends, hysteresis, tiles, files.

use std::io::Cursor;

use impact_atlas::analysis::{CHATTER_RUN, Probe, Reading, Regime, Section};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched};
use impact_atlas::diagram::{Diagram, DiagramError, DiagramSpec, ExponentUnit, Sweep};
use impact_atlas::dynamics::Stop;
use impact_atlas::figure::Size;
use impact_atlas::model::{Parameters, System};
use impact_atlas::plane::Start;
use impact_atlas::render::diagram_figure;
use impact_atlas::store::write_diagram;
use impact_atlas::sweep::{SweepError, diagram};

use crate::common::adapter::gpu;

fn spec(x: &str, sweep: &str, parameters: Parameters) -> DiagramSpec {
    DiagramSpec {
        x: x.parse().unwrap(),
        parameters: parameters.into(),
        sweep: sweep.parse().unwrap(),
        start: Start::Symmetric,
        probe: Probe::new(Section::A, Reading::VBefore).unwrap(),
        schedule: DiagramSpec::schedule(400, 40, 16),
        capacity: 200,
        spectrum: None,
    }
}

fn computed(spec: &DiagramSpec, backend: &dyn Backend) -> Diagram {
    diagram(spec, backend, &Unwatched).unwrap()
}

fn at(delta: f64) -> Parameters {
    Parameters { delta, ..Parameters::default() }
}

/// Columns in which both diagrams are periodic, and the largest difference of their points there.
fn difference(a: &Diagram, b: &Diagram) -> (usize, f64) {
    let (mut periodic, mut worst) = (0, 0.0_f64);
    for (a, b) in a.branches[0].traces.iter().zip(&b.branches[0].traces) {
        if a.verdict.regime != Regime::Periodic {
            continue;
        }
        assert_eq!((a.verdict.label(), a.readings.len()), (b.verdict.label(), b.readings.len()));
        periodic += 1;
        for (x, y) in a.readings.iter().zip(&b.readings) {
            worst = worst.max((x - y).abs());
        }
    }
    (periodic, worst)
}

#[test]
fn both_back_ends_read_the_same_points() {
    let probes = [
        (Section::A, Reading::VBefore),
        (Section::B, Reading::VAfter),
        (Section::A, Reading::Tau),
        (Section::B, Reading::X1),
        (Section::Strobe, Reading::X2),
        (Section::A, Reading::V2),
        (Section::Strobe, Reading::V1),
    ];
    for (section, reading) in probes {
        let probe = Probe::new(section, reading).unwrap();
        let spec = DiagramSpec { probe, ..spec("omega=5:3.2:12", "rest", at(0.1)) };
        let (periodic, worst) = difference(&computed(&spec, &Cpu), &computed(&spec, gpu()));
        assert!(periodic >= 11 && worst < 1e-4, "{probe:?}: {worst} in {periodic} columns");
        let mut off = spec.clone();
        off.parameters = off.parameters.with_named("r", off.parameters.named("r").unwrap() + 0.03);
        let (_, worst) = difference(&computed(&spec, &Cpu), &computed(&off, gpu()));
        let fixed = reading == Reading::X1;
        assert!(worst > 1e-4 || fixed, "{probe:?}: another system differs by only {worst}");
    }
}

#[test]
fn chatter_and_full_buffers_are_told_alike() {
    let spec = DiagramSpec {
        schedule: DiagramSpec::schedule(60, 10, 4),
        capacity: 30,
        ..spec("omega=0.25:0.4:4", "rest", at(0.545))
    };
    let (ours, theirs) = (computed(&spec, &Cpu), computed(&spec, gpu()));
    for (a, b) in ours.branches[0].traces.iter().zip(&theirs.branches[0].traces) {
        // Single precision closes complete chatter a few rebounds sooner.
        let complete = a.verdict.regime == Regime::PeriodicSticking;
        assert!(
            a.rebounds >= 3 && (complete || a.rebounds == b.rebounds),
            "{} and {}",
            a.rebounds,
            b.rebounds
        );
        assert_eq!(a.rebounds >= CHATTER_RUN, b.rebounds >= CHATTER_RUN);
        assert_eq!(a.readings.len(), b.readings.len());
        assert_eq!(a.left_out > 0, b.left_out > 0);
    }
    assert!(ours.left_out() > 0);
    let roomy = computed(&DiagramSpec { capacity: 4000, ..spec.clone() }, &Cpu);
    assert_eq!(roomy.left_out(), 0);
    for (a, b) in ours.branches[0].traces.iter().zip(&roomy.branches[0].traces) {
        assert_eq!(a.readings[..], b.readings[..a.readings.len()]);
        assert_eq!(a.readings.len() + a.left_out as usize, b.readings.len());
    }
}

/// An adapter's portions of work depend on its speed at the moment; what it reads does not.
#[test]
fn the_same_bits_for_any_tile() {
    let spec = spec("omega=1.2:3.6:10", "rest", at(0.1));
    let jobs: Vec<Job> = (0..10)
        .map(|column| Job {
            system: System::new(spec.parameters_at(column)).unwrap(),
            start: [0.0; 4].into(),
        })
        .collect();
    let backends: [&dyn Backend; 2] = [&Cpu, gpu()];
    for backend in backends {
        let trace = |jobs: &[Job]| {
            backend.trace(jobs, &spec.schedule, spec.probe, spec.capacity, &Unwatched).unwrap()
        };
        let whole = trace(&jobs);
        let parts: Vec<_> = jobs.chunks(3).flat_map(trace).collect();
        // As text, in which every bit counts and NaN equals NaN.
        assert_eq!(format!("{whole:?}"), format!("{parts:?}"), "{}", backend.name());
        assert!(whole.iter().any(|trace| trace.verdict.regime == Regime::Chaotic));
        assert_eq!(trace(&[]), []);
    }
}

/// At δ = 0.6 the motion without impact and 1-1-1 coexist: from high ω down nothing strikes, from low ω up 1-1-1 holds
/// until it ends in a fold.
#[test]
fn hysteresis_is_stated_with_its_range() {
    let spec = spec("omega=2.7:4.1:36", "both", at(0.6));
    let diagram = computed(&spec, &Cpu);
    let [range] = &diagram.coexistence()[..] else { panic!("one range: {:?}", diagram.coexistence()) };
    assert_eq!(range.from, 2.7);
    assert!((3.5..4.0).contains(&range.until), "{range:?}");
    assert_eq!((&*range.pairs[0].first, &*range.pairs[0].second), ("no impact", "1-1-1 symmetric"));
    // Where both begin on the same motion and neither loses it, there is nothing to tell.
    let calm = DiagramSpec { x: "omega=3.8:4.6:9".parse().unwrap(), parameters: at(0.1).into(), ..spec };
    assert_eq!(computed(&calm, &Cpu).coexistence(), []);
}

#[test]
fn the_order_of_writing_does_not_matter() {
    let falling = computed(&spec("omega=3.9:3.1:9", "both", at(0.1)), &Cpu);
    let rising = computed(&spec("omega=3.1:3.9:9", "both", at(0.1)), &Cpu);
    for (a, b) in falling.branches.iter().zip(&rising.branches) {
        assert_eq!(a.direction, b.direction);
        for (a, b) in a.traces.iter().zip(b.traces.iter().rev()) {
            // The values of the axis differ in their last bit, hence so may everything else.
            assert_eq!((a.verdict.label(), a.readings.len()), (b.verdict.label(), b.readings.len()));
        }
    }
}

#[test]
fn spectra_belong_to_the_motion() {
    let spec =
        DiagramSpec { spectrum: Some(ExponentUnit::Period), ..spec("omega=2.83:3.83:3", "rest", at(0.1)) };
    // Exponents of chaos are averages over other periods than the verdict's: both look for long.
    let spec = DiagramSpec { schedule: DiagramSpec::schedule(400, 600, 16), ..spec };
    let diagram = computed(&spec, &Cpu);
    let spectrum = diagram.branches[0].spectrum.as_ref().unwrap();
    for (exponents, trace) in spectrum.iter().zip(&diagram.branches[0].traces) {
        assert!(exponents.is_sorted_by(|a, b| a >= b), "{exponents:?}");
        assert!((exponents[0] - f64::from(trace.verdict.lyapunov)).abs() < 0.1, "{exponents:?}");
    }
    assert!(spectrum[0][0] > 0.1 && spectrum[2][0] < -0.01, "chaos, then order: {spectrum:?}");
    // 1-1-1 returns to A once a period; chaos at ω = 2.83 returns less often.
    let iterates = computed(&DiagramSpec { spectrum: Some(ExponentUnit::Iterate), ..spec.clone() }, &Cpu);
    let per_iterate = iterates.branches[0].spectrum.as_ref().unwrap();
    assert_eq!(per_iterate[2], spectrum[2]);
    assert!(per_iterate[0][0] > 0.0 && per_iterate[0] != spectrum[0]);
    // On the section of the other stop its returns count.
    let probe = Probe::new(Section::Impact(Stop::B), Reading::VBefore).unwrap();
    let other = computed(&DiagramSpec { spectrum: Some(ExponentUnit::Iterate), probe, ..spec }, &Cpu);
    let other = other.branches[0].spectrum.as_ref().unwrap();
    assert!(other[2] == spectrum[2] && other[0] != per_iterate[0], "{other:?}");
}

#[test]
fn what_cannot_be_computed_is_refused() {
    let refused = |spec: DiagramSpec| match diagram(&spec, &Cpu, &Unwatched) {
        Err(SweepError::Diagram(error)) => error,
        other => panic!("{other:?}"),
    };
    let carried = spec("v1=-1:1:5", "down", at(0.1));
    assert!(matches!(refused(carried), DiagramError::CarriedStart { .. }));
    assert_eq!(refused(spec("v1=-1:1:5", "symmetric", at(0.1))), DiagramError::SymmetricStartVaried);
    assert!(matches!(refused(spec("x1=-0.3:-0.2:5", "rest", at(0.1))), DiagramError::Nowhere(_)));
    let carried = DiagramSpec {
        start: Start::State([0.2, 0.0, 0.0, 0.0].into()),
        ..spec("delta=0.1:0.4:4", "both", at(0.1))
    };
    let beyond = refused(carried.clone());
    assert!(matches!(beyond, DiagramError::Beyond { axis: "delta", value: 0.1, .. }), "{beyond:?}");
    // The sweep that begins with the widest gap begins within it.
    assert!(diagram(&DiagramSpec { sweep: "down".parse().unwrap(), ..carried }, &Cpu, &Unwatched).is_ok());
    let none = DiagramSpec { capacity: 0, ..spec("omega=1:2:5", "rest", at(0.1)) };
    assert!(matches!(refused(none), DiagramError::Capacity { .. }));
    assert!(matches!("sideways".parse::<Sweep>(), Err(DiagramError::Sweep(_))));
}

type Archive = zip::ZipArchive<Cursor<Vec<u8>>>;

fn array<'a>(archive: &'a mut Archive, name: &str) -> npyz::NpyFile<impl std::io::Read + 'a> {
    npyz::NpyFile::new(archive.by_name(&npyz::npz::file_name_from_array_name(name)).unwrap()).unwrap()
}

#[test]
fn files_hold_everything() {
    let spec =
        DiagramSpec { spectrum: Some(ExponentUnit::Period), ..spec("omega=3.9:3.1:5", "both", at(0.1)) };
    let diagram = computed(&spec, &Cpu);
    let mut file = Cursor::new(Vec::new());
    write_diagram(&diagram, &mut file).unwrap();
    let mut archive = zip::ZipArchive::new(Cursor::new(file.into_inner())).unwrap();
    let counts: Vec<u32> = array(&mut archive, "counts").into_vec().unwrap();
    let readings: Vec<f64> = array(&mut archive, "readings").into_vec().unwrap();
    let traces: Vec<_> = diagram.branches.iter().flat_map(|branch| &branch.traces).collect();
    assert_eq!(counts, traces.iter().map(|trace| trace.readings.len() as u32).collect::<Vec<_>>());
    assert_eq!(readings, traces.iter().flat_map(|trace| trace.readings.clone()).collect::<Vec<_>>());
    assert_eq!(array(&mut archive, "spectrum").shape(), [2, 5, 4]);
    let config: Vec<String> = array(&mut archive, "config").into_vec().unwrap();
    let config: serde_json::Value = serde_json::from_str(&config.concat()).unwrap();
    // The file's configuration is the request, with what the answer adds: who computed it.
    let requested = serde_json::to_value(&spec).unwrap();
    for (key, value) in requested.as_object().unwrap() {
        assert_eq!(&config[key], value, "{key}");
    }
    assert_ne!(config["adapter"], serde_json::Value::Null);
    assert_eq!(config["parameters"]["r"].as_f64(), spec.parameters.named("r"));

    let picture = diagram_figure(&diagram).draw(Size::new(1600, 1900).unwrap(), &diagram.config()).unwrap();
    for words in
        ["forcing frequency ", "velocity before impact ", "drawn over down", "1-1-1", "λ", "forcing periods,"]
    {
        assert!(picture.svg().contains(words), "{words}");
    }
}
