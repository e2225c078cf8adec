//! How far trajectories go, measured on the processor.

use super::each::each;
use crate::analysis::{Extent, ExtentObserver};
use crate::backend::error::BackendError;
use crate::backend::job::Job;
use crate::backend::watch::Watch;
use crate::model::{Flight, Real};

/// How far each job goes in so many forcing periods, in the given precision, one trajectory per task of rayon's current
/// thread pool.
pub(in crate::backend) fn extents<T: Real>(
    jobs: &[Job],
    periods: &[u32],
    watch: &dyn Watch,
) -> Result<Vec<Extent>, BackendError> {
    let followed: Vec<(&Job, u32)> = jobs.iter().zip(periods.iter().copied()).collect();
    each(&followed, watch, |&(job, periods)| extent::<T>(job, periods))
}

/// How far one trajectory goes in so many forcing periods, in the given precision; in f32 it does what the GPU does.
pub fn extent<T: Real>(job: &Job, periods: u32) -> Extent {
    match job.system.coordinates() {
        1 => with::<T, 1>(job, periods),
        2 => with::<T, 2>(job, periods),
        3 => with::<T, 3>(job, periods),
        _ => with::<T, 4>(job, periods),
    }
}

fn with<T: Real, const N: usize>(Job { system, start }: &Job, periods: u32) -> Extent {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    ExtentObserver::new(&flight, start.state()).follow(&flight, periods)
}
