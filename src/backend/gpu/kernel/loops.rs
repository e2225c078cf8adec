//! The loop iterations of a move, counted in the shader itself: what a dispatch is bounded by is at least that.

use std::collections::HashMap;

use super::drive::FETCH;
use super::{control, extent, follow, trace};
use crate::analysis::constants::{CLEAR_STEPS, HELD_STEPS, ROUNDS, SQUARINGS, TURNS};
use crate::backend::gpu::layout::NORMAL_TERMS;
use crate::backend::gpu::shader::{Arithmetic, Kernel, Residence, Shape, source};
use crate::control::{ControlSchedule, DELAYS, LONGEST_DELAY, LONGEST_ON_DEVICE};
use crate::dynamics::constants::{HELD_FLIGHTS, SQUEEZES};
use crate::model::Real;
use crate::model::vector::MOST;

/// The largest number of iterates in one period that the schedule of the test looks for.
const REACH: u32 = LONGEST_ON_DEVICE as u32;

/// How often a loop runs at most, by its head; the loop over moves once, so that what it counts is one of them.
///
/// # Panics
/// If the loop is not known: then a dispatch is not bounded by it, and Mesa's would be cut short in silence.
fn bound(head: &str) -> u32 {
    let counted = [
        ("taken < dispatch.budget", 1),
        ("term < NORMAL_TERMS", NORMAL_TERMS as u32),
        ("normal < NORMALS", MOST as u32),
        ("k <= ORDER", <f32 as Real>::ORDER as u32),
        ("tries <= HELD_FLIGHTS + 1u", HELD_FLIGHTS + 1),
        ("squeeze < SQUEEZES", SQUEEZES),
        ("k <= SQUARINGS", SQUARINGS + 1),
        ("turn < TURNS", TURNS),
        ("step < HELD_STEPS", HELD_STEPS),
        ("round < ROUNDS", ROUNDS),
        ("step < CLEAR_STEPS", CLEAR_STEPS),
        ("half <= 2.0", extent::HALVES),
        ("max(reach, LONGEST_DELAY)", REACH.max(LONGEST_DELAY as u32)),
        ("m <= reach", REACH),
        ("m = reach", REACH),
        ("m < LONGEST", LONGEST_ON_DEVICE as u32),
        ("i < period", REACH),
        ("DELAYS", DELAYS as u32),
    ];
    let known = counted.iter().find(|(part, _)| head.contains(part));
    known.unwrap_or_else(|| panic!("`{head}` is not counted: let the budget of a dispatch know it")).1
}

/// The functions of a source by their names: each line that calls or loops, in their order.
fn functions(source: &str) -> HashMap<&str, Vec<&str>> {
    let mut found: HashMap<&str, Vec<&str>> = HashMap::new();
    let mut own = "";
    for line in source.lines() {
        if line == "}" {
            own = "";
        } else if let Some(head) = line.strip_prefix("fn ") {
            own = head.split('(').next().unwrap_or_default();
        } else if !own.is_empty() {
            found.entry(own).or_default().push(line.split("//").next().unwrap_or_default());
        }
    }
    found
}

/// The iterations of all loops in one call of a function, whichever branches it takes.
fn iterations<'a>(
    name: &str,
    functions: &HashMap<&'a str, Vec<&'a str>>,
    known: &mut HashMap<String, u32>,
) -> u32 {
    if let Some(&count) = known.get(name) {
        assert!(count < u32::MAX, "{name} calls itself");
        return count;
    }
    known.insert(name.to_owned(), u32::MAX);
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut count, mut depth) = (0, 0);
    // How often what stands deeper than a depth runs.
    let mut within: Vec<(usize, u32)> = Vec::new();
    for line in &functions[name] {
        let times: u32 = within.iter().map(|(_, times)| times).product();
        let head = line.trim_start();
        let is_loop = ["for ", "while ", "loop "].iter().any(|word| head.starts_with(word));
        for call in line.split('(').map(|before| before.rsplit(|c| !word(c)).next().unwrap_or_default()) {
            if functions.contains_key(call) {
                count += times * iterations(call, functions, known);
            }
        }
        if is_loop {
            count += times * bound(head);
            within.push((depth, bound(head)));
        }
        depth = (depth + line.matches('{').count()).saturating_sub(line.matches('}').count());
        within.retain(|(at, _)| depth > *at);
    }
    known.insert(name.to_owned(), count);
    count
}

#[test]
fn no_kernel_has_more_loop_iterations_than_its_dispatches_are_bounded_by() {
    let schedule = ControlSchedule { from: 0, iterates: 100, fixed: false, max_period: REACH };
    for (coordinates, normals) in [(1, 1), (2, 1), (2, 2), (4, 4)] {
        let shape = Shape { coordinates, normals, stops: 4 };
        for (kernel, allowed) in [
            (Kernel::Follow, follow::ITERATIONS),
            (Kernel::Trace, trace::ITERATIONS),
            (Kernel::Extent, extent::WITH_FLIGHTS),
            (Kernel::Control, control::iterations(&schedule)),
        ] {
            let source = source(kernel, &shape, Residence::Workgroup, Arithmetic::Native);
            let functions = functions(&source);
            let counted = iterations(kernel.entry(), &functions, &mut HashMap::new()) - FETCH;
            println!("{kernel:?} {shape:?}: {counted} of {allowed}");
            assert!(counted <= allowed, "{kernel:?}: {counted} iterations in a move, not {allowed}");
            assert!(counted > <f32 as Real>::ORDER as u32, "{kernel:?}: {counted}");
        }
    }
}

#[test]
fn a_loop_that_nobody_counted_is_found() {
    let source = "fn a() {\n    for (var k = 1u; k <= ORDER; k++) {\n        b();\n    }\n}\nfn b() {\n    for (var j = 0u; j < 3u; j++) {\n    }\n}\n";
    let found = std::panic::catch_unwind(|| iterations("a", &functions(source), &mut HashMap::new()));
    assert!(found.is_err());
    let known = source.replace("j < 3u", "turn < TURNS");
    let order = <f32 as Real>::ORDER as u32;
    assert_eq!(iterations("a", &functions(&known), &mut HashMap::new()), order * (1 + TURNS));
}
