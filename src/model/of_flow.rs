//! What follows from the flow of a system alone: from everything but gaps and restitutions, and which of those are alike.

use std::any::Any;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::DMatrix;

use crate::system::Mirror;

/// What follows from a flow, found when it is first asked for.
#[derive(Debug, Default)]
pub(crate) struct OfFlow {
    /// Whether several systems have it: what is large is kept only then.
    is_shared: AtomicBool,
    mirror: OnceLock<Option<Mirror>>,
    constants: OnceLock<Box<dyn Any + Send + Sync>>,
    half_period: OnceLock<DMatrix<f64>>,
}

impl OfFlow {
    /// Several systems have it from now on: what is large is kept.
    pub(super) fn share(&self) {
        self.is_shared.store(true, Ordering::Relaxed);
    }

    /// The mirror of its systems.
    pub(super) fn mirror(&self, find: impl FnOnce() -> Option<Mirror>) -> Option<&Mirror> {
        self.mirror.get_or_init(find).as_ref()
    }

    /// The constants of flight, C being what they are for its number of coordinates, if they are kept: those of any one of
    /// its systems.
    pub(super) fn constants<C: Any + Send + Sync>(&self, compute: impl FnOnce() -> C) -> Option<&C> {
        let is_shared = self.is_shared.load(Ordering::Relaxed);
        is_shared.then(|| self.constants.get_or_init(|| Box::new(compute())).downcast_ref()).flatten()
    }

    /// exp(Gπ/ω), half a forcing period of the flow z' = G z of z = (x, v, sin φ, cos φ, 1).
    pub fn half_period(&self, compute: impl FnOnce() -> DMatrix<f64>) -> &DMatrix<f64> {
        self.half_period.get_or_init(compute)
    }
}
