//! The plant of a cell from that of another, where only their stops may differ: in gaps and restitutions.

use super::block::Block;
use super::family::Family;
use super::parameter::ParameterId;
use super::plant::Plant;

impl Family {
    /// The parameters on which more depends than gaps and restitutions, in the order of the file.
    pub(super) fn parameters_of_flow(&self) -> Vec<ParameterId> {
        let stops = || self.stops.iter().flat_map(|stop| [&stop.gap, &stop.restitution]);
        let of_flow = |block: &&Block| !stops().any(|own| std::ptr::eq(own, *block));
        let used: Vec<ParameterId> = self.blocks().filter(of_flow).flat_map(Block::uses).collect();
        self.ids().filter(|id| used.contains(id)).collect()
    }

    /// The bits of the values on which more depends than gaps and restitutions: plants in which they are the same differ in
    /// those alone.
    ///
    /// # Panics
    /// Where the values are not this family's.
    pub fn flow_bits(&self, values: &[f64]) -> Vec<u64> {
        self.of_flow.iter().map(|id| values[id.index()].to_bits()).collect()
    }

    /// The plant of values from that of others with the same [`Family::flow_bits`], the same to the bit as
    /// [`Family::plant`] makes it; none where that is not certain to be a plant without a look at all of it.
    pub fn restopped(&self, plant: &Plant, values: &[f64]) -> Option<Plant> {
        self.check(values).ok()?;
        let mut plant = plant.clone();
        for (own, stop) in self.stops.iter().zip(&mut plant.stops) {
            (stop.gap, stop.restitution) = (own.gap.number(values)?, own.restitution.number(values)?);
            // Stops at gaps that are not negative always leave room between them.
            let is_fit = stop.gap.is_finite() && stop.gap >= 0.0 && (0.0..=1.0).contains(&stop.restitution);
            is_fit.then_some(())?;
        }
        Some(plant)
    }
}
