//! Cells that share their flow: what differs among them are gaps and restitutions alone.

use std::collections::HashMap;
use std::mem::take;
use std::sync::Arc;

use arrayvec::ArrayVec;
use parking_lot::{Mutex, RwLock};
use rustc_hash::FxHashMap;

use super::of_flow::OfFlow;
use super::system::System;
use super::system_error::SystemError;
use crate::system::{MOST_PARAMETERS, Setting};

/// The most systems that are kept to make others of, and after [`Flows::tidy`] the most flows: enough for the columns of large
/// planes.
const MOST_SYSTEMS: usize = 1 << 14;

/// A family, and the values on which more depends than gaps and restitutions.
#[derive(Debug, PartialEq, Eq, Hash)]
struct FlowKey {
    family: usize,
    bits: ArrayVec<u64, MOST_PARAMETERS>,
}

/// Finds systems with the same flow, so that what follows from it is found once for all of them.
#[derive(Debug, Default)]
pub struct Flows {
    flows: Mutex<HashMap<Vec<u64>, Arc<OfFlow>>>,
    /// One system of each family and of each set of values on which more depends than gaps and restitutions.
    systems: RwLock<FxHashMap<FlowKey, System>>,
}

impl Flows {
    /// The system of a setting, sharing what follows from its flow with those before it: what it has in common with one of
    /// them is not computed anew.
    ///
    /// # Errors
    /// As [`System::new`].
    pub fn system(&self, setting: Setting) -> Result<System, SystemError> {
        // A family is kept for the life of the process.
        let family = std::ptr::from_ref(setting.family()).addr();
        let key = FlowKey { family, bits: setting.flow_bits().collect() };
        // No lock is held while another is waited for.
        let known = self.systems.read().get(&key).cloned();
        if let Some(known) = known {
            if let Some(system) = known.neighbour(&setting) {
                return Ok(system);
            }
            if let Some(system) = known.restopped(&setting) {
                return Ok(self.share(system.alone()));
            }
        }
        let system = self.share(System::new(setting)?);
        let mut known = self.systems.write();
        if known.len() < MOST_SYSTEMS {
            known.entry(key).or_insert_with(|| system.clone());
        }
        Ok(system)
    }

    /// Forgets what was kept where it is much, so that memory does not grow with the plane: what is asked for from here on is found
    /// anew.
    pub fn tidy(&self) {
        let mut flows = self.flows.lock();
        let forgotten = if flows.len() > MOST_SYSTEMS { take(&mut *flows) } else { return };
        drop(flows);
        let systems = take(&mut *self.systems.write());
        // It is much, and nobody waits for it.
        drop((forgotten, systems));
    }

    /// The same system, sharing what follows from its flow with those before it.
    #[must_use]
    pub fn share(&self, system: System) -> System {
        let flow = flow(&system);
        let mut known = self.flows.lock();
        if let Some(of_flow) = known.get(&flow) {
            return system.sharing(of_flow);
        }
        known.insert(flow, Arc::clone(system.of_flow()));
        system
    }
}

