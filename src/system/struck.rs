//! Which coordinates meet the stops of a family.

use super::family::Family;

impl Family {
    /// The coordinate that alone meets every stop, if there is one.
    pub fn struck_coordinate(&self) -> Option<usize> {
        let met = |stop: usize| self.met_by(stop);
        let first = met(0)?;
        (0..self.stops().len()).all(|stop| met(stop) == Some(first)).then_some(first)
    }

    /// The coordinate that alone meets a stop, if one does.
    pub fn met_by(&self, stop: usize) -> Option<usize> {
        let place = self.stop_place(stop);
        place.is_alone().then(|| place.terms[0].coordinate)
    }

    /// The first coordinate that meets no stop, or else the first.
    pub fn free_coordinate(&self) -> usize {
        let meets = |i: usize| {
            let mut stops = 0..self.stops().len();
            stops.any(|stop| self.stop_place(stop).terms.iter().any(|term| term.coordinate == i))
        };
        (0..self.n()).find(|&i| !meets(i)).unwrap_or(0)
    }
}
