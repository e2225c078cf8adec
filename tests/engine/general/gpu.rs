//! The GPU's kernel on shapes of one to three coordinates and one and two normals.

use std::collections::BTreeMap;
use std::sync::Mutex;

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Backend, Gpu, Job, Unwatched};
use impact_atlas::model::{StateVector, System};

use crate::common::adapter::{on_devices, open};
use crate::common::general::conditioning::{Case, cases, deviation};

/// Checkpoints, in forcing periods.
const CHECKPOINTS: [usize; 5] = [1, 2, 4, 8, 16];

/// Cases of one shape, whose shader is compiled once.
type Group = Vec<(&'static Case, System)>;

/// The cases, one shape after the other: stops count too.
fn groups() -> Vec<Group> {
    let mut groups = BTreeMap::<_, Group>::new();
    for case in cases() {
        let system = System::of_plant(case.setup.plant.clone()).unwrap();
        let (n, stops) = (case.setup.plant.n, case.setup.plant.stops.len());
        if (1..=3).contains(&n) && system.normals() <= 2 {
            groups.entry((n, system.normals(), stops)).or_default().push((case, system));
        }
    }
    groups.into_values().collect()
}

/// How many cases of one shape were compared after so many forcing periods, and what was off.
fn compared(gpu: &Gpu, group: &Group, periods: usize) -> (usize, Vec<String>) {
    let due = || group.iter().filter(|(case, _)| case.coarse.periods >= periods);
    let jobs: Vec<Job> = due().map(|(case, system)| job(case, system)).collect();
    if jobs.is_empty() {
        return (0, Vec::new());
    }
    let schedule = Schedule { transient: 0, observe: periods as u32, max_period: 8, fixed_periods: true };
    let verdicts = gpu.run(&jobs, &schedule, &Unwatched).expect("the adapter finishes");
    let mut wrong = Vec::new();
    for ((case, _), verdict) in due().zip(verdicts) {
        let off = deviation(&verdict.state, &case.truth[periods - 1].strobe);
        let impacts: u32 = case.truth[..periods].iter().flat_map(|p| p.impacts).sum();
        let miscounted =
            case.coarse.countable[..periods].iter().all(|&countable| countable) && verdict.impacts != impacts;
        if off > 1e-4 || miscounted {
            let found = verdict.impacts;
            wrong.push(format!(
                "{periods} periods: off by {off:e}, {found} impacts, not {impacts}: {:?}",
                case.setup
            ));
        }
    }
    (jobs.len(), wrong)
}

#[test]
fn random_plants_on_the_gpu() {
    let [first, second] = [open(), open()];
    let met = Mutex::new((BTreeMap::new(), Vec::new()));
    on_devices([&first, &second], &groups(), |device, group| {
        let (case, system) = &group[0];
        for periods in CHECKPOINTS {
            let (count, off) = compared(device, group, periods);
            let (counts, wrong) = &mut *met.lock().unwrap();
            *counts.entry((case.setup.plant.n, system.normals())).or_insert(0) += count;
            wrong.extend(off);
        }
    });
    let (counts, mut wrong) = met.into_inner().unwrap();
    wrong.sort();
    println!("compared, by coordinates and normals: {counts:?}");
    assert!(counts.len() == 5 && counts.values().all(|&count| count > 20), "{counts:?}");
    let shown = wrong[..wrong.len().min(5)].join("\n");
    assert!(wrong.is_empty(), "{} wrong:\n{shown}", wrong.len());
}

fn job(case: &Case, system: &System) -> Job {
    let start =
        StateVector::from_slice(&case.setup.start).expect("a start has two values for each coordinate");
    Job { system: system.clone(), start }
}
