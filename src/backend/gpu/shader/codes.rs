//! Every code that the shaders share with the Rust side, and what can be asked of one.

use std::fmt::{Debug, Write};

use strum::VariantArray;

use super::template::Shape;
use crate::analysis::{Reading, Regime, Stage};
use crate::backend::gpu::layout::ExtentCode;
use crate::control::Progress;
use crate::dynamics::EventCode;

/// Their declarations in WGSL.
pub fn source(shape: &Shape) -> String {
    let mut source = String::from("// Generated.\n");
    codes(&mut source, "REGIME", &Regime::ALL, |regime| u32::from(regime.code()));
    codes(&mut source, "STAGE", Stage::VARIANTS, |stage| stage as u32);
    codes(&mut source, "PROGRESS", Progress::VARIANTS, |progress| progress as u32);
    codes(&mut source, "EVENT", EventCode::VARIANTS, |event| event as u32);
    codes(&mut source, "EXTENT", ExtentCode::VARIANTS, |code| code as u32);
    let readings = [Reading::VBefore, Reading::VAfter, Reading::Tau];
    codes(&mut source, "READING", &readings, |reading| reading.code(shape.coordinates));
    predicate(&mut source, "STAGE", "stage_is_over", Stage::VARIANTS, Stage::is_over);
    predicate(&mut source, "PROGRESS", "progress_is_over", Progress::VARIANTS, Progress::is_over);
    predicate(&mut source, "EVENT", "event_is_impact", EventCode::VARIANTS, EventCode::is_impact);
    predicate(&mut source, "EVENT", "event_ends_step", EventCode::VARIANTS, EventCode::ends_step);
    source
}

fn codes<C: Copy + Debug>(source: &mut String, kind: &str, all: &[C], code: impl Fn(C) -> u32) {
    for &each in all {
        let name = constant(kind, each);
        writeln!(source, "const {name} = {}u;", code(each)).expect("a string takes anything");
    }
}

/// A function that says of a code whether something holds of it.
fn predicate<C: Copy + Debug>(
    source: &mut String,
    kind: &str,
    name: &str,
    all: &[C],
    holds: impl Fn(C) -> bool,
) {
    let those = all.iter().filter(|&&each| holds(each));
    let asked: Vec<String> = those.map(|&each| format!("(code == {})", constant(kind, each))).collect();
    writeln!(source, "fn {name}(code: u32) -> bool {{\n    return {};\n}}", asked.join(" | "))
        .expect("a string takes anything");
}

/// `NoImpact` of a regime becomes REGIME_NO_IMPACT.
fn constant(kind: &str, code: impl Debug) -> String {
    let words: String = format!("{code:?}")
        .char_indices()
        .flat_map(|(i, c)| {
            let gap = (i > 0 && c.is_uppercase()).then_some('_');
            gap.into_iter().chain(c.to_uppercase())
        })
        .collect();
    format!("{kind}_{words}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_have_the_names_of_their_variants() {
        assert_eq!(constant("REGIME", Regime::PeriodicSticking), "REGIME_PERIODIC_STICKING");
        assert_eq!(constant("READING", Reading::VBefore), "READING_V_BEFORE");
    }

    #[test]
    fn a_predicate_lists_the_codes_of_which_it_holds() {
        let mut source = String::new();
        predicate(&mut source, "STAGE", "is", Stage::VARIANTS, |stage| {
            stage != Stage::Quiet && stage.is_over()
        });
        assert_eq!(
            source,
            "fn is(code: u32) -> bool {\n    return (code == STAGE_OBSERVED) | (code == STAGE_FAILED);\n}\n"
        );
    }
}
