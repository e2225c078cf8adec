//! One value for each component of a section point, where their number is known at run time only.

use std::fmt;
use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::components::Components;
use super::section_point::short_way;
use crate::dynamics::Stop;
use crate::model::{Real, StateVector};
use crate::system::{Plant, PlantStop};

/// The most components of a section point.
pub const MOST_COMPONENTS: usize = 2 * Plant::MOST_COORDINATES;

/// One value for each component of a section point, in their order: 2n of them for n coordinates, at least one and at most
/// [`MOST_COMPONENTS`].
#[derive(Clone, Copy)]
pub struct SectionValues<V> {
    /// Those from `count` on mean nothing.
    values: [V; MOST_COMPONENTS],
    count: usize,
}

impl<V: Copy> SectionValues<V> {
    /// The values given, one for each component.
    ///
    /// # Panics
    /// If there is none, or more than [`MOST_COMPONENTS`] of them.
    pub const fn new<const M: usize>(given: [V; M]) -> Self {
        assert!(M > 0 && M <= MOST_COMPONENTS);
        let mut values = [given[0]; MOST_COMPONENTS];
        let mut i = 1;
        while i < M {
            values[i] = given[i];
            i += 1;
        }
        SectionValues { values, count: M }
    }

    /// The values of a slice; none where there are too few or too many.
    pub fn from_slice(given: &[V]) -> Option<Self> {
        let first = *given.first()?;
        let mut values = [first; MOST_COMPONENTS];
        values.get_mut(..given.len())?.copy_from_slice(given);
        Some(SectionValues { values, count: given.len() })
    }

    /// Every value changed by a function.
    #[must_use]
    pub fn map<U: Copy>(&self, f: impl Fn(V) -> U) -> SectionValues<U> {
        SectionValues { values: self.values.map(f), count: self.count }
    }
}

impl<T: Real> SectionValues<T> {
    /// The components of a point.
    pub fn of<const N: usize>(components: &Components<T, N>) -> Self {
        let mut values = [components[0]; MOST_COMPONENTS];
        for (value, component) in values.iter_mut().zip(components.values()) {
            *value = component;
        }
        SectionValues { values, count: 2 * N }
    }

    /// This point minus another of the same section; τ, the last component, the short way round.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let mut difference = *self;
        for (value, other) in difference.iter_mut().zip(other.iter()) {
            *value = *value - *other;
        }
        let tau = &mut difference.values[self.count - 1];
        *tau = short_way(*tau);
        difference
    }

    /// The largest difference of a component from another point's on the same section, that of τ as it is, others in units of what is of
    /// order one; see [`System::unit`](crate::model::System::unit).
    pub fn distance(&self, other: &Self, unit: T) -> T {
        let difference = self.minus(other);
        let (mechanical, tau) = difference.split_at(self.count - 1);
        let sizes = mechanical.iter().map(|value| value.abs() / unit).chain(tau.iter().map(|tau| tau.abs()));
        sizes.fold(T::zero(), |largest, size| if size > largest { size } else { largest })
    }

    /// How far this point is from another of the same section that it may return to; see
    /// [`SectionPoint::away_from`](super::section_point::SectionPoint::away_from).
    pub fn away_from(&self, anchor: &Self, unit: T) -> T {
        let extents = anchor[..self.count - 1].iter().map(|value| value.abs());
        self.distance(anchor, extents.fold(unit, |size, extent| if extent > size { extent } else { size }))
    }
}

impl SectionValues<f64> {
    /// The state (x1 … xn, v1 … vn) of this point on the section of a stop; zeros for the zeros of a section that was never
    /// met.
    ///
    /// # Panics
    /// If it does not have 2n components.
    pub fn state(&self, plant: &Plant, stop: Stop) -> StateVector {
        let (n, own) = (plant.n, plant.stops[stop.index()].own_coordinate());
        let mut state = StateVector::zeros(n);
        if self.iter().all(|&value| value == 0.0) {
            return state;
        }
        let PlantStop { direction, gap, .. } = &plant.stops[stop.index()];
        let mut rest = *gap;
        for (place, i) in (0..n).filter(|&i| i != own).enumerate() {
            (state[i], state[n + i]) = (self[1 + place], self[n + place]);
            rest -= direction[i] * state[i];
        }
        (state[own], state[n + own]) = (rest / direction[own], self[0]);
        state
    }
}

impl<V> Deref for SectionValues<V> {
    type Target = [V];

    fn deref(&self) -> &[V] {
        &self.values[..self.count]
    }
}

impl<V> DerefMut for SectionValues<V> {
    fn deref_mut(&mut self) -> &mut [V] {
        &mut self.values[..self.count]
    }
}

impl<V> AsRef<[V]> for SectionValues<V> {
    fn as_ref(&self) -> &[V] {
        self
    }
}

impl<V: PartialEq> PartialEq for SectionValues<V> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<V: fmt::Debug> fmt::Debug for SectionValues<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl<V: Serialize> Serialize for SectionValues<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de, V: Copy + Deserialize<'de>> Deserialize<'de> for SectionValues<V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let given = Vec::<V>::deserialize(deserializer)?;
        SectionValues::from_slice(&given).ok_or_else(|| {
            serde::de::Error::invalid_length(given.len(), &"one value for each component, 1 to 8 of them")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Setting;
    use crate::system::Family;

    #[test]
    fn they_are_written_as_the_list_that_they_are() {
        for values in [SectionValues::new([0.5, -1.0]), SectionValues::new([0.25; 8])] {
            let text = serde_json::to_string(&values).unwrap();
            assert_eq!(text, serde_json::to_string(&values.to_vec()).unwrap());
            assert_eq!(serde_json::from_str::<SectionValues<f64>>(&text).unwrap(), values);
        }
        for bad in ["[]", "[1,1,1,1,1,1,1,1,1]"] {
            assert!(serde_json::from_str::<SectionValues<f64>>(bad).is_err(), "{bad}");
        }
        assert_ne!(SectionValues::new([0.5; 4]), SectionValues::new([0.5; 6]));
    }

    /// On the paper's section d·x = gap, whatever stands beside; at the other stop the mirror image has the mirrored state.
    #[test]
    fn a_point_has_the_state_that_touches_its_stop() {
        let plant = Setting::defaults(Family::paper()).plant().unwrap();
        let gap = plant.stops[0].gap;
        let point = SectionValues::new([-0.4, 0.03, 0.05, 1.8]);
        let state = point.state(&plant, Stop::A);
        assert_eq!(state[..], [plant.stops[0].direction[0] * gap, 0.03, -0.4, 0.05]);
        let image = point.map(|value| -value).state(&plant, Stop::B);
        assert_eq!(image[..], [-state[0], -0.03, 0.4, -0.05]);
        assert_eq!(SectionValues::new([0.0; 4]).state(&plant, Stop::A)[..], [0.0; 4]);
    }

    #[test]
    fn phases_differ_the_short_way_round() {
        let near = SectionValues::new([1.0, 6.2]).distance(&SectionValues::new([1.0, 0.1]), 0.5);
        assert!((near - (std::f64::consts::TAU - 6.1)).abs() < 1e-15);
        let apart =
            |unit: f64| SectionValues::new([7.0, 1.0]).distance(&SectionValues::new([0.5, 1.0]), unit);
        assert_eq!([apart(1.0), apart(0.5)], [6.5, 13.0]);
    }
}
