//! Verdicts that are not in doubt: [`looks`](super::looks) are taken until none is left.

use rayon::prelude::*;

use super::looks::{Doubt, Look, confirmed_by, looks};
use super::{Backend, Job, Result, Watch};
use crate::analysis::{Schedule, Verdict};

/// The verdicts of a back end on some jobs, those in doubt taken anew from where they ended.
///
/// # Errors
/// What the back end could not do.
///
/// # Panics
/// If the back end does not give a verdict for each job.
pub fn decide(
    backend: &dyn Backend,
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
) -> Result<Vec<Verdict>> {
    let doubts = Doubts::of(schedule);
    let mut verdicts = confirmed_by(backend, jobs, schedule, watch)?;
    doubts.put_off(jobs, &verdicts, |job| job as u64);
    for (job, verdict) in doubts.settle(backend, 1, watch)? {
        verdicts[job as usize] = verdict;
    }
    Ok(verdicts)
}

/// Trajectories in doubt, of one call or of many: the few of each wait until there are enough of them to be looked at together.
#[derive(Debug)]
pub struct Doubts {
    /// In their order; none where nothing is ever in doubt.
    looks: Vec<Look>,
}

impl Doubts {
    /// What a schedule has doubts about.
    pub fn of(schedule: &Schedule) -> Self {
        let looks = if schedule.fixed_periods { Vec::new() } else { looks(schedule).into() };
        Doubts { looks }
    }

    /// Lets those of some jobs wait whose first verdicts are in doubt, each under the `number` of its place among them.
    pub fn put_off(&self, jobs: &[Job], verdicts: &[Verdict], number: impl Fn(usize) -> u64) {
        let in_doubt = |verdict: &Verdict| self.looks.iter().any(|look| look.is_called_for_by(verdict));
        let waiting = verdicts.par_iter().enumerate().filter(|(_, verdict)| in_doubt(verdict));
        for job in waiting.map(|(job, _)| job).collect::<Vec<_>>() {
            self.leave(0, &jobs[job], number(job), &verdicts[job]);
        }
    }

    /// Takes every look that at least so many wait for; what that decides, with its number.
    ///
    /// # Errors
    /// What the back end could not do.
    pub fn settle(
        &self,
        backend: &dyn Backend,
        least: usize,
        watch: &dyn Watch,
    ) -> Result<Vec<(u64, Verdict)>> {
        let mut settled = Vec::new();
        for (look, next) in self.looks.iter().zip(1..) {
            let Some((jobs, doubts)) = look.called(least) else { continue };
            for (job, Doubt { number, verdict }) in jobs.iter().zip(look.take(backend, &jobs, doubts, watch)?)
            {
                if !self.leave(next, job, number, &verdict) {
                    settled.push((number, verdict));
                }
            }
        }
        Ok(settled)
    }

    /// Lets a trajectory wait for the first look from one on that its verdict calls for; whether there is one.
    fn leave(&self, from: usize, job: &Job, number: u64, verdict: &Verdict) -> bool {
        let look = self.looks[from..].iter().find(|look| look.is_called_for_by(verdict));
        if let Some(look) = look {
            let goes_on = Job { system: job.system.clone(), start: verdict.state };
            look.put_off(goes_on, Doubt { number, verdict: *verdict });
        }
        look.is_some()
    }
}

#[cfg(test)]
mod tests {
    use parking_lot::Mutex;

    use super::*;
    use crate::analysis::Regime;
    use crate::backend::Unwatched;
    use crate::model::{Parameters, System};

    /// Tells what kind of motion a trajectory comes to by where it begins, and counts in x2 how often it was followed and in v1
    /// for how many periods.
    #[derive(Debug)]
    struct Told {
        tile: usize,
        /// How many jobs each run had.
        runs: Mutex<Vec<usize>>,
    }

    impl Told {
        fn new(tile: usize) -> Self {
            Told { tile, runs: Mutex::default() }
        }
    }

    /// By kind, what the first and each later look comes to.
    const KINDS: [[Regime; 4]; 6] = {
        use Regime::{Chaotic, NoImpact, QuasiPeriodic, Unresolved};
        [
            [NoImpact; 4],
            [Chaotic; 4],
            [Chaotic, NoImpact, NoImpact, NoImpact],
            [QuasiPeriodic, QuasiPeriodic, NoImpact, NoImpact],
            [Unresolved, Unresolved, Chaotic, NoImpact],
            [Unresolved; 4],
        ]
    };

