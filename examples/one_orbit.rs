//! One orbit from library code: what it settles on, and the impacts of one period of the motion.
//!
//! ```text
//! cargo run --release --example one_orbit -- [OMEGA] [DELTA]
//! ```

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Job, follow};
use impact_atlas::dynamics::record;
use impact_atlas::model::{Parameters, System};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let omega = arguments.next().map_or(Ok(1.65), |text| text.parse())?;
    let delta = arguments.next().map_or(Ok(0.1), |text| text.parse())?;

    let system = System::new(Parameters { omega, delta, ..Parameters::default() })?;
    let start = [0.0; 4];

    // Follow the trajectory until it has settled, and classify it.
    let schedule = Schedule { transient: 1000, observe: 500, max_period: 32, fixed_periods: false };
    let verdict = follow::<f64>(&Job { system: system.clone(), start: start.into() }, &schedule);
    println!("omega = {omega}, delta = {delta}: {}", verdict.label());
    println!("largest Lyapunov exponent per forcing period: {:.4}", verdict.lyapunov);

    // Write down what it does from its end state on, for one period of the motion (or one forcing period).
    let periods = u32::from(verdict.n).max(1);
    let recording = record(&system, verdict.state, 0, periods, 0);
    println!("{:>10}  stop  {:>10}  {:>10}", "time", "v1 before", "v1 after");
    for impact in &recording.impacts {
        println!(
            "{:10.6}     {}  {:10.6}  {:10.6}",
            impact.time, impact.stop, impact.velocity_before, impact.velocity_after
        );
    }
    for stick in &recording.sticks {
        println!("rests on stop {} from {:.6} until {:.6}", stick.stop, stick.from, stick.until);
    }
    Ok(())
}
