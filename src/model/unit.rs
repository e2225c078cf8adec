//! What is of order one: tolerances are in units of it.

use nalgebra::DMatrix;

use super::forced::ForcedResponse;
use super::free_flight::{FreeFlight, LEAST};
use super::system::System;
use super::transition::generator;
use crate::system::sized;

impl System {
    /// The displacement, and the velocity, that are of order one on its motions: 1, or where gaps, and what forces do, are all less than
    /// a quarter of that, half the largest of them.
    ///
    /// What is called small or the same on a motion is so in units of this, so that labels do not depend on the unit of length.
    pub fn unit(&self) -> f64 {
        self.unit_of(self.forced())
    }

    /// How far forces carry masses; see [`forced`].
    pub(super) fn forced(&self) -> f64 {
        self.of_flow().forced(|| forced_by(&generator(self.like())))
    }

    /// The same, of a flow whose forces are known to carry masses so far; see [`forced`].
    pub(crate) fn unit_of(&self, forced: f64) -> f64 {
        let gaps = self.stop_values().iter().zip(&self.common().lengths);
        unit(forced, gaps.map(|(stop, length)| stop.gap / length))
    }
}

/// [`System::unit`], by how far forces carry masses, and by the gaps, each per length of its direction.
pub(crate) fn unit(forced: f64, gaps: impl Iterator<Item = f64>) -> f64 {
    let largest = gaps.map(f64::abs).fold(forced, f64::max);
    // Without forces and gaps nothing says what is large; a start may.
    if largest > 0.0 && largest < LEAST { (0.5 * largest).max(f32::MIN_POSITIVE.into()) } else { 1.0 }
}

/// [`forced`], by the generator of a flow.
pub(crate) fn forced_by(generator: &DMatrix<f64>) -> f64 {
    fn of<const N: usize>(generator: &DMatrix<f64>) -> f64 {
        let free = FreeFlight::<N>::of_generator(generator);
        forced(&free, ForcedResponse::of(&free).as_ref())
    }
    sized!((generator.nrows() - 3) / 2, N of 1 2 3 4: of::<N>(generator), else of::<5>(generator))
}

/// How far, and how fast, forces carry masses that rest at 0: the forced response where there is one, though no farther than the
/// forces alone would in half a forcing period, since impacts keep a resonance from growing. Where it is small, the next power of
/// two, which is the same in either precision.
pub(super) fn forced<const N: usize>(free: &FreeFlight<N>, response: Option<&ForcedResponse<N>>) -> f64 {
    let (omega, period) = (free.omega, std::f64::consts::TAU / free.omega);
    let acceleration =
        (0..N).map(|i| libm::hypot(free.sin[i], free.cos[i]) + free.load[i].abs()).fold(0.0, f64::max);
    let alone = acceleration * (0.5 * period).max(0.125 * period * period);
    let respond = |response: &ForcedResponse<N>| {
        let of = |i: usize| libm::hypot(response.amplitude[i].re, response.amplitude[i].im);
        (0..N).map(|i| (response.mean[i].abs() + of(i)).max(omega * of(i))).fold(0.0, f64::max)
    };
    let carried = response.map_or(alone, respond).min(alone);
    // 0, infinite or no number says nothing.
    match carried > 0.0 && carried < LEAST {
        true => libm::ldexp(1.0, libm::ilogb(carried) + 1).max(f32::MIN_POSITIVE.into()),
        false => carried,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Flight, Flows, Parameters, Setting};
    use crate::system::Family;

    /// The paper's oscillator with its lengths in units of one that is so long.
    fn of(omega: f64, gap: f64, unit: f64) -> System {
        let system = System::new(Parameters { omega, delta: gap, ..Parameters::default() }).unwrap();
        let mut plant = system.plant().clone();
        plant.force_sin *= unit;
        plant.stops.iter_mut().for_each(|stop| stop.gap *= unit);
        System::of_plant(plant).unwrap()
    }

    #[test]
    fn systems_of_order_one_have_the_unit_one() {
        for omega in [0.1, 0.2, 1.0, 2.83, 5.0] {
            for gap in [0.0, 0.02, 0.8, 3.0] {
                assert_eq!(of(omega, gap, 1.0).unit(), 1.0, "ω = {omega}, δ = {gap}");
                assert_eq!(of(omega, gap, 1e6).unit(), 1.0, "ω = {omega}, δ = {gap}");
            }
        }
    }

    #[test]
    fn the_unit_of_small_systems_is_as_small() {
        let unit = |omega, gap, exponent| of(omega, gap, 2f64.powi(exponent)).unit();
        for (omega, gap) in [(0.2, 0.0), (2.83, 0.1), (7.0, 0.8), (1.3, 40.0)] {
            let small = unit(omega, gap, -10);
            assert!(small < LEAST && small > 2f64.powi(-10) / 64.0, "{small} at ω = {omega}, δ = {gap}");
            for exponent in [-11, -20, -90] {
                assert_eq!(unit(omega, gap, exponent), small * 2f64.powi(exponent + 10));
            }
        }
        // The larger of gaps and what forces do.
        assert_eq!(unit(1.3, 40.0, -10), 20.0 * 2f64.powi(-10));
        assert!(unit(1.3, 0.0, -10) < 20.0 * 2f64.powi(-10));
    }

    #[test]
    fn without_gaps_and_forces_it_is_one() {
        let mut plant = of(1.0, 0.0, 1.0).plant().clone();
        plant.force_sin.fill(0.0);
        assert_eq!(System::of_plant(plant).unwrap().unit(), 1.0);
    }

    #[test]
    fn cells_with_the_same_flow_have_each_its_own() {
        let flows = Flows::default();
        let flights = |gap: f64| {
            let system = flows.share(of(2.83, gap, 1e-6));
            let flight = Flight::<f64, 2>::boxed(&system);
            assert_eq!(flight.unit, system.unit());
            let mut exchanged = Flight::<f64, 2>::new(&of(2.83, 3.0, 1e-6)).round::<f32>();
            exchanged.take_stops_of(&system);
            assert_eq!(exchanged.unit, flight.unit as f32, "the same in either precision");
            flight.unit
        };
        assert_eq!([flights(20.0), flights(30.0)], [10.0 * 1e-6, 15.0 * 1e-6]);
        assert_eq!(flights(0.1), flights(0.2), "forces do more");
    }

    #[test]
    fn masses_are_carried_as_far_as_forces_and_gaps_are_large() {
        let reach = |omega, gap, unit| Flight::<f64, 2>::new(&of(omega, gap, unit)).reach();
        assert_eq!(reach(2.83, 40.0, 1.0), 40.0);
        assert_eq!(reach(2.83, 40.0, 1024.0), 40960.0);
        let forced = reach(1.0, 0.1, 1.0);
        assert!(forced > 1.0 && forced < 10.0, "{forced}");
        assert!((reach(1.0, 0.1, 1024.0) / forced - 1024.0).abs() < 1e-9);
        // Never below the unit, nor as far as a stop is that is not there.
        assert_eq!(reach(7.0, 0.3, 1.0), 1.0);
        let ball = System::new(Setting::defaults(Family::builtin("bouncing-ball"))).unwrap();
        assert!(Flight::<f64, 1>::new(&ball).reach() < 100.0);
    }
}
