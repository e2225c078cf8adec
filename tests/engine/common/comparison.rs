//! The comparison of a back end's trajectories with the oracle's.

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::Job;
use impact_atlas::model::{Parameters, System};

use super::conditioning::{Case, Horizon, deviation};

/// Forcing periods after which trajectories are compared, besides the end of the horizon.
const CHECKPOINTS: [usize; 9] = [1, 2, 3, 5, 8, 13, 20, 30, 40];

/// Follows every job as the schedule says.
pub type Run = fn(&[Job], &Schedule) -> Vec<Verdict>;

/// What a back end is held to.
#[derive(Clone, Copy, Debug)]
pub struct Standard {
    /// The largest deviation of a strobe state.
    pub tolerance: f64,
    /// How long a case is comparable in this precision.
    pub horizon: fn(&Case) -> Horizon,
    /// Whether labels are demanded of those settled motions too that do not survive noise of an f32's size.
    pub every_motion: bool,
    /// The largest deviation from a settled motion.
    pub settled: f64,
}

/// f64.
pub const FINE: Standard =
    Standard { tolerance: 1e-9, horizon: |case| case.fine, every_motion: true, settled: 1e-4 };

/// f32.
pub const COARSE: Standard =
    Standard { tolerance: 1e-4, horizon: |case| case.coarse, every_motion: false, settled: 1e-3 };

/// One comparison: a case after some forcing periods.
#[derive(Clone, Debug)]
pub struct Compared<'a> {
    /// The case.
    pub case: &'a Case,
    /// Forcing periods from its start.
    pub periods: usize,
    /// What the back end made of it.
    pub verdict: Verdict,
    /// The deviation of its strobe state; not a number where the state is none.
    pub deviation: f64,
    /// The deviation that is allowed: the standard's, where the case is well conditioned.
    pub tolerance: f64,
    /// Whether impacts can be counted up to here.
    pub countable: bool,
}

impl Compared<'_> {
    /// Whether the strobe state agrees; never where it is not a number.
    pub fn agrees(&self) -> bool {
        self.deviation <= self.tolerance
    }

    /// The largest |v1−| by the oracle.
    pub fn peak(&self) -> f64 {
        let impacts = self.case.truth[..self.periods].iter().flat_map(|period| &period.impacts);
        impacts.map(|impact| impact.velocity_before.abs()).fold(0.0, f64::max)
    }

    /// Impacts by the oracle.
    pub fn impacts(&self) -> u32 {
        let [minus, plus] = self.case.counts(self.periods);
        minus + plus
    }

    /// A line that says how to see it again.
    pub fn describe(&self) -> String {
        format!(
            "{:?} after {} periods: off by {:e}, impacts {} (oracle {})\n  {:?}\n  start {:?}\n  state {:?}\n  exact {:?}",
            self.case.family,
            self.periods,
            self.deviation,
            self.verdict.impacts,
            self.impacts(),
            self.case.parameters,
            self.case.start,
            self.verdict.state,
            self.case.strobe(self.periods),
        )
    }
}

/// Runs every case up to every checkpoint within its horizon. `handed` is what is made of the parameters before
/// they are handed to the back end: nothing, unless a defect is to be simulated.
pub fn compare<'a>(
    cases: &'a [Case],
    run: Run,
    standard: &Standard,
    handed: &dyn Fn(Parameters) -> Parameters,
) -> Vec<Compared<'a>> {
    let longest = cases.iter().map(|case| (standard.horizon)(case).periods).max().unwrap_or(0);
    let mut compared = Vec::new();
    for periods in 1..=longest {
        let due = |case: &&Case| {
            let horizon = (standard.horizon)(case).periods;
            periods == horizon || (periods < horizon && CHECKPOINTS.contains(&periods))
        };
        let due: Vec<&Case> = cases.iter().filter(due).collect();
        let jobs: Vec<Job> = due.iter().map(|case| job(handed(case.parameters), case.start)).collect();
        let schedule =
            Schedule { transient: 0, observe: periods as u32, max_period: 32, fixed_periods: true };
        let verdicts = if jobs.is_empty() { Vec::new() } else { run(&jobs, &schedule) };
        assert_eq!(verdicts.len(), due.len());
        compared.extend(due.into_iter().zip(verdicts).map(|(case, verdict)| {
            let deviation = deviation(&verdict.state, &case.strobe(periods));
            let horizon = (standard.horizon)(case);
            let tolerance = standard.tolerance * horizon.slack;
            Compared { case, periods, verdict, deviation, tolerance, countable: periods <= horizon.countable }
        }));
    }
    compared
}

/// A job for a back end.
pub fn job(parameters: Parameters, start: [f64; 4]) -> Job {
    Job { system: System::new(parameters).expect("the cases are physical"), start: start.into() }
}

/// The value below which a share of the values lies.
pub fn quantile(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted[((sorted.len() - 1) as f64 * share) as usize]
}
