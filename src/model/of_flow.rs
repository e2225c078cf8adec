//! What follows from the flow of a system alone: from everything but gaps and restitutions, and which of those are alike.

use std::any::{Any, TypeId};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;
use parking_lot::RwLock;
use rustc_hash::FxHashMap;

use crate::system::{Mirror, Plant};

/// The bits of the coefficient of restitution of every stop; 0 from the last stop on.
pub(super) type Restitutions = [u64; Plant::MOST_STOPS];

/// What was found for some coefficients of restitution, by its type: of the last few alone. Cells that have theirs in common come
/// one after the other, and on a plane on which none have it would be much.
type Found = FxHashMap<(TypeId, Restitutions), Arc<dyn Any + Send + Sync>>;

/// So many are kept.
const FEW: usize = 16;

/// What follows from a flow, found when it is first asked for.
#[derive(Debug, Default)]
pub(crate) struct OfFlow {
    /// Whether several systems have it: what is large is kept only then.
    is_shared: AtomicBool,
    mirror: OnceLock<Option<Mirror>>,
    forced: OnceLock<f64>,
    constants: OnceLock<Box<dyn Any + Send + Sync>>,
    generator: OnceLock<DMatrix<f64>>,
    half_period: OnceLock<DMatrix<f64>>,
    of_restitutions: RwLock<Found>,
}

impl OfFlow {
    /// Several systems have it from now on: what is large is kept.
    pub(super) fn share(&self) {
        // What others read is written once.
        if !self.is_shared.load(Ordering::Relaxed) {
            self.is_shared.store(true, Ordering::Relaxed);
        }
    }

    /// The mirror of its systems.
    pub(super) fn mirror(&self, find: impl FnOnce() -> Option<Mirror>) -> Option<&Mirror> {
        self.mirror.get_or_init(find).as_ref()
    }

    /// How far forces carry masses; see [`System::unit`](super::System::unit).
    pub fn forced(&self, find: impl FnOnce() -> f64) -> f64 {
        *self.forced.get_or_init(find)
    }

    /// The constants of flight, C being what they are for its number of coordinates, if they are kept: those of any one of
    /// its systems.
    pub(super) fn constants<C: Any + Send + Sync>(&self, compute: impl FnOnce() -> C) -> Option<&C> {
        let is_shared = self.is_shared.load(Ordering::Relaxed);
        is_shared.then(|| self.constants.get_or_init(|| Box::new(compute())).downcast_ref()).flatten()
    }

    /// How many things are kept that follow from it and coefficients of restitution.
    #[cfg(test)]
    pub fn kept(&self) -> usize {
        self.of_restitutions.read().len()
    }

    /// G of the flow z' = G z of z = (x, v, sin φ, cos φ, 1).
    pub fn generator(&self, compute: impl FnOnce() -> DMatrix<f64>) -> &DMatrix<f64> {
        self.generator.get_or_init(compute)
    }

    /// The same, once it was asked for.
    pub fn known_generator(&self) -> Option<&DMatrix<f64>> {
        self.generator.get()
    }

    /// The mirror of its systems, once it was asked for.
    pub fn known_mirror(&self) -> Option<&Mirror> {
        self.mirror.get()?.as_ref()
    }

    /// exp(Gπ/ω), half a forcing period of that flow.
    pub fn half_period(&self, compute: impl FnOnce() -> DMatrix<f64>) -> &DMatrix<f64> {
        self.half_period.get_or_init(compute)
    }

    /// What follows from it and the coefficients of restitution, whatever the gaps: of each type C one thing for each of them.
    pub(super) fn of_restitutions<C: Any + Send + Sync>(
        &self,
        restitutions: Restitutions,
        compute: impl FnOnce() -> C,
    ) -> Arc<C> {
        let key = (TypeId::of::<C>(), restitutions);
        let known = self.of_restitutions.read().get(&key).cloned();
        if let Some(Ok(known)) = known.map(Arc::downcast) {
            return known;
        }
        let found = Arc::new(compute());
        let kept: Arc<dyn Any + Send + Sync> = found.clone();
        let mut known = self.of_restitutions.write();
        if known.len() >= FEW {
            known.clear();
        }
        known.insert(key, kept);
        found
    }
}