/// The bits of everything that the constants of a cell depend on but gaps and restitutions; of those, which are alike.
pub(super) fn flow(system: &System) -> Vec<u64> {
    let plant = system.like();
    let mut bits = vec![plant.n as u64, u64::from(system.steps()), plant.stops.len() as u64];
    let numbers = [&plant.mass, &plant.damping, &plant.stiffness].into_iter().flat_map(|m| m.iter());
    let loads = [&plant.force_sin, &plant.force_cos, &plant.load].into_iter().flat_map(|v| v.iter());
    let normals = plant.stops.iter().flat_map(|stop| stop.direction.iter());
    bits.extend(
        [plant.omega, system.rate()].iter().chain(numbers).chain(loads).chain(normals).map(|x| x.to_bits()),
    );
    // Whether there is a mirror depends on which stops have the same gap and restitution.
    bits.push(system.mirrored_stops());
    bits
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::model::{Flight, Parameter, Parameters, StateVector};
    use crate::system::{Family, Plant, PlantStop};

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
        assert_eq!(flows.flows.lock().len(), 2);
    }

    #[test]
    fn stops_whose_directions_differ_in_length_have_the_gaps_that_each_has_alone() {
        let direction = DVector::from_row_slice(&[0.3, -0.7, 1.1, 0.9]);
        let plant = |gap: f64| {
            let one = DMatrix::identity(4, 4);
            let stop = |length: f64| PlantStop { direction: &direction * length, gap, restitution: 0.7 };
            Plant {
                n: 4,
                mass: one.clone(),
                damping: &one * 0.1,
                stiffness: &one * 2.0,
                force_sin: DVector::from_element(4, 1.0),
                force_cos: DVector::zeros(4),
                load: DVector::zeros(4),
                omega: 1.3,
                stops: vec![stop(1.0), stop(-0.7)],
            }
        };
        let flows = Flows::default();
        for gap in [0.1, 0.2, 0.3, 0.7] {
            let alone = System::of_plant(plant(gap)).unwrap();
            let shares = flows.share(alone.clone());
            let (own, shared) = (Flight::<f64, 4>::new(&alone), Flight::new(&shares));
            assert_eq!(own, shared, "{gap}");
            assert!((own.normals[0].gap[1] - gap / 0.7).abs() < 1e-15, "{gap}");
        }
        assert_eq!(flows.flows.lock().len(), 1);
    }

    /// Holds everything that is read of a system to what another has.
    fn is_alike(own: &System, alone: &System) {
        let what = format!("{:?}", alone.setting());
        assert_eq!(own.mirror(), alone.mirror(), "{what}");
        assert_eq!([own.normals(), own.stops().len()], [alone.normals(), alone.stops().len()], "{what}");
        assert_eq!(own.is_clamped(), alone.is_clamped(), "{what}");
        let far = StateVector::from_slice(&vec![10.0; 2 * alone.coordinates()]).unwrap();
        assert_eq!(own.between_stops(far), alone.between_stops(far), "{what}");
        assert_eq!(own.clone().unforced(), alone.clone().unforced(), "{what}");
        assert_eq!(own.loaded_alone(0), alone.loaded_alone(0), "{what}");
        assert_eq!(own.at_frequency(1.7), alone.at_frequency(1.7), "{what}");
        match alone.coordinates() {
            1 => assert_eq!(Flight::<f64, 1>::new(own), Flight::new(alone), "{what}"),
            2 => assert_eq!(Flight::<f64, 2>::new(own), Flight::new(alone), "{what}"),
            3 => assert_eq!(Flight::<f64, 3>::new(own), Flight::new(alone), "{what}"),
            _ => assert_eq!(Flight::<f64, 4>::new(own), Flight::new(alone), "{what}"),
        }
    }

    #[test]
    fn a_system_made_from_another_is_the_one_that_its_setting_makes() {
        for builtin in &crate::system::BUILTIN {
            let family = Family::builtin(builtin.name);
            let (flows, mut found) = (Flows::default(), 0);
            for parameter in Parameter::all(family) {
                for factor in [1.0, 0.5, 0.9, 0.5] {
                    let defaults = Setting::defaults(family);
                    let setting = defaults.with(parameter, factor * defaults.get(parameter));
                    let (own, alone) = (flows.system(setting), System::new(setting));
                    assert_eq!(own, alone, "{}: {parameter} by {factor}", builtin.name);
                    if let (Ok(own), Ok(alone)) = (own, alone) {
                        is_alike(&own, &alone);
                        found += 1;
                    }
                }
            }
            let kept = flows.systems.read().len();
            assert!(kept > 0 && kept < found, "{}: {kept} of {found}", builtin.name);
        }
        let paper = Setting::defaults(Family::paper());
        let flows = Flows::default();
        let [first, second, third] = [("delta", 0.2), ("r", 0.5), ("zeta", 0.3)]
            .map(|(name, value)| flows.system(paper.with_named(name, value)).unwrap());
        assert!(Arc::ptr_eq(first.of_flow(), second.of_flow()));
        assert!(!Arc::ptr_eq(first.of_flow(), third.of_flow()));
        for (name, value) in [("delta", -0.1), ("r", 1.1), ("omega", 1e-12)] {
            let refused = paper.with_named(name, value);
            assert_eq!(flows.system(refused).unwrap_err(), System::new(refused).unwrap_err(), "{name}");
        }
    }

    #[test]
    fn stops_that_are_no_longer_alike_take_the_mirror_away() {
        let flows = Flows::default();
        let at = |beta: f64| {
            flows.system(Setting::defaults(Family::builtin("two-sided")).with_named("beta", beta)).unwrap()
        };
        assert!(at(1.0).mirror().is_some() && at(2.0).mirror().is_none() && at(1.0).mirror().is_some());
        assert!(Arc::ptr_eq(at(2.0).of_flow(), at(3.0).of_flow()));
    }

    #[test]
    fn every_pair_of_stops_that_are_alike_is_told_from_the_others() {
        let alike = |gaps: [f64; 4], restitutions: [f64; 4]| {
            let stop = |i: usize| {
                let mut direction = DVector::zeros(2);
                direction[i / 2] = [2.0, -2.0][i % 2];
                PlantStop { direction, gap: gaps[i], restitution: restitutions[i] }
            };
            let plant = system(1.3, 0.1, 0.8).plant().clone();
            System::of_plant(Plant { stops: (0..4).map(stop).collect(), ..plant }).unwrap().mirrored_stops()
        };
        let (gaps, restitutions) = ([0.1, 0.2, 0.3, 0.4], [0.8; 4]);
        assert_eq!(alike(gaps, restitutions), 0);
        let mut found = Vec::new();
        for (i, j) in (0..4).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let mut same = gaps;
            same[i] = gaps[j];
            found.push(alike(same, restitutions));
            let mut other = restitutions;
            other[i] = 0.7;
            assert_eq!(alike(same, other), 0, "{i}, {j}");
        }
        let all = alike([0.1; 4], restitutions);
        assert_eq!(found.iter().sum::<u64>(), all, "a bit for each");
        assert_eq!((found.iter().fold(0, |bits, pair| bits | pair), all.count_ones()), (all, 6));
    }

    #[test]
    fn what_is_kept_does_not_grow_with_the_plane() {
        let flows = Flows::default();
        let (mut most, mut kept) = (0, 0);
        // Ever new flows, as on a plane of ω and ζ; and of one flow ever new coefficients of restitution, as on one of ω and r.
        for tile in 0..5 {
            flows.tidy();
            most = most.max(flows.flows.lock().len());
            for i in 0..6000 {
                let more = 1e-5 * f64::from(6000 * tile + i);
                let paper = Parameters::default();
                flows.system(Parameters { omega: 2.0 + more, ..paper }.into()).unwrap();
                let system = flows.system(Parameters { r: 0.1 + more, ..paper }.into()).unwrap();
                system.whatever_gaps(|| i);
                kept = kept.max(system.of_flow().kept());
            }
        }
        assert!(most > MOST_SYSTEMS / 2 && most <= MOST_SYSTEMS, "{most}");
        assert!(kept > 1 && kept < 100, "{kept}");
        assert!(flows.flows.lock().len() < 24_000);
    }

    #[test]
    fn another_forcing_is_another_flow() {
        let flows = Flows::default();
        let first = flows.share(system(1.3, 0.1, 0.8));
        let second = flows.share(system(1.3, 0.2, 0.8));
        assert!(Arc::ptr_eq(first.of_flow(), second.of_flow()));
        let (_, constants) = (first.mirror(), Flight::<f64, 2>::new(&first));
        let kept: Option<&Flight<f64, 2>> = second.of_flow().constants(|| unreachable!("it is known"));
        assert_eq!(kept, Some(&constants));
        for changed in [first.clone().unforced(), first.clone().loaded(&[1.0, 2.0]), first.loaded_alone(1)] {
            let alone = System::of_plant(changed.plant().clone()).unwrap();
            assert_eq!(changed.mirror(), alone.mirror());
            assert_eq!(Flight::<f64, 2>::new(&changed).sin, Flight::<f64, 2>::new(&alone).sin);
            assert_eq!(Flight::<f64, 2>::new(&changed).steps, changed.steps());
            assert_ne!(Flight::<f64, 2>::new(&changed), Flight::new(&first));
        }
    }
}
