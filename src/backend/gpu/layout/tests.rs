//! The structs lie as the shaders declare them.

use std::mem::{offset_of, size_of};

use super::super::shader;
use super::trace::Rebounds;
use super::*;

/// The members of a shader's struct, with their offsets, and its size in an array.
fn declared(name: &str) -> (Vec<(String, u32)>, u32) {
    let declares = |source: String| {
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let there = module.types.iter().any(|(_, ty)| ty.name.as_deref() == Some(name));
        there.then_some(module)
    };
    let sources = [shader::follow_source(), shader::trace_source(), shader::control_source()];
    let module = sources.into_iter().find_map(declares).unwrap();
    let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
    let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
    (members.iter().map(|m| (m.name.clone().unwrap(), m.offset)).collect(), *span)
}

macro_rules! assert_layout {
    ($name:ident { $($field:ident),+ $(,)? }) => {
        let (members, span) = declared(stringify!($name));
        let here: Vec<(String, u32)> =
            vec![$((stringify!($field).to_owned(), offset_of!($name, $field) as u32)),+];
        assert_eq!(members, here);
        assert_eq!(span as usize, size_of::<$name>());
    };
}

#[test]
fn structs_lie_as_the_shaders_declare_them() {
    assert_layout!(Flight {
        phi,
        gamma_sin,
        gamma_cos,
        bound,
        forced,
        h,
        inverse_h,
        turn_sin,
        turn_cos,
        omega,
        delta,
        r,
        coupling_damping,
        inverse_mass,
        ground_stiffness,
        ground_damping,
        force1,
        force2,
        bound_forcing,
        rate,
        reach,
        mass,
        ground,
        compliance,
        linear_exponent,
        steps,
        unused,
    });
    assert_layout!(Kick { terms });
    assert_layout!(Schedule { transient, observe, max_period, fixed_periods });
    assert_layout!(Dispatch { schedule, count, budget, begin, row });
    assert_layout!(Verdict {
        regime,
        n,
        p,
        q,
        symmetric,
        lyapunov,
        state,
        impacts,
        impacts_total,
        peak_impact_velocity,
        periods,
        returning,
    });
    assert_layout!(TraceDispatch { schedule, count, budget, begin, row, section, reading, capacity, unused });
    assert_layout!(Rebounds { last, run, longest });
    assert_layout!(Trace { rebounds, passages });
    assert_layout!(ControlSchedule { start, iterates, observed, fixed_iterates });
    assert_layout!(ControlDispatch { schedule, count, budget, begin, row, max_period });
    assert_layout!(Control {
        method,
        convention,
        component,
        delay,
        period,
        seed,
        amplitude,
        weight,
        dead_band,
        ratio,
        phase,
        wanted,
        noise,
        drive_bound,
        point,
        gains,
        drive_sin,
        drive_cos,
    });
    assert_layout!(Outcome { verdict, period, iterates, converged_at, signal, runaway, escapes, effort });
    assert_eq!(u64::from(declared("Observer").1), OBSERVER_BYTES);
    assert_eq!(u64::from(declared("Controlled").1), CONTROLLED_BYTES);
}
