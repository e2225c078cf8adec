//! How far the motion without impact goes.

use nalgebra::Complex;

use crate::dynamics::Stop;
use crate::model::{Equations, Flight, ForcedResponse, System};

/// The forced response of a system along the directions of its stops; non-dimensional.
pub(super) struct Response {
    /// At each stop, the amplitude along its direction, and the room from the mean place to the stop.
    ends: Vec<[f64; 2]>,
}

impl Response {
    /// None at an undamped resonance, or where a constant load meets no stiffness.
    pub fn of(system: &System) -> Option<Self> {
        match system.plant().n {
            1 => ends::<1>(system),
            2 => ends::<2>(system),
            3 => ends::<3>(system),
            _ => ends::<4>(system),
        }
        .map(|ends| Response { ends })
    }

    /// ln of amplitude over room, as smooth at a resonance as elsewhere: 0 where the stop is just touched, greater where it
    /// is crossed. None where the mean place lies beyond the stop, or the motion does not move along its direction.
    pub fn excess(&self, stop: Stop) -> Option<f64> {
        let [amplitude, room] = self.ends[stop.index()];
        let excess = (amplitude / room).ln();
        excess.is_finite().then_some(excess)
    }

    /// Whether a stop is crossed, by more than this share of the room.
    pub fn crosses(&self, stop: Stop, slack: f64) -> bool {
        let [amplitude, room] = self.ends[stop.index()];
        amplitude > room + slack * room.abs()
    }
}

fn ends<const N: usize>(system: &System) -> Option<Vec<[f64; 2]>> {
    let plant = system.plant();
    let response = ForcedResponse::of(&Equations::<N>::new(plant))?;
    let end = |stop: &crate::system::PlantStop| {
        let row = || stop.direction.iter();
        let swing: Complex<f64> = row().zip(response.amplitude.iter()).map(|(d, x)| x * *d).sum();
        let mean: f64 = row().zip(response.mean.iter()).map(|(d, x)| d * x).sum();
        [swing.norm(), stop.gap - mean]
    };
    Some(plant.stops.iter().map(end).collect())
}

/// Whether free motion decays onto the forced response.
pub(super) fn decays(system: &System) -> bool {
    match system.plant().n {
        1 => Flight::<f64, 1>::new(system).quiet.decays,
        2 => Flight::<f64, 2>::new(system).quiet.decays,
        3 => Flight::<f64, 3>::new(system).quiet.decays,
        _ => Flight::<f64, 4>::new(system).quiet.decays,
    }
}
