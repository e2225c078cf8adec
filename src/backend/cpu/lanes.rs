//! Trajectories side by side in the registers of the processor, as many as it has room for.

use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::each::each;
use super::follow::follow;
use crate::analysis::{Observer, Queue, Schedule, Verdict, follow_abreast};
use crate::backend::error::BackendError;
use crate::backend::job::Job;
use crate::backend::watch::Watch;
use crate::model::{Flight, Flights, Pack, System, Twin};

/// How many trajectories one core follows at once; the bits of each are the same at every width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// One by one.
    One,
    /// Two registers of four (AVX2 and FMA).
    #[cfg(target_arch = "x86_64")]
    TwiceFour,
    /// Two registers of eight (AVX-512).
    #[cfg(target_arch = "x86_64")]
    TwiceEight,
}

impl Width {
    /// Every width that this processor has, the widest first.
    pub fn available() -> Vec<Width> {
        let mut widths = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            widths.extend(pulp::x86::V4::try_new().map(|_| Width::TwiceEight));
            widths.extend(pulp::x86::V3::try_new().map(|_| Width::TwiceFour));
        }
        widths.push(Width::One);
        widths
    }

    /// How many trajectories at once.
    pub fn lanes(self) -> usize {
        match self {
            Width::One => 1,
            #[cfg(target_arch = "x86_64")]
            Width::TwiceFour => 8,
            #[cfg(target_arch = "x86_64")]
            Width::TwiceEight => 16,
        }
    }

    /// The instructions that it needs.
    pub fn instructions(self) -> &'static str {
        match self {
            Width::One => "one lane",
            #[cfg(target_arch = "x86_64")]
            Width::TwiceFour => "2 × 4 lanes, AVX2",
            #[cfg(target_arch = "x86_64")]
            Width::TwiceEight => "2 × 8 lanes, AVX-512",
        }
    }
}

/// Follows every job in f64, `width` trajectories at once on each thread of rayon's current pool; one by one where there
/// are more than two coordinates, or not equally many in all jobs.
///
/// # Errors
/// [`BackendError::Cancelled`] when the watch asked for it.
pub fn follow_all(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<Vec<Verdict>, BackendError> {
    let n = jobs.first().map_or(0, |job| job.system.plant().n);
    let alike = jobs.iter().all(|job| job.system.plant().n == n);
    match n {
        1 if alike && width != Width::One => spread::<1>(jobs, schedule, watch, width),
        2 if alike && width != Width::One => spread::<2>(jobs, schedule, watch, width),
        _ => each(jobs, watch, |job| follow::<f64>(job, schedule)),
    }
}

/// Lets every thread take jobs from one queue.
fn spread<const N: usize>(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<Vec<Verdict>, BackendError> {
    let taken = AtomicUsize::new(0);
    let systems: Vec<&System> = jobs.iter().map(|job| &job.system).collect();
    let flights = Flights::<N>::of(&systems);
    let threads = rayon::current_num_threads().min(jobs.len().div_ceil(width.lanes()));
    let done: Vec<Vec<(usize, Verdict)>> = (0..threads)
        .into_par_iter()
        .with_max_len(1)
        .map(|_| {
            let normals = jobs[0].system.normals();
            let (taken, flights, done) = (&taken, &flights, Vec::new());
            let mut line = Line { jobs, flights, schedule, watch, taken, normals, done };
            line.follow(width);
            line.done
        })
        .collect();
    if watch.cancelled() {
        return Err(BackendError::Cancelled);
    }
    let mut verdicts: Vec<Option<Verdict>> = vec![None; jobs.len()];
    for (index, verdict) in done.into_iter().flatten() {
        verdicts[index] = Some(verdict);
    }
    verdicts.into_iter().collect::<Option<Vec<Verdict>>>().ok_or(BackendError::Cancelled)
}

/// What one thread takes from the jobs.
struct Line<'a, const N: usize> {
    jobs: &'a [Job],
    flights: &'a Flights<N>,
    schedule: &'a Schedule,
    watch: &'a dyn Watch,
    /// Jobs that some thread has taken.
    taken: &'a AtomicUsize,
    /// Contact normals of the cells that fit.
    normals: usize,
    done: Vec<(usize, Verdict)>,
}

impl<const N: usize> Line<'_, N> {
    fn follow(&mut self, width: Width) {
        match width {
            Width::One => {}
            #[cfg(target_arch = "x86_64")]
            Width::TwiceFour => {
                if let Some(simd) = pulp::x86::V3::try_new() {
                    Simd::vectorize(simd, Following(self));
                }
            }
            #[cfg(target_arch = "x86_64")]
            Width::TwiceEight => {
                if let Some(simd) = pulp::x86::V4::try_new() {
                    Simd::vectorize(simd, Following(self));
                }
            }
        }
        // What no lane took.
        while let Some(index) = self.take() {
            self.follow_alone(index);
        }
    }

    fn take(&self) -> Option<usize> {
        if self.watch.cancelled() {
            return None;
        }
        let index = self.taken.fetch_add(1, Ordering::Relaxed);
        (index < self.jobs.len()).then_some(index)
    }

    fn follow_alone(&mut self, index: usize) {
        self.done.push((index, follow::<f64>(&self.jobs[index], self.schedule)));
        self.watch.finished(1);
    }
}

impl<const N: usize> Queue<f64, N> for Line<'_, N> {
    type Ticket = usize;

    fn next(&mut self) -> Option<(usize, Flight<f64, N>, Observer<f64, N>)> {
        loop {
            let index = self.take()?;
            let Job { system, start } = &self.jobs[index];
            let flight = self.flights.get(index, system);
            if flight.count != self.normals {
                self.follow_alone(index);
                continue;
            }
            let observer = Observer::new(&flight, self.schedule, start.state());
            return Some((index, flight, observer));
        }
    }

    fn done(&mut self, index: usize, flight: &Flight<f64, N>, observer: &Observer<f64, N>) {
        self.done.push((index, observer.verdict(flight, self.jobs[index].system.label_order())));
        self.watch.finished(1);
    }
}

/// The lanes of an instruction set at work.
struct Following<'a, 'b, const N: usize>(&'b mut Line<'a, N>);

impl<const N: usize> WithSimd for Following<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let zero = Pack::zero(simd);
        let Line { normals, schedule, .. } = *self.0;
        follow_abreast(Twin(zero, zero), normals, schedule, self.0);
    }
}