    /// How often each kind is followed.
    const TIMES: [f64; 6] = [1.0, 2.0, 2.0, 2.0, 3.0, 3.0];

    impl Backend for Told {
        fn name(&self) -> &'static str {
            "told"
        }

        fn adapter(&self) -> String {
            "told".to_owned()
        }

        fn tile(&self) -> usize {
            self.tile
        }

        fn run(&self, jobs: &[Job], schedule: &Schedule, _: &dyn Watch) -> Result<Vec<Verdict>> {
            assert!(jobs.len() <= self.tile, "a tile of {} jobs", jobs.len());
            self.runs.lock().push(jobs.len());
            let told = |job: &Job| {
                let mut state = job.start;
                let regime = KINDS[state[0] as usize][state[1] as usize];
                (state[1], state[2]) = (state[1] + 1.0, state[2] + f64::from(schedule.observe));
                Verdict { state, ..Verdict::of_motion(regime, [0; 3], false) }
            };
            Ok(jobs.iter().map(told).collect())
        }
    }

    fn jobs() -> Vec<Job> {
        let system = System::new(Parameters::default()).unwrap();
        let job =
            |i: usize| Job { system: system.clone(), start: [(i % 6) as f64, 0.0, 0.0, i as f64].into() };
        (0..60).map(job).collect()
    }

    const SCHEDULE: Schedule = Schedule { transient: 100, observe: 50, max_period: 8, fixed_periods: false };

    #[test]
    fn every_trajectory_is_looked_at_as_long_as_it_is_in_doubt() {
        let told = Told::new(60);
        let verdicts = decide(&told, &jobs(), &SCHEDULE, &Unwatched).unwrap();
        for (i, verdict) in verdicts.iter().enumerate() {
            let state = &verdict.state;
            assert_eq!((state[0], state[3]), ((i % 6) as f64, i as f64), "each in its place");
            assert_eq!(state[1], TIMES[i % 6], "kind {}", i % 6);
        }
        assert_eq!(verdicts[1].regime, Regime::Chaotic);
        assert_eq!(verdicts[3].regime, Regime::QuasiPeriodic);
        assert_eq!(verdicts[5].regime, Regime::Unresolved);
        assert_eq!(*told.runs.lock(), [60, 20, 30, 20], "one run for all, and one for each look");
        let fixed = Schedule { fixed_periods: true, ..SCHEDULE };
        assert!(
            decide(&told, &jobs(), &fixed, &Unwatched).unwrap().iter().all(|verdict| verdict.state[1] == 1.0)
        );
    }

    #[test]
    fn those_in_doubt_wait_for_each_other_and_come_to_the_same() {
        let (told, jobs, doubts) = (Told::new(15), jobs(), Doubts::of(&SCHEDULE));
        let expected = decide(&Told::new(60), &jobs, &SCHEDULE, &Unwatched).unwrap();
        let (mut begun, mut settled) = (Vec::new(), vec![None; jobs.len()]);
        let mut put = |number: u64, verdict: Verdict| {
            assert_eq!(settled[number as usize].replace(verdict), None, "{number} comes once");
        };
        for (part, numbers) in jobs.chunks(12).zip((0..).step_by(12)) {
            let first = confirmed_by(&told, part, &SCHEDULE, &Unwatched).unwrap();
            doubts.put_off(part, &first, |job| numbers + job as u64);
            begun.extend(first);
            doubts.settle(&told, 9, &Unwatched).unwrap().into_iter().for_each(|(n, v)| put(n, v));
        }
        doubts.settle(&told, 1, &Unwatched).unwrap().into_iter().for_each(|(n, v)| put(n, v));
        assert!(
            settled
                .iter()
                .zip(TIMES.iter().cycle())
                .all(|(settled, times)| settled.is_some() == (*times > 1.0))
        );
        let found: Vec<Verdict> =
            settled.into_iter().zip(begun).map(|(settled, first)| settled.unwrap_or(first)).collect();
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
        let runs = told.runs.lock();
        assert_eq!(runs.iter().sum::<usize>(), 60 + 20 + 30 + 20);
        assert_eq!(
            runs[..],
            [12, 12, 12, 12, 12, 12, 12, 15, 1, 12, 8, 6, 4],
            "enough of them, until no more come"
        );
    }
}
