//! What follows from the flow of a system alone: from everything but gaps and restitutions, and which of those are alike.

use std::any::Any;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use nalgebra::DMatrix;

use super::flight::Flight;
use super::shared::flow;
use super::system::System;
use crate::system::Mirror;

/// What follows from a flow, found when it is first asked for.
#[derive(Debug, Default)]
pub(crate) struct OfFlow {
    /// Whether several systems have it: what is large is kept only then.
    is_shared: AtomicBool,
    mirror: OnceLock<Option<Mirror>>,
    /// A `Flight<f64, N>`, N being the system's number of coordinates.
    flight: OnceLock<Box<dyn Any + Send + Sync>>,
    half_period: OnceLock<DMatrix<f64>>,
}

impl OfFlow {
    pub(super) fn mirror(&self, find: impl FnOnce() -> Option<Mirror>) -> Option<&Mirror> {
        self.mirror.get_or_init(find).as_ref()
    }

    /// The constants of some cell with this flow, if they are kept.
    pub(super) fn flight<const N: usize>(
        &self,
        compute: impl FnOnce() -> Flight<f64, N>,
    ) -> Option<&Flight<f64, N>> {
        self.is_shared
            .load(Ordering::Relaxed)
            .then(|| self.flight.get_or_init(|| Box::new(compute())).downcast_ref())
            .flatten()
    }

    /// exp(Gπ/ω), half a forcing period of the flow z' = G z of z = (x, v, sin φ, cos φ, 1).
    pub fn half_period(&self, compute: impl FnOnce() -> DMatrix<f64>) -> &DMatrix<f64> {
        self.half_period.get_or_init(compute)
    }
}

/// Finds systems with the same flow, so that what follows from it is found once for all of them.
#[derive(Debug, Default)]
pub struct Flows(Mutex<HashMap<Vec<u64>, Arc<OfFlow>>>);

impl Flows {
    /// The same system, sharing what follows from its flow with those before it.
    #[must_use]
    pub fn share(&self, mut system: System) -> System {
        let flow = flow(&system);
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(of_flow) = known.get(&flow) {
            of_flow.is_shared.store(true, Ordering::Relaxed);
            system.of_flow.0 = Arc::clone(of_flow);
        } else {
            known.insert(flow, Arc::clone(&system.of_flow.0));
        }
        system
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;

    fn system(omega: f64, delta: f64, r: f64) -> System {
        System::new(Parameters { omega, delta, r, ..Parameters::default() }).unwrap()
    }

    #[test]
    fn systems_that_share_their_flow_have_the_constants_that_each_has_alone() {
        let flows = Flows::default();
        for omega in [1.3, 2.7] {
            for (delta, r) in [(0.1, 0.8), (0.37, 0.8), (0.02, 0.5), (0.0, 0.9)] {
                let alone = system(omega, delta, r);
                let shares = flows.share(alone.clone());
                assert_eq!(Flight::<f64, 2>::new(&shares), Flight::new(&alone), "ω = {omega}, δ = {delta}");
                assert_eq!(shares.mirror(), alone.mirror());
            }
        }
        assert_eq!(flows.0.lock().unwrap().len(), 2);
    }

    #[test]
    fn another_forcing_is_another_flow() {
        let flows = Flows::default();
        let first = flows.share(system(1.3, 0.1, 0.8));
        let second = flows.share(system(1.3, 0.2, 0.8));
        assert!(Arc::ptr_eq(&first.of_flow.0, &second.of_flow.0));
        assert!(second.of_flow.0.is_shared.load(Ordering::Relaxed));
        let _ = (first.mirror(), Flight::<f64, 2>::new(&first));
        for changed in
            [first.clone().unforced(), first.clone().loaded(&[1.0, 2.0]), first.following(40.0).unwrap()]
        {
            let alone = System::of_plant(changed.plant().clone()).unwrap();
            assert_eq!(changed.mirror(), alone.mirror());
            assert_eq!(Flight::<f64, 2>::new(&changed).sin, Flight::<f64, 2>::new(&alone).sin);
            assert_eq!(Flight::<f64, 2>::new(&changed).steps, changed.steps());
            assert_ne!(Flight::<f64, 2>::new(&changed), Flight::new(&first));
        }
    }
}
