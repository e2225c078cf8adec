//! A system that is held where it may drift.

use std::sync::Arc;

use super::common::{Adrift, Common};
use super::restopped::Restopped;
use super::system::System;
use super::system_error::SystemError;
use crate::system::{Mooring, Plant};

impl System {
    /// The same system, held where it may drift, which bears on nothing else; see [`Mooring`]. Without that no motion of a system
    /// that may comes back to where it was.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where one forcing period would hold too many steps.
    pub fn moored(self) -> Result<Self, SystemError> {
        let Some((plant, mooring)) = Mooring::of(self.plant()) else { return Ok(self) };
        let free = Arc::new(self.plant().clone());
        let adrift = Some(Adrift { plant: free, mooring: Arc::new(mooring) });
        let common = Common::of(self.setting(), plant, self.common().label_order.clone())?;
        Ok(System { plant: Restopped::new(Common { adrift, ..common }), ..self })
    }

    /// What holds it where it may drift; none as a rule.
    pub fn mooring(&self) -> Option<&Arc<Mooring>> {
        self.common().adrift.as_ref().map(|adrift| &adrift.mooring)
    }

    /// The Lyapunov exponents per forcing period of what is held: they belong to no motion of the system.
    pub fn moorings(&self) -> &[f64] {
        self.mooring().map_or(&[], |mooring| &mooring.exponents)
    }

    /// How many components say how it moves: 2n, without what is held.
    pub(crate) fn dimension(&self) -> usize {
        2 * self.coordinates() - self.moorings().len()
    }

    /// Its plant without what holds it.
    pub(super) fn free_plant(&self) -> Plant {
        match &self.common().adrift {
            Some(adrift) => Plant { stops: self.plant().stops.clone(), ..(*adrift.plant).clone() },
            None => self.plant().clone(),
        }
    }

    /// The same system, which nothing holds: it moves as its equations say, and may drift.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where one forcing period would hold too many steps.
    pub fn adrift(&self) -> Result<Self, SystemError> {
        if self.mooring().is_none() {
            return Ok(self.clone());
        }
        let common = Common::of(self.setting(), self.free_plant(), self.common().label_order.clone())?;
        Ok(System { plant: Restopped::new(common), own: self.own.clone() })
    }

    /// tr(M⁻¹C), the rate at which free flight contracts volumes of phase space, without what holds it where it may drift.
    pub fn contraction(&self) -> f64 {
        let inverse = self.like().mass.clone().try_inverse();
        let inverse = inverse.expect("a plant's mass matrix was checked to be invertible");
        (inverse * &self.like().damping).trace() + self.moorings().iter().sum::<f64>() / self.period()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::system::PlantStop;

    /// Two masses that only a spring, a damper and a stop join.
    fn pair(omega: f64) -> Plant {
        let joint = |of: f64| DMatrix::from_row_slice(2, 2, &[of, -of, -of, of]);
        let direction = DVector::from_row_slice(&[1.0, -1.0]);
        Plant {
            n: 2,
            mass: DMatrix::from_diagonal(&DVector::from_row_slice(&[1.0, 0.7])),
            damping: joint(0.2),
            stiffness: joint(1.0),
            force_sin: DVector::from_row_slice(&[1.0, 0.0]),
            force_cos: DVector::zeros(2),
            load: DVector::from_row_slice(&[0.1, 0.1]),
            omega,
            stops: vec![PlantStop { direction, gap: 0.3, restitution: 0.8 }],
        }
    }

    #[test]
    fn what_holds_a_system_can_be_left_out_again() {
        let free = System::of_plant(pair(1.3)).unwrap();
        let held = free.clone().moored().unwrap();
        assert_eq!([&free, &held].map(|system| system.moorings().len()), [0, 2]);
        assert_ne!(held.plant(), free.plant());
        assert_eq!(held.adrift().unwrap().plant(), free.plant());
        assert_eq!(free.adrift().unwrap(), free);
        assert!((held.contraction() - free.contraction()).abs() < 1e-15);
        assert!(free.contraction() > 0.4, "{}", free.contraction());
        assert_eq!(held.clone().unforced().adrift().unwrap().plant(), free.clone().unforced().plant());
        assert_eq!(held.clone().moored().unwrap().moorings().len(), 2, "once is enough");
        assert!(held.mirror().is_none());
    }

    #[test]
    fn it_is_held_at_another_frequency_as_well() {
        let held = |omega: f64| System::of_plant(pair(omega)).unwrap().moored().unwrap();
        let other = held(1.3).at_frequency(2.1).unwrap();
        assert_eq!((other.plant(), other.moorings()), (held(2.1).plant(), held(2.1).moorings()));
        let free = System::of_plant(pair(1.3)).unwrap().at_frequency(2.1).unwrap();
        assert_eq!((free.plant(), free.moorings().len()), (&pair(2.1), 0));
    }
}
