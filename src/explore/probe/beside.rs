//! What else moves at one cell: motions that other starts lead to.

use serde_json::{Value, json};

use crate::analysis::Verdict;
use crate::backend::{Job, Watch, decide};
use crate::explore::limits;
use crate::explore::scene::Scene;
use crate::explore::task::{Ended, Task};
use crate::figure::css;
use crate::model::{StateVector, System};
use crate::plane::Start;
use crate::render::{Motion, paint_of};

/// Starts that are tried besides rest and the cell's own.
const SCATTERED: u32 = 22;

/// Sends the motions that scattered starts lead to, each with the number of its starts.
///
/// The starts are scattered evenly, the same for every cell of a plane: displacements within the gaps, or within the
/// amplitude of the cell's own motion where no stop bounds them; velocities within its peak ones.
///
/// # Errors
/// [`Ended`].
pub fn coexisting(
    scene: &Scene,
    system: &System,
    own: Start,
    verdict: &Verdict,
    task: &Task,
) -> Result<(), Ended> {
    let mut starts = vec![("its own start".to_owned(), own.state(system))];
    if own != Start::Rest {
        starts.push(("rest".to_owned(), Start::Rest.state(system)));
    }
    starts.extend((1..=SCATTERED.min(limits::STARTS)).map(|i| {
        let state = scattered(system, verdict, i);
        (crate::model::joined(&state, ","), state)
    }));
    let jobs: Vec<Job> =
        starts.iter().map(|(_, start)| Job { system: system.clone(), start: *start }).collect();
    let watch = task.at("looking for other motions", jobs.len() as u64);
    let decided = decide(scene.computing.backend, &jobs, &scene.plane.task, &watch);
    let decided = match decided {
        Ok(decided) => decided,
        Err(_) if watch.cancelled() => return Err(Ended::Cancelled),
        Err(error) => {
            task.answer("coexisting", json!({ "none": error.to_string() }));
            return Ok(());
        }
    };
    let mut found: Vec<(Motion, &Verdict, usize, &str)> = Vec::new();
    for (verdict, (start, _)) in decided.iter().zip(&starts) {
        let motion = Motion::of(verdict);
        match found.iter_mut().find(|(other, ..)| *other == motion) {
            Some((_, _, count, _)) => *count += 1,
            None => found.push((motion, verdict, 1, start)),
        }
    }
    let own = Motion::of(verdict);
    let mirror = scene.plane.has_mirror();
    let told: Vec<Value> = found
        .iter()
        .map(|(motion, verdict, count, start)| {
            let paint = paint_of(*motion);
            json!({
                "name": Motion::name(verdict, mirror),
                "paint": [css(paint.fill), paint.hatch.map(css)],
                "starts": count,
                "first": start,
                "own": *motion == own,
            })
        })
        .collect();
    task.answer("coexisting", json!({ "motions": told, "starts": starts.len() }));
    Ok(())
}

/// The `i`-th of a sequence of states that fills the box of displacements and velocities evenly.
fn scattered(system: &System, verdict: &Verdict, i: u32) -> StateVector {
    let n = system.plant().n;
    let least = 0.1 * system.unit();
    let reach = |from: &[f64]| from.iter().fold(least, |most, value| most.max(value.abs()));
    let gaps = system.plant().stops.iter().map(|stop| stop.gap.abs());
    let place = gaps.fold(reach(&verdict.state[..n]), f64::max);
    let speed = reach(&verdict.state[n..]).max(f64::from(verdict.peak_impact_velocity));
    // The root of g^(d+1) = g + 1 makes the sequence of d dimensions.
    let mut g = 1.5_f64;
    for _ in 0..60 {
        g = libm::pow(1.0 + g, 1.0 / (2 * n + 1) as f64);
    }
    let mut state = StateVector::zeros(n);
    for k in 0..2 * n {
        let share = (0.5 + f64::from(i) * g.powi(-(k as i32 + 1))).fract();
        state[k] = (2.0 * share - 1.0) * 1.5 * if k < n { place } else { speed };
    }
    system.between_stops(state)
}
