//! A stop as the theory sees it: the section just after an impact there, and the law of the impact.

use std::cmp::Ordering;
use std::ops::Deref;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::section_vector::SectionVector;
use crate::dynamics::Stop;
use crate::model::System;
use crate::system::{StopValues, own_coordinate};

/// A stop of a plant with n coordinates, and the section just after an impact there.
///
/// The section has 2n components: the speed along the contact's own coordinate, the other displacements in order, the
/// other velocities in order, and the forcing phase. The displacement of the contact's own coordinate follows from
/// d·x = gap. Lifted, it is z = (x, v, sin φ, cos φ, 1).
#[derive(Clone, Debug)]
pub(crate) struct Face {
    side: Arc<Side>,
    /// d·x at contact.
    pub gap: f64,
}

/// What a face is whatever its gap.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Side {
    /// d.
    pub direction: DVector<f64>,
    /// r.
    pub restitution: f64,
    /// The contact's [own coordinate](crate::system::PlantStop::own_coordinate).
    pub coordinate: usize,
    /// How z grows with the section, without forcing: (2n + 3) × 2n, its last column 0.
    pub lift: DMatrix<f64>,
    /// What z at arrival becomes: the section just after the impact, with d·x in place of the phase; 2n × (2n + 3).
    pub restituted: DMatrix<f64>,
}

impl Face {
    /// The face of a stop with a direction, given M⁻¹.
    pub fn new(direction: &DVector<f64>, stop: StopValues, inverse_mass: &DMatrix<f64>) -> Self {
        let n = direction.len();
        let (size, last) = (2 * n + 3, 2 * n - 1);
        let direction = direction.clone();
        let mut response = inverse_mass * &direction;
        response /= direction.dot(&response);
        let coordinate = own_coordinate(&direction);
        let mut lift = DMatrix::zeros(size, 2 * n);
        let mut restituted = DMatrix::zeros(2 * n, size);
        for (k, slot) in slots(n, coordinate).enumerate() {
            lift[(slot, k)] = 1.0;
            if slot < n {
                lift[(coordinate, k)] = -direction[slot] / direction[coordinate];
                restituted[(k, slot)] = 1.0;
                continue;
            }
            let i = slot - n;
            for j in 0..n {
                let along = response[i] * direction[j];
                let own = if i == j { 1.0 } else { 0.0 };
                restituted[(k, n + j)] = (own - along) - stop.restitution * along;
            }
        }
        for j in 0..n {
            restituted[(last, j)] = direction[j];
        }
        let side = Side { direction, restitution: stop.restitution, coordinate, lift, restituted };
        Face { side: Arc::new(side), gap: stop.gap }
    }

    /// The face of a stop that differs from this one in its gap alone.
    pub fn at_gap(&self, gap: f64) -> Self {
        Face { side: Arc::clone(&self.side), gap }
    }

    /// Whether another face is this one but for the gap.
    pub fn is_but_for_gap(&self, other: &Face) -> bool {
        self.side == other.side
    }

    /// z of a section, without forcing.
    pub fn lifted(&self, section: &SectionVector) -> DVector<f64> {
        let mut z = &self.lift * section;
        let last = z.len() - 1;
        z[self.coordinate] += self.gap / self.direction[self.coordinate];
        z[last] = 1.0;
        z
    }

    /// The section of a state on the stop, just after an impact.
    pub fn section(&self, x: &[f64], v: &[f64], phase: f64) -> SectionVector {
        let n = x.len();
        let values = slots(n, self.coordinate).map(|k| if k < n { x[k] } else { v[k - n] });
        DVector::from_iterator(2 * n, values.chain(std::iter::once(phase)))
    }

    /// The terms of d·v of a section.
    fn speeds(&self, section: &SectionVector) -> impl Iterator<Item = f64> {
        let (n, c) = (self.direction.len(), self.coordinate);
        self.direction.iter().enumerate().map(move |(j, d)| {
            d * match j.cmp(&c) {
                Ordering::Equal => section[0],
                Ordering::Less => section[n + j],
                Ordering::Greater => section[n + j - 1],
            }
        })
    }

    /// d·v of a section, per unit of |d|: the speed into the stop.
    pub fn speed(&self, section: &SectionVector) -> f64 {
        self.speeds(section).sum::<f64>() / self.direction.norm()
    }

    /// The speed along the contact's own coordinate with which a section has d·v = 0.
    pub fn resting_speed(&self, section: &SectionVector) -> f64 {
        let own = |&(j, _): &(usize, f64)| j != self.coordinate;
        let others: f64 = self.speeds(section).enumerate().filter(own).map(|(_, speed)| speed).sum();
        // No −0.
        0.0 - others / self.direction[self.coordinate]
    }

