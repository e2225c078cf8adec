//! What moves at one cell: its motion, its portrait, its multipliers and exponents, and what else moves there.

#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
mod beside;
mod figures;

use serde_json::{Value, json};

use super::asked::refused;
use super::batch::verdicts;
use super::describe::start_words;
use super::lattice::Cell;
use super::scene::Scene;
use super::store::Tiles;
use super::task::{Ended, Task};
use crate::analysis::Verdict;
use crate::model::{Number, System};
use crate::plane::{Axis, Component, Plane, Quantity};
use crate::render::{Motion, words};
use crate::theory::{SettledMotion, Spectrum};

/// Forcing periods over which exponents are measured.
const EXPONENTS_OVER: u32 = 2000;

/// Answers a click on a cell, the quickest part first; figures are so many pixels wide.
///
/// # Errors
/// [`Ended`], also where there is no such system, or it begins beyond a stop.
pub fn probe(scene: &Scene, tiles: &Tiles, cell: Cell, width: u32, task: &Task) -> Result<(), Ended> {
    let [x, y] = scene.values(cell);
    let missing = |what: &str| {
        let (a, b) = (scene.plane.x.quantity.name(), scene.plane.y.quantity.name());
        let place = format!("{a} = {}, {b} = {}", Number(x), Number(y));
        let why = scene.missing(x, y).unwrap_or_else(|| "outside the range of its parameters".to_owned());
        refused(format!("{what} at {place}: {why}"))
    };
    let begun = scene.job(cell).zip(scene.alone(x, y)).ok_or_else(|| missing("there is no such system"))?;
    let (Ok(job), alone) = begun else { return Err(missing("no motion begins").into()) };
    scene.prepare(std::iter::once(cell)).map_err(refused)?;
    let known = scene.known(cell).or_else(|| tiles.cell(scene.id, cell).flatten());
    let verdict = match known {
        Some(verdict) => verdict,
        None => verdicts(scene, &[cell], task)?.pop().flatten().ok_or(Ended::Cancelled)?,
    };
    let start = alone.start_at(0, 0);
    task.answer("motion", motion(scene, &alone, &verdict));
    task.check()?;
    figures::portrait(&job.system, &verdict, width, task);
    task.check()?;
    task.answer("multipliers", multipliers(&job.system, &verdict));
    task.check()?;
    figures::section(&job.system, &verdict, width, task);
    task.check()?;
    task.answer("exponents", exponents(&job.system, &verdict));
    task.check()?;
    beside::coexisting(scene, &job.system, start, &verdict, task)
}

/// The place and the motion in words and numbers.
fn motion(scene: &Scene, alone: &Plane, verdict: &Verdict) -> Value {
    let plane = &scene.plane;
    let family = plane.parameters.family();
    let place = |axis: &Axis| json!({ "name": axis.quantity.name(), "value": axis.first });
    let fixed: Vec<Value> = (plane.parameters.entries())
        .filter(|(parameter, _)| {
            ![plane.x.quantity, plane.y.quantity].contains(&Quantity::Parameter(*parameter))
        })
        .map(|(parameter, value)| json!({ "name": parameter.name(), "value": value }))
        .collect();
    let state: Vec<Value> = (Component::all(family.n()).zip(verdict.state.iter()))
        .map(|(component, value)| json!({ "name": component.name(), "value": value }))
        .collect();
    json!({
        "place": [place(&alone.x), place(&alone.y)],
        "fixed": fixed,
        "name": Motion::name(verdict, plane.has_mirror()),
        "regime": verdict.regime.name(),
        "n": verdict.n,
        "exponent": finite(verdict.lyapunov.into()),
        "forgets": verdict.lyapunov == f32::NEG_INFINITY,
        "peak": finite(verdict.peak_impact_velocity.into()),
        "impacts": verdict.impacts,
        "periods": verdict.periods,
        "state": state,
        "start": start_words(alone.start_at(0, 0)),
        "command": super::command::classify(alone, scene.computing.asked),
    })
}

/// The Floquet multipliers of a periodic motion, or why there are none.
fn multipliers(system: &System, verdict: &Verdict) -> Value {
    if !verdict.regime.is_periodic() {
        return json!({ "none": "Only a periodic motion has Floquet multipliers." });
    }
    match SettledMotion::of(system, verdict) {
        Ok(motion) => {
            let pairs = motion.multipliers(system);
            let pairs = pairs.map(|all| all.iter().map(|m| [m.re, m.im]).collect::<Vec<_>>());
            match pairs {
                Some(pairs) => json!({
                    "label": motion.label(),
                    "stable": motion.is_stable(system),
                    "values": pairs,
                }),
                None => json!({ "none": "The motion grazes a stop: its return map has no derivative." }),
            }
        }
        Err(error) => json!({ "none": format!("Newton's method finds no exact motion here: {error}.") }),
    }
}

/// All Lyapunov exponents per forcing period, with their standard errors.
fn exponents(system: &System, verdict: &Verdict) -> Value {
    match Spectrum::of(system, &verdict.state[..], 0, EXPONENTS_OVER) {
        Ok(spectrum) => {
            let values: Vec<Value> = (spectrum.per_period.iter().zip(&spectrum.standard_error))
                .map(|(&value, &error)| json!([finite(value), finite(error)]))
                .collect();
            let name = words(&crate::figure::Text::new().italic("λ"));
            json!({ "values": values, "periods": spectrum.periods, "symbol": name })
        }
        Err(error) => json!({ "none": error.to_string() }),
    }
}

/// A number as JSON has it: null for −∞ and for what was not measured.
fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
