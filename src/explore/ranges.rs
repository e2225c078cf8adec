//! The ranges that a page offers for what an axis may vary.

use crate::model::{Parameter, Setting, System};
use crate::plane::{Axis, Plane};
use crate::system::Family;

/// The ends of a slider: the parameter's own where it has any, else about the value.
pub fn slider(parameter: Parameter, value: f64) -> [f64; 2] {
    let range = parameter.about().range;
    let reach = if value == 0.0 { 1.0 } else { 2.0 * value.abs() };
    let shy = |end: f64, included: bool, inwards: f64| if included { end } else { end + inwards };
    // A bound far away, such as the largest frequency, is no use as the end of a slider.
    let near = |end: f64| end.abs() <= 20.0 * reach;
    let low = range.lower.filter(|bound| near(bound.value));
    let high = range.upper.filter(|bound| near(bound.value));
    let span = match (low, high) {
        (Some(low), Some(high)) => high.value - low.value,
        _ => reach,
    };
    let low = low.map_or(value - reach, |bound| shy(bound.value, bound.included, 1e-3 * span));
    let high = high.map_or(value + reach, |bound| shy(bound.value, bound.included, -1e-3 * span));
    [low.min(value), high.max(value)]
}

/// Cells along an axis that nobody chose.
const CELLS: u32 = 200;

/// The axis of one of a family's parameters, by its place among them, if there are so many: over its slider.
pub fn axis_of(family: &'static Family, place: usize) -> Option<String> {
    let (parameter, value) = Setting::defaults(family).entries().nth(place)?;
    let [low, high] = slider(parameter, value);
    Some(format!("{}={low}:{high}:{CELLS}", parameter.name()))
}

/// The ends of an axis over a component of the start, x1 … xn, v1 … vn by their places: a displacement leads up to the stops that meet it
/// alone, wherever on the plane these stand, a velocity and what no stop meets from −1 to 1.
pub fn component_range<T>(plane: &Plane<T>, component: usize) -> [f64; 2] {
    let mut range = [-1.0_f64, 1.0];
    let ends = |axis: &Axis| [0, axis.count - 1];
    let corners = ends(&plane.x).into_iter().flat_map(|column| ends(&plane.y).map(|row| (column, row)));
    for (column, row) in corners {
        let Ok(system) = System::new(plane.parameters_at(column, row)) else { continue };
        for stop in &system.plant().stops {
            let own = stop.direction.get(component).copied().unwrap_or(0.0);
            let alone = stop.direction.iter().filter(|entry| **entry != 0.0).count() == 1;
            let at = stop.gap / own;
            if own > 0.0 && alone {
                range[1] = range[1].min(at);
            } else if own < 0.0 && alone {
                range[0] = range[0].max(at);
            }
        }
    }
    if range[0] < range[1] { range } else { [-1.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Start;

    #[test]
    fn starts_are_offered_between_the_stops_that_meet_them_on_all_of_a_plane() {
        let plane = Plane::of_paper("omega=2:4:9", "delta=0.05:0.3:31", Start::Rest, ()).unwrap();
        assert_eq!(component_range(&plane, 0), [-0.05, 0.05]);
        assert_eq!([1, 2, 3].map(|component| component_range(&plane, component)), [[-1.0, 1.0]; 3]);
    }

    #[test]
    fn axes_that_nobody_chose_are_those_of_the_first_parameters() {
        let family = Family::paper();
        let [first, second] = [0, 1].map(|place| axis_of(family, place).unwrap());
        for (text, name) in [(first, "omega"), (second, "delta")] {
            let axis = Axis::of_family(&text, family).unwrap();
            assert_eq!((axis.quantity.name(), axis.count), (name, CELLS), "{text}");
        }
        assert_eq!(axis_of(family, 99), None);
    }
}
