//! The GPU and its f32 twin, bit for bit.

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, Gpu, Job, Unwatched, follow};
use impact_atlas::model::{Parameters, System};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn cells(count: usize) -> Vec<Job> {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0050);
    (0..count)
        .map(|_| {
            let parameters = Parameters {
                omega: rng.random_range(0.3..4.5),
                delta: rng.random_range(0.002..0.6),
                r: rng.random_range(0.3..1.0),
                zeta: rng.random_range(0.005..0.2),
                ..Parameters::default()
            };
            Job { system: System::new(parameters).unwrap(), start: [0.0; 4].into() }
        })
        .collect()
}

fn bits(verdict: &Verdict) -> (String, Vec<u64>, u32, u32) {
    let state = verdict.state.iter().map(|value| value.to_bits()).collect();
    let said = format!("{} {:?} {}", verdict.label(), verdict.regime, verdict.periods);
    (said, state, verdict.lyapunov.to_bits(), verdict.peak_impact_velocity.to_bits())
}

#[test]
fn probe() {
    let gpu = Gpu::open_exact(None).unwrap();
    println!("{}", gpu.adapter());
    let jobs = cells(2000);
    for periods in [1, 2, 5, 20, 100] {
        let schedule = Schedule { transient: periods, observe: 4, max_period: 2, fixed_periods: true };
        let there = gpu.run(&jobs, &schedule, &Unwatched).unwrap();
        let here: Vec<Verdict> = jobs.iter().map(|job| follow::<f32>(job, &schedule)).collect();
        let same = there.iter().zip(&here).filter(|(a, b)| a.state == b.state).count();
        let all = there.iter().zip(&here).filter(|(a, b)| bits(a) == bits(b)).count();
        let quiet = here.iter().filter(|v| v.impacts_total == 0).count();
        let same_hit =
            there.iter().zip(&here).filter(|(a, b)| b.impacts_total > 0 && a.state == b.state).count();
        println!(
            "{periods}: {same} states, {all} verdicts of {}, {quiet} without impact; {same_hit} with",
            jobs.len()
        );
    }
}
