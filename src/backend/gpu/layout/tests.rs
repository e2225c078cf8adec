//! The structs lie as the shaders declare them.

use std::mem::{offset_of, size_of};

use super::super::shader::{Arithmetic, Kernel, Residence, Shape, source};
use super::trace::Rebounds;
use super::*;
use crate::control::Controller;
use crate::dynamics::Stop;
use crate::model::Setting;
use crate::system::Family;

/// A type of a shader as Rust writes it.
fn written(module: &naga::Module, ty: naga::Handle<naga::Type>) -> String {
    use naga::{ArraySize, ScalarKind, TypeInner};
    let ty = &module.types[ty];
    match &ty.inner {
        TypeInner::Scalar(scalar) => match scalar.kind {
            ScalarKind::Uint => "u32".to_owned(),
            ScalarKind::Sint => "i32".to_owned(),
            ScalarKind::Float => "f32".to_owned(),
            other => panic!("no member is of kind {other:?}"),
        },
        TypeInner::Array { base, size: ArraySize::Constant(size), .. } => {
            format!("[{}; {size}]", written(module, *base))
        }
        TypeInner::Struct { .. } => ty.name.clone().unwrap(),
        other => panic!("no member is {other:?}"),
    }
}

/// The type of a member, without the modules that it lies in.
fn type_of<S, T>(_: fn(&S) -> &T) -> String {
    let name = std::any::type_name::<T>();
    name.rsplit("::").next().unwrap_or(name).to_owned()
}

/// A member: its name, its offset and its type.
type Member = (String, u32, String);

/// The members of a shader's struct, and its size in an array.
fn declared(name: &str) -> (Vec<Member>, u32) {
    let declares = |source: String| {
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let there = module.types.iter().any(|(_, ty)| ty.name.as_deref() == Some(name));
        there.then_some(module)
    };
    let shape = Shape { coordinates: 2, normals: 1, stops: 2 };
    let module = Kernel::ALL
        .into_iter()
        .find_map(|kernel| declares(source(kernel, &shape, Residence::Buffer, Arithmetic::Native)))
        .unwrap();
    let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
    let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
    let member = |m: &naga::StructMember| (m.name.clone().unwrap(), m.offset, written(&module, m.ty));
    (members.iter().map(member).collect(), *span)
}

macro_rules! assert_layout {
    ($name:ident { $($field:ident),+ $(,)? }) => {
        let (members, span) = declared(stringify!($name));
        let here: Vec<Member> = vec![$((
            stringify!($field).to_owned(),
            offset_of!($name, $field) as u32,
            type_of(|all: &$name| &all.$field),
        )),+];
        assert_eq!(members, here);
        assert_eq!(span as usize, size_of::<$name>());
    };
}

#[test]
fn structs_lie_as_the_shaders_declare_them() {
    assert_layout!(Schedule { transient, observe, max_period, fixed_periods });
    assert_layout!(Dispatch { schedule, count, budget, begin, row });
    assert_layout!(Verdict {
        regime,
        n,
        symmetric,
        lyapunov,
        impacts_per_stop,
        state,
        impacts,
        impacts_total,
        peak_impact_velocity,
        periods,
        returning,
        observed,
        power,
        contact,
    });
    assert_layout!(TraceDispatch { schedule, count, budget, begin, row, section, reading, capacity, unused });
    assert_layout!(ExtentDispatch { count, budget, begin, row });
    assert_layout!(Extent { code, mean_squares, peaks });
    assert_layout!(Rebounds { last, stop, run, longest });
    assert_layout!(Trace { rebounds, passages });
    assert_layout!(ControlSchedule { start, iterates, observed, fixed_iterates });
    assert_layout!(ControlDispatch { schedule, count, budget, begin, row, max_period });
    assert_layout!(Outcome { verdict, period, iterates, converged_at, signal, runaway, escapes, effort });
}

/// The negative control: a member of another type, as wide as the declared one, is seen.
#[test]
fn a_member_of_another_type_is_seen() {
    struct Schedule {
        transient: f32,
    }
    let (members, _) = declared("Schedule");
    let here = ("transient".to_owned(), 0, type_of(|all: &Schedule| &all.transient));
    assert_eq!((&members[0].0, members[0].1, members[0].2.as_str()), (&here.0, here.1, "u32"));
    assert_ne!(members[0], here);
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
                Residence::Buffer,
                Arithmetic::Native,
            ))
            .unwrap();
            let size = |name: &str| {
                let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
                ty.inner.size(module.to_ctx()) as usize
            };
            let flight = model::Flight::<f32, N>::blank(normals, 0.0);
            let (mut constants, mut kicks) = (Vec::new(), Vec::new());
            write_flight(&flight, &mut constants);
            write_kicks(&flight, &mut kicks);
            assert_eq!(4 * constants.len(), size("Flight"), "{shape:?}");
            assert_eq!(4 * kicks.len(), normals * KICK_TERMS * size("State"), "{shape:?}");
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
        let source = source(Kernel::Control, &shape, Residence::Buffer, Arithmetic::Native);
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Control")).unwrap();
        for stop in 0..plant.stops.len() {
            let words = Control::words(&Controller::None(Stop(stop as u8)), &system);
            assert_eq!(4 * words.len(), ty.inner.size(module.to_ctx()) as usize, "{name}");
            // Where the section's stop stands among the members.
            assert_eq!(words[6], stop as u32, "{name}");
        }
        let naga::TypeInner::Struct { members, .. } = &ty.inner else { panic!("Control is no struct") };
        let offset = |name: &str| members.iter().find(|m| m.name.as_deref() == Some(name)).unwrap().offset;
        assert_eq!([offset("stop"), offset("amplitude"), offset("mirror")], [24, 40, 68], "{name}");
    }
}
