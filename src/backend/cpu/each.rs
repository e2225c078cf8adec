//! One job after another on every core.

use rayon::prelude::*;

use crate::backend::error::BackendError;
use crate::backend::watch::Watch;

/// Does every job on one of the pool's threads, until the watch ends it.
pub fn each<J: Sync, R: Send>(
    jobs: &[J],
    watch: &dyn Watch,
    work: impl Fn(&J) -> R + Sync,
) -> Result<Vec<R>, BackendError> {
    let results: Option<Vec<R>> = jobs
        .par_iter()
        .map(|job| {
            if watch.cancelled() {
                return None;
            }
            let result = work(job);
            watch.finished(1);
            Some(result)
        })
        .collect();
    results.ok_or(BackendError::Cancelled)
}
