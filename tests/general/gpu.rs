//! The GPU's kernel on shapes of one to three coordinates and one and two normals.

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Backend, Gpu, Job, Unwatched};
use impact_atlas::model::{StateVector, System};

use crate::general::conditioning::{Case, cases, deviation};

/// Checkpoints, in forcing periods.
const CHECKPOINTS: [usize; 5] = [1, 2, 4, 8, 16];

#[test]
fn random_plants_on_the_gpu() {
    let gpu = Gpu::open(None).expect("an adapter is there");
    let cases: Vec<&Case> = cases().iter().collect();
    let mut wrong = Vec::new();
    let mut compared = std::collections::BTreeMap::new();
    for periods in CHECKPOINTS {
        for (n, normals) in [(1, 1), (2, 1), (2, 2), (3, 1), (3, 2)] {
            let due: Vec<(&Case, System)> = cases
                .iter()
                .filter(|case| case.setup.plant.n == n && case.coarse.periods >= periods)
                .map(|case| (*case, System::of_plant(case.setup.plant.clone()).unwrap()))
                .filter(|(_, system)| system.normals() == normals)
                .collect();
            // One shape at a time: stops count too.
            for stops in 1..=4 {
                let due: Vec<&(&Case, System)> =
                    due.iter().filter(|(case, _)| case.setup.plant.stops.len() == stops).collect();
                let jobs: Vec<Job> = due.iter().map(|(case, system)| job(case, system)).collect();
                if jobs.is_empty() {
                    continue;
                }
                let schedule =
                    Schedule { transient: 0, observe: periods as u32, max_period: 8, fixed_periods: true };
                let verdicts = gpu.run(&jobs, &schedule, &Unwatched).expect("the adapter finishes");
                for ((case, _), verdict) in due.into_iter().zip(verdicts) {
                    let off = deviation(&verdict.state, &case.truth[periods - 1].strobe);
                    *compared.entry((n, normals)).or_insert(0) += 1;
                    let impacts: u32 = case.truth[..periods].iter().flat_map(|p| p.impacts).sum();
                    let miscounted = case.coarse.countable[..periods].iter().all(|&countable| countable)
                        && verdict.impacts != impacts;
                    if off > 1e-4 || miscounted {
                        let found = verdict.impacts;
                        wrong.push(format!(
                            "{periods} periods: off by {off:e}, {found} impacts, not {impacts}: {:?}",
                            case.setup
                        ));
                    }
                }
            }
        }
    }
    println!("compared, by coordinates and normals: {compared:?}");
    assert!(compared.len() == 5 && compared.values().all(|&count| count > 20), "{compared:?}");
    let shown = wrong[..wrong.len().min(5)].join("\n");
    assert!(wrong.is_empty(), "{} wrong:\n{shown}", wrong.len());
}

fn job(case: &Case, system: &System) -> Job {
    let start =
        StateVector::from_slice(&case.setup.start).expect("a start has two values for each coordinate");
    Job { system: system.clone(), start }
}
