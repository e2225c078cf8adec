//! Gaps and restitutions, in which alone the plants of cells may differ.

use super::block::Block;
use super::family::Family;
use super::parameter::ParameterId;
use super::plant::Plant;
use super::stops::StopValues;

/// A gap that is in order for directions of any length that is used.
const SURELY_NEAR: f64 = 1e9;

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
    pub fn flow_bits<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = u64> + 'a {
        self.of_flow.iter().map(|id| values[id.index()].to_bits())
    }

    /// The gaps and restitutions of values, the same to the bit as [`Family::plant`] has them; none where they are not certain
    /// to make a plant, with what others with the same [`Family::flow_bits`] have that do make one, without a look at all of it.
    pub fn stop_values(&self, values: &[f64]) -> Option<[StopValues; Plant::MOST_STOPS]> {
        let admitted = |&id: &ParameterId| self.about(id).range.admits(values[id.index()]);
        self.of_stops.iter().all(admitted).then_some(())?;
        let mut stops = [StopValues::default(); Plant::MOST_STOPS];
        for (own, stop) in self.stops.iter().zip(&mut stops) {
            (stop.gap, stop.restitution) = (own.gap.number(values)?, own.restitution.number(values)?);
            // Stops at gaps that are not negative always leave room between them.
            let is_fit = (0.0..=SURELY_NEAR).contains(&stop.gap) && (0.0..=1.0).contains(&stop.restitution);
            is_fit.then_some(())?;
        }
        Some(stops)
    }
}
