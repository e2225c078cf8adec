//! What lies in the buffers is as long as the shaders declare it.

use super::super::shader::{Arithmetic, Kernel, Residence, Shape, source};
use super::control::{count_of_force, force_words};
use super::*;
use crate::control::Controller;
use crate::dynamics::Stop;
use crate::model::Setting;
use crate::system::Family;

/// What is declared once is read alike by both compilers.
#[test]
fn structs_are_as_large_for_the_shaders_as_for_rust() {
    assert_eq!(
        Extent::WGSL,
        "struct Extent {\n    code: u32,\n    mean_squares: array<f32, MOST>,\n    peaks: array<f32, MOST>,\n}\n"
    );
    let shape = Shape { coordinates: 2, normals: 1, stops: 2 };
    let source = source(Kernel::Follow, &shape, Residence::Workgroup, Arithmetic::Native);
    let module = naga::front::wgsl::parse_str(&source).unwrap();
    let sizes = [
        ("Schedule", size_of::<Schedule>()),
        ("Dispatch", size_of::<Dispatch>()),
        ("Verdict", size_of::<Verdict>()),
        ("Rebounds", size_of::<Rebounds>()),
        ("Trace", size_of::<Trace>()),
        ("TraceDispatch", size_of::<TraceDispatch>()),
        ("Extent", size_of::<Extent>()),
        ("ExtentDispatch", size_of::<ExtentDispatch>()),
        ("ControlSchedule", size_of::<ControlSchedule>()),
        ("ControlDispatch", size_of::<ControlDispatch>()),
        ("Outcome", size_of::<Outcome>()),
    ];
    assert_eq!(sizes.len(), STRUCTS.len());
    for (name, size) in sizes {
        let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
        assert_eq!(ty.inner.size(module.to_ctx()) as usize, size, "{name}");
    }
}

/// What is written for a cell fills exactly what the shader declares, for every number of coordinates and normals.
#[test]
fn the_constants_of_a_cell_fill_what_the_shader_declares() {
    fn check<const N: usize>() {
        for normals in 1..=4 {
            let shape = Shape { coordinates: N, normals, stops: normals };
            let module = naga::front::wgsl::parse_str(&source(
                Kernel::Follow,
                &shape,
                Residence::Workgroup,
                Arithmetic::Native,
            ))
            .unwrap();
            let size = |name: &str| {
                let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
                ty.inner.size(module.to_ctx()) as usize
            };
            let flight = model::Flight::<f32, N>::blank(normals, 0.0);
            let (mut constants, mut kicks, mut cell) = (Vec::new(), Vec::new(), Vec::new());
            write_flight(&flight, &mut constants);
            write_kicks(&flight, &mut kicks);
            let stops = vec![model::StopsAlong::NONE; normals];
            let start = vec![0.0; 2 * N];
            let own = CellConstants { flow: 0, unit: 1.0, stops: &stops, start: &start };
            write_cell::<N>(&own, &mut cell);
            assert_eq!(4 * constants.len(), size("Flight"), "{shape:?}");
            assert_eq!(4 * cell.len(), size("Cell"), "{shape:?}");
            assert_eq!(4 * kicks.len(), normals * NORMAL_TERMS * size("State"), "{shape:?}");
        }
    }
    check::<1>();
    check::<2>();
    check::<3>();
    check::<4>();
}

/// So do the words of a controller, on the section of any stop of any shape.
#[test]
fn the_words_of_a_controller_fill_what_the_shader_declares() {
    for name in ["luo-ma-lv", "bouncing-ball", "three-mass-chain", "colliding-pair"] {
        let system = model::System::new(Setting::defaults(Family::builtin(name))).unwrap();
        let plant = system.plant();
        let shape = Shape { coordinates: plant.n, normals: system.normals(), stops: plant.stops.len() };
        let source = source(Kernel::Control, &shape, Residence::Workgroup, Arithmetic::Native);
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Control")).unwrap();
        for stop in 0..plant.stops.len() {
            let words = control_words(&Controller::None(Stop(stop as u8)), &system);
            assert_eq!(4 * words.len(), ty.inner.size(module.to_ctx()) as usize, "{name}");
            // Where the section's stop stands among the members.
            assert_eq!(words[1], stop as u32, "{name}");
        }
        let naga::TypeInner::Struct { members, .. } = &ty.inner else { panic!("Control is no struct") };
        let offset = |name: &str| members.iter().find(|m| m.name.as_deref() == Some(name)).unwrap().offset;
        assert_eq!([offset("stop"), offset("mirror"), offset("push")], [4, 20, 36], "{name}");
    }
}

/// What a force changes of a step on a stop stands where the shader reads it.
#[test]
fn a_force_changes_steps_on_stops() {
    let system = model::System::new(Setting::defaults(Family::paper())).unwrap();
    let shape = Shape { coordinates: 2, normals: 1, stops: 2 };
    let source = source(Kernel::Control, &shape, Residence::Workgroup, Arithmetic::Native);
    let module = naga::front::wgsl::parse_str(&source).unwrap();
    let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Control")).unwrap();
    let naga::TypeInner::Struct { members, .. } = &ty.inner else { panic!("Control is no struct") };
    let place = |name: &str| {
        let member = members.iter().find(|member| member.name.as_deref() == Some(name));
        member.unwrap().offset as usize / 4
    };
    let words = force_words::<2>(&system, 1);
    assert_eq!(words.len(), count_of_force::<2>(1));
    let held = model::Flight::<f64, 2>::new(&system.loaded_alone(1)).normals[0].held;
    assert_ne!(held.gamma_sin, held.gamma_cos);
    for (name, state) in [("drive_held_sin", held.gamma_sin), ("drive_held_cos", held.gamma_cos)] {
        let expected: Vec<u32> = state.values().map(|value| (value as f32).to_bits()).collect();
        let begins = place(name) - place("push");
        assert_eq!(words[begins..begins + 4], expected, "{name}");
    }
}
