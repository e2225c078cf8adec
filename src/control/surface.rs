//! Where a section lies: the states just after an impact at one stop.

use super::components::Components;
use crate::dynamics::{End, Stop};
use crate::model::vector::{MOST, dot};
use crate::model::{FAR, Flight, Real, State, System};
use crate::system::Plant;

/// The surface of states that touch one stop, on which the impact Poincaré section σ of that stop lies.
///
/// On it d·x = gap, so that one displacement follows from the others: that of the stop's
/// [own coordinate](crate::system::PlantStop::own_coordinate), c. A point on σ is (v_c+, the other x in order, the other v in
/// order, τ). Trajectories may fly in more coordinates, M, than the N of the system: those beyond them are no part of a point, and 0 in
/// a state made of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The stop.
    pub stop: Stop,
    /// The end of a contact normal that it is.
    pub end: End,
    /// c.
    pub eliminated: usize,
    /// The mirror image of each stop, where the system has a mirror.
    pub mirror: Option<[Stop; MOST]>,
}

impl Surface {
    /// The surface of a stop of a system with the given constants.
    ///
    /// # Panics
    /// If the system has no such stop.
    pub fn new<T: Real, const N: usize>(system: &System, flight: &Flight<T, N>, stop: Stop) -> Self {
        let is_there = |end: &End| {
            let normal = &flight.normals[end.normal];
            normal.gap[end.side] < T::of(FAR) && usize::from(normal.stop[end.side]) == stop.index()
        };
        let mut ends = (0..flight.count).flat_map(|normal| [0, 1].map(|side| End { normal, side }));
        Surface {
            stop,
            end: ends.find(is_there).expect("the system has the stop"),
            eliminated: system.like().stops[stop.index()].own_coordinate(),
            mirror: system.mirror().map(|mirror| {
                std::array::from_fn(|stop| Stop(mirror.stops.get(stop).map_or(stop, |&image| image) as u8))
            }),
        }
    }

    /// The stop whose mirror image this one is, where the system has a mirror.
    #[inline(always)]
    pub fn twin(&self) -> Option<Stop> {
        self.mirror.map(|mirror| mirror[self.stop.index()])
    }

    /// The coordinates other than c, in order.
    #[inline(always)]
    fn others<const N: usize>(&self) -> impl Iterator<Item = usize> + use<N> {
        let eliminated = self.eliminated;
        (0..N).filter(move |&i| i != eliminated)
    }

    /// The components of a state on the surface at phase τ.
    #[inline(always)]
    pub fn components<T: Real, const N: usize, const M: usize>(
        &self,
        state: &State<T, M>,
        tau: T,
    ) -> Components<T, N> {
        let mut components = Components::zero();
        components[0] = state.v[self.eliminated];
        for (place, i) in self.others::<N>().enumerate() {
            components[1 + place] = state.x[i];
            components[N + place] = state.v[i];
        }
        components[Components::<T, N>::TAU] = tau;
        components
    }

    /// The state of a point on the section.
    #[inline(always)]
    pub fn state<T: Real, const N: usize, const M: usize>(
        &self,
        flight: &Flight<T, M>,
        components: &Components<T, N>,
    ) -> State<T, M> {
        let gap = flight.normals[self.end.normal].gap[self.end.side];
        self.unpacked(flight, components, self.end.sign::<T>() * gap)
    }

    /// The deviation of the state that belongs to a deviation within the section, at its own phase.
    #[inline(always)]
    pub fn deviation<T: Real, const N: usize, const M: usize>(
        &self,
        flight: &Flight<T, M>,
        components: &Components<T, N>,
    ) -> State<T, M> {
        self.unpacked(flight, components, T::zero())
    }

    /// The displacements and velocities of components with d·x = `along`.
    #[inline(always)]
    fn unpacked<T: Real, const N: usize, const M: usize>(
        &self,
        flight: &Flight<T, M>,
        components: &Components<T, N>,
        along: T,
    ) -> State<T, M> {
        let direction = &flight.normals[self.end.normal].direction;
        let mut state = State::zero();
        let mut rest = along;
        for (place, i) in self.others::<N>().enumerate() {
            state.x[i] = components[1 + place];
            state.v[i] = components[N + place];
            rest = rest - direction[i] * state.x[i];
        }
        state.x[self.eliminated] = rest / direction[self.eliminated];
        state.v[self.eliminated] = components[0];
        state
    }

    /// The velocity into the stop: 0 or negative just after an impact.
    #[inline(always)]
    pub fn approach<T: Real, const N: usize>(&self, flight: &Flight<T, N>, state: &State<T, N>) -> T {
        self.end.sign::<T>() * dot(&flight.normals[self.end.normal].direction, &state.v)
    }
}