    /// Whether a section leaves the stop outwards, by more than rounding.
    pub fn is_left_outwards(&self, section: &SectionVector) -> bool {
        let (sum, size) =
            self.speeds(section).fold((0.0, 0.0), |(sum, size), term: f64| (sum + term, size + term.abs()));
        sum > 8.0 * f64::EPSILON * size
    }

    /// The speed into the stop of velocities.
    pub fn speed_of(&self, v: &[f64]) -> f64 {
        self.direction.iter().zip(v).map(|(d, v)| d * v).sum::<f64>() / self.direction.norm()
    }

    /// d·x and d·v of a lifted state, or of (x, v).
    pub fn along(&self, z: &DVector<f64>) -> [f64; 2] {
        let n = self.direction.len();
        [self.direction.dot(&z.rows(0, n)), self.direction.dot(&z.rows(n, n))]
    }
}

impl Deref for Face {
    type Target = Side;

    fn deref(&self) -> &Side {
        &self.side
    }
}

/// Where the components of a section but the phase stand in (x, v).
pub(super) fn slots(n: usize, coordinate: usize) -> impl Iterator<Item = usize> {
    let others = move || (0..n).filter(move |&j| j != coordinate);
    std::iter::once(n + coordinate).chain(others()).chain(others().map(move |j| n + j))
}

/// The names of a section's components at a stop: "v1", "x2", "v2", "tau" for the paper's oscillator.
///
/// The speed along the contact's own coordinate just after the impact (the first coordinate with the largest component
/// of the stop's direction), the other displacements, the other velocities, the forcing phase.
///
/// # Panics
/// If the system has no such stop.
pub fn section_names(system: &System, stop: Stop) -> Vec<String> {
    let plant = system.plant();
    let n = plant.n;
    let name = |slot: usize| if slot < n { format!("x{}", slot + 1) } else { format!("v{}", slot + 1 - n) };
    let coordinate = plant.stops[stop.index()].own_coordinate();
    slots(n, coordinate).map(name).chain(std::iter::once("tau".to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stop on the second of three coordinates, between it and the others, in no special units.
    fn face(mass: &DMatrix<f64>) -> Face {
        let direction = DVector::from_row_slice(&[0.5, -2.0, 0.25]);
        let values = StopValues { gap: 0.3, restitution: 0.7 };
        Face::new(&direction, values, &mass.clone().try_inverse().unwrap())
    }

    #[test]
    fn sections_are_lifted_onto_the_stop_and_read_off_again() {
        let face = face(&DMatrix::from_diagonal(&DVector::from_row_slice(&[1.0, 2.0, 0.5])));
        assert_eq!((face.coordinate, slots(3, 1).collect()), (1, vec![4, 0, 2, 3, 5]));
        let section = DVector::from_row_slice(&[-0.4, 0.1, 0.2, 0.6, -0.7, 1.1]);
        let z = face.lifted(&section);
        assert!((face.direction.dot(&z.rows(0, 3)) - 0.3).abs() < 1e-15);
        assert_eq!(face.section(z.rows(0, 3).as_slice(), z.rows(3, 3).as_slice(), 1.1), section);
        let speed = 0.5 * 0.6 + 2.0 * 0.4 - 0.25 * 0.7;
        assert!((face.speed(&section) - speed / 4.3125f64.sqrt()).abs() < 1e-15);
        assert!((face.along(&z)[1] - speed).abs() < 1e-15);
        // Faster along its own coordinate by as much as the speed comes to, it rests; then it leaves inwards, and outwards before.
        assert!(face.is_left_outwards(&section));
        let resting = face.resting_speed(&section);
        assert!((resting - (section[0] + speed / 2.0)).abs() < 1e-15);
        for (change, outwards) in [(-1e-6, true), (0.0, false), (1e-6, false)] {
            let mut changed = section.clone();
            changed[0] = resting + change;
            assert_eq!(face.is_left_outwards(&changed), outwards, "{change}");
        }
    }

    /// An impact turns d·v into −r d·v and leaves what is not along M⁻¹d as it was.
    #[test]
    fn the_impact_turns_the_speed_back() {
        let mass = DMatrix::from_row_slice(3, 3, &[2.0, 0.3, 0.0, 0.3, 1.0, 0.1, 0.0, 0.1, 0.7]);
        let face = face(&mass);
        let before = DVector::from_row_slice(&[0.2, -0.9, 0.4]);
        let mut z = DVector::zeros(9);
        z.rows_mut(3, 3).copy_from(&before);
        let section = &face.restituted * z;
        let after = DVector::from_row_slice(&[section[3], section[0], section[4]]);
        assert!((face.direction.dot(&after) + 0.7 * face.direction.dot(&before)).abs() < 1e-14);
        let impulse = &mass * (&after - &before);
        let along = impulse.dot(&face.direction) / face.direction.norm_squared();
        assert!((&impulse - &face.direction * along).amax() < 1e-14, "it acts along d: {impulse}");
        assert!(impulse.amax() > 0.1, "the check can fail");
    }
}
