//! Systems in another unit of length.

use impact_atlas::system::Plant;

/// A plant with all lengths, and so all loads, so many times as large.
pub fn scaled(plant: &Plant, unit: f64) -> Plant {
    let mut plant = plant.clone();
    plant.force_sin *= unit;
    plant.force_cos *= unit;
    plant.load *= unit;
    plant.stops.iter_mut().for_each(|stop| stop.gap *= unit);
    plant
}
