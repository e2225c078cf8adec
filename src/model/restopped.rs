//! The plant of a system, of which cells with the same flow have one in common: they differ in gaps and restitutions alone.

use std::sync::{Arc, OnceLock};

use super::common::Common;
use crate::system::{Plant, StopValues};

/// A plant as another one with other gaps and restitutions.
#[derive(Clone, Debug)]
pub(super) struct Restopped {
    /// What those with the same flow have in common.
    pub common: Arc<Common>,
    /// The gap and the restitution of every stop; after those of the last stop they say nothing.
    stops: [StopValues; Plant::MOST_STOPS],
    /// [`Common::alike`] of them.
    pub alike: u64,
    /// The plant itself, made when it is first asked for.
    own: OnceLock<Box<Plant>>,
}

impl Restopped {
    /// The plant that is there, with its own stops.
    pub fn new(common: Common) -> Self {
        let stops = &common.plant.stops;
        let stops = std::array::from_fn(|i| stops.get(i).map(StopValues::of).unwrap_or_default());
        let alike = common.alike(&stops);
        Restopped { common: Arc::new(common), stops, alike, own: OnceLock::new() }
    }

    /// The same plant with other gaps and restitutions.
    pub fn with_stops(&self, stops: [StopValues; Plant::MOST_STOPS]) -> Self {
        let alike = self.common.alike(&stops);
        Restopped { common: Arc::clone(&self.common), stops, alike, own: OnceLock::new() }
    }

    /// A plant with the same flow: the gaps and restitutions may be those of another cell.
    pub fn like(&self) -> &Plant {
        &self.common.plant
    }

    /// The gap and the restitution of every stop.
    pub fn stops(&self) -> &[StopValues] {
        &self.stops[..self.like().stops.len()]
    }

    /// The plant.
    pub fn plant(&self) -> &Plant {
        let same = |(stop, values): (_, &StopValues)| StopValues::of(stop).bits() == values.bits();
        if self.like().stops.iter().zip(&self.stops).all(same) {
            return self.like();
        }
        self.own.get_or_init(|| {
            let mut plant = self.like().clone();
            for (stop, values) in plant.stops.iter_mut().zip(&self.stops) {
                (stop.gap, stop.restitution) = (values.gap, values.restitution);
            }
            Box::new(plant)
        })
    }
}

impl PartialEq for Restopped {
    fn eq(&self, other: &Self) -> bool {
        self.common == other.common && self.plant() == other.plant()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, System};

    fn plant(delta: f64, r: f64) -> Plant {
        System::new(Parameters { delta, r, ..Parameters::default() }).unwrap().plant().clone()
    }

    fn alone(plant: Plant) -> Restopped {
        Restopped::new(Common::of(None, plant, [1, 0].into_iter().collect()).unwrap())
    }

    #[test]
    fn it_is_the_plant_with_those_stops() {
        let first = alone(plant(0.2, 0.8));
        assert_eq!(first.plant(), &plant(0.2, 0.8));
        for (delta, r) in [(0.3, 0.8), (0.2, 0.5), (0.2, 0.8), (0.0, 0.0), (-0.0, 0.5)] {
            let wanted = plant(delta, r);
            let stops = std::array::from_fn(|i| wanted.stops.get(i).map(StopValues::of).unwrap_or_default());
            let changed = first.with_stops(stops);
            assert_eq!(changed.plant(), &wanted, "δ = {delta}, r = {r}");
            assert_eq!(changed.stops(), alone(wanted).stops());
            assert!(std::ptr::eq(changed.like(), first.like()), "the rest is there once");
            let bits = |plant: &Plant| plant.stops.iter().map(|stop| stop.gap.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(changed.plant()), bits(&plant(delta, r)));
            assert_eq!(changed == first, (delta, r) == (0.2, 0.8), "δ = {delta}, r = {r}");
        }
    }
}
