//! The stops of a system: their names, and the contact normals on which they stand.

use nalgebra::DVector;

use super::equations::{are_parallel, leave_no_room, stretch};
use super::system::System;
use crate::system::{Gap, PlantStop};

/// A contact normal, and a stop on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// d, the direction of the first stop on it.
    pub direction: DVector<f64>,
    /// M⁻¹d/(dᵀM⁻¹d): what a change of d·v by 1 does to v.
    pub response: DVector<f64>,
    /// The value of d·x at which the stop is met.
    pub place: f64,
    /// +1 where d·x grows towards the stop, −1 where it falls.
    pub sign: f64,
}

impl System {
    /// The name of a stop by its place in the plant's order, as it is easy to type; A, B, C and D where there is no family.
    ///
    /// # Panics
    /// If there is no such stop.
    pub fn stop_name(&self, stop: usize) -> &'static str {
        match self.family() {
            Some(family) => family.stops()[stop].plain_name(),
            None => ["A", "B", "C", "D"][stop],
        }
    }

    /// What two stops that leave no room between them do, in words, with the parameter that opens them where the file names
    /// one.
    pub fn closed(&self) -> String {
        let stops = 0..self.plant().stops.len();
        let same = |a: &Line, b: &Line| a.direction == b.direction && a.place == b.place;
        let pair = stops.clone().flat_map(|a| stops.clone().map(move |b| (a, b)));
        let pair = pair.into_iter().find(|&(a, b)| a < b && same(&self.line(a), &self.line(b)));
        let Some((a, b)) = pair else { return "the stops leave no room to move".to_owned() };
        let gap = |stop| self.family().map(|family| family.stop_place(stop).gap);
        let names = [a, b].map(|stop| self.stop_name(stop));
        match (gap(a), gap(b)) {
            (Some(Gap::Name(name)), Some(Gap::Name(other))) if name == other => {
                format!("stops {} and {} leave no room between them ({name} = 0)", names[0], names[1])
            }
            _ => format!("stops {} and {} leave no room between them", names[0], names[1]),
        }
    }

    /// Whether two opposed stops leave no room between them: the limit of a closing clearance.
    pub fn is_clamped(&self) -> bool {
        self.stops().enumerate().any(|(i, (direction, stop))| {
            self.stops().take(i).any(|(line, other)| {
                let [own, line] = [direction, line].map(|d| d.as_slice());
                let scale = stretch(own, line);
                are_parallel(own, line) && scale < 0.0 && leave_no_room([other.gap, stop.gap / -scale])
            })
        })
    }

    /// How many contact normals the stops have: parallel directions share one.
    pub fn normals(&self) -> usize {
        self.common().normals
    }

    /// The contact normal on which a stop stands, by its place in the plant's order.
    ///
    /// # Panics
    /// If there is no such stop.
    pub fn line(&self, stop: usize) -> Line {
        let stops = &self.plant().stops;
        let own = &stops[stop].direction;
        let parallel = |other: &&PlantStop| are_parallel(own.as_slice(), other.direction.as_slice());
        let direction = stops[..stop].iter().find(parallel).map_or(own, |first| &first.direction).clone();
        let scale = stretch(own.as_slice(), direction.as_slice());
        let response = self.plant().mass.clone().lu().solve(&direction);
        let response = response.expect("a plant's mass matrix was checked to be invertible");
        Line {
            response: &response / direction.dot(&response),
            place: stops[stop].gap / scale,
            sign: scale.signum(),
            direction,
        }
    }
}