/// The names of the components of a point on the section of a stop: `v1+`, `x2`, `v2`, `tau` for the first of two
/// coordinates.
///
/// # Panics
/// If the plant has no such stop.
pub fn section_names(plant: &Plant, stop: Stop) -> Vec<String> {
    let eliminated = plant.stops[stop.index()].own_coordinate();
    let others = || (0..plant.n).filter(|&i| i != eliminated).map(|i| i + 1);
    std::iter::once(format!("v{}+", eliminated + 1))
        .chain(others().map(|i| format!("x{i}")))
        .chain(others().map(|i| format!("v{i}")))
        .chain(["tau".to_owned()])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::PlantStop;
    use nalgebra::{DMatrix, DVector};

    /// Three masses whose stops are met by the second against the third, by the first alone, and by all.
    fn system() -> System {
        let stop = |direction: [f64; 3], gap| PlantStop {
            direction: DVector::from_row_slice(&direction),
            gap,
            restitution: 0.7,
        };
        let unit = DMatrix::identity(3, 3);
        System::of_plant(Plant {
            n: 3,
            mass: unit.clone(),
            damping: &unit * 0.1,
            stiffness: unit,
            force_sin: DVector::from_row_slice(&[1.0, 0.0, 0.5]),
            force_cos: DVector::zeros(3),
            load: DVector::zeros(3),
            omega: 1.3,
            stops: vec![stop([0.0, -2.0, 2.0], 0.3), stop([-4.0, 0.0, 0.0], 0.8), stop([0.2, 0.4, 0.1], 0.5)],
        })
        .unwrap()
    }

    #[test]
    fn the_coordinate_with_the_largest_share_is_left_out() {
        let plant = system().plant().clone();
        let names = |stop| section_names(&plant, Stop(stop)).join(" ");
        assert_eq!(names(0), "v2+ x1 x3 v1 v3 tau");
        assert_eq!(names(1), "v1+ x2 x3 v2 v3 tau");
        assert_eq!(names(2), "v2+ x1 x3 v1 v3 tau");
    }

    /// Control takes its fixed points, and its gains, from theory: component by component.
    #[test]
    fn a_section_has_the_components_that_theory_has() {
        // Entries that are one number but for rounding, either way, and clearly different ones.
        let third = 0.1 + 0.2;
        for direction in [[0.3, third, 0.0], [third, 0.3, 0.0], [-0.3, third, 1.0], [0.2, -0.7, third]] {
            let mut plant = system().plant().clone();
            plant.stops.truncate(1);
            plant.stops[0].direction = DVector::from_row_slice(&direction);
            let system = System::of_plant(plant).unwrap();
            let of_theory = crate::theory::section_names(&system, Stop(0)).join(" ");
            assert_eq!(section_names(system.plant(), Stop(0)).join(" ").replace('+', ""), of_theory);
            let surface = Surface::new(&system, &Flight::<f64, 3>::new(&system), Stop(0));
            let state = State { x: [1.0, 2.0, 3.0], v: [4.0, 5.0, 6.0] };
            let components: Components<f64, 3> = surface.components(&state, 7.0);
            let mut names = of_theory.split(' ');
            for (name, value) in names.by_ref().zip(components.values()) {
                let own = ["x1", "x2", "x3", "v1", "v2", "v3", "tau"].iter().position(|own| *own == name);
                assert_eq!(value, own.unwrap() as f64 + 1.0, "{name} of {direction:?}");
            }
        }
    }

    #[test]
    fn components_and_states_are_one_another() {
        let system = system();
        let flight = Flight::<f64, 3>::new(&system);
        for (stop, sign) in [(0, 1.0), (1, -1.0), (2, 1.0)] {
            let surface = Surface::new(&system, &flight, Stop(stop));
            let components = Components::<f64, 3>::from_slice(&[-0.3 * sign, 0.1, 0.2, 0.05, -0.04, 1.5]);
            let state = surface.state(&flight, &components);
            let given = &system.plant().stops[usize::from(stop)];
            let along: f64 = given.direction.iter().zip(&state.x).map(|(d, x)| d * x).sum();
            assert!((along - given.gap).abs() < 1e-15, "{along}");
            let into: f64 = given.direction.iter().zip(&state.v).map(|(d, v)| d * v).sum();
            assert!(into * surface.approach(&flight, &state) > 0.0, "{into}");
            assert_eq!(surface.components(&state, 1.5), components);
            let deviation = surface.deviation(&flight, &components);
            let along: f64 = given.direction.iter().zip(&deviation.x).map(|(d, x)| d * x).sum();
            assert!(along.abs() < 1e-15, "{along}");
            assert_eq!(surface.twin(), None);
        }
    }
}
