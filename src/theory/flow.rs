//! Free flight over any length of time, as a matrix.

use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

use nalgebra::{DMatrix, DVector};

use super::face::{Face, slots};
use super::joined::Joined;
use super::section_vector::{Node, SectionVector, phase};
use crate::dynamics::Stop;
use crate::model::{OfFlow, System, forced_by, generator, transition, unit};
use crate::system::{Mirror, Mooring};

/// The flow z' = G z between impacts, z = (x, v, sin φ, cos φ, 1), and the stops.
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    /// n, the coordinates.
    pub n: usize,
    /// ω.
    pub omega: f64,
    /// See [`System::rate`].
    rate: f64,
    /// What holds the system where it may drift.
    pub mooring: Option<Arc<Mooring>>,
    /// The stops.
    faces: Vec<Face>,
    whatever_gaps: Arc<WhateverGaps>,
    kept: Arc<OfFlow>,
}

/// What does not depend on the gaps.
#[derive(Debug)]
struct WhateverGaps {
    /// The stops, with the gaps of any one of the systems that have all else in common.
    faces: Vec<Face>,
    /// What joins impacts half a forcing period apart, at the first two stops for which that was asked.
    half_period: OnceLock<([Stop; 2], Joined)>,
}

impl WhateverGaps {
    fn new(system: &System) -> Self {
        let inverse = inverse_mass(system);
        let faces = system.stops().map(|(direction, stop)| Face::new(direction, stop, &inverse)).collect();
        WhateverGaps { faces, half_period: OnceLock::new() }
    }
}

/// M⁻¹.
fn inverse_mass(system: &System) -> DMatrix<f64> {
    let mass = system.like().mass.clone();
    mass.try_inverse().expect("a plant's mass matrix was checked to be invertible")
}

impl Flow {
    /// The flow of a system.
    pub fn new(system: &System) -> Self {
        let whatever_gaps = system.whatever_gaps(|| WhateverGaps::new(system));
        let faces =
            whatever_gaps.faces.iter().zip(system.stops()).map(|(face, (_, stop))| face.at_gap(stop.gap));
        let faces = faces.collect();
        let kept = Arc::clone(system.of_flow());
        // Both are known from now on.
        kept.generator(|| generator(system.like()));
        system.mirror();
        let (n, omega, rate) = (system.coordinates(), system.like().omega, system.rate());
        Flow { n, omega, rate, mooring: system.mooring().cloned(), faces, whatever_gaps, kept }
    }

    /// G, (2n + 3) × (2n + 3).
    pub fn generator(&self) -> &DMatrix<f64> {
        self.kept.known_generator().expect("it was asked for when the flow was made")
    }

    /// The displacement, and the velocity, that are of order one; see [`System::unit`].
    pub fn unit(&self) -> f64 {
        let forced = self.kept.forced(|| forced_by(self.generator()));
        unit(forced, self.faces.iter().map(|face| face.gap / face.direction.norm()))
    }

    /// Whether another flow is this one but for the gaps, and flights over the same time are the same.
    pub fn is_but_for_gaps(&self, other: &Flow) -> bool {
        let alike = |(own, other): (&Face, &Face)| own.is_but_for_gap(other);
        self.rate == other.rate
            && self.generator() == other.generator()
            && self.faces.iter().zip(&other.faces).all(alike)
    }

    /// A stop.
    pub fn face(&self, stop: Stop) -> &Face {
        &self.faces[stop.index()]
    }

    /// Every stop, in the plant's order.
    pub fn faces(&self) -> impl Iterator<Item = (Stop, &Face)> {
        self.faces.iter().enumerate().map(|(i, face)| (Stop(i as u8), face))
    }

    /// exp(G t), found anew.
    fn transition(&self, time: f64) -> DMatrix<f64> {
        transition(self.generator(), self.rate, time)
    }

    /// exp(G t). Half a forcing period is computed once, and taken for every time that rounding alone keeps from it.
    pub fn over(&self, time: f64) -> Cow<'_, DMatrix<f64>> {
        if self.is_half_period(time) {
            let half = PI / self.omega;
            return Cow::Borrowed(self.kept.half_period(|| self.transition(half)));
        }
        Cow::Owned(self.transition(time))
    }

    /// What joins an impact at one stop to one at another after some time; over half a forcing period it is computed once.
    pub fn joined(&self, stops: [Stop; 2], time: f64) -> Cow<'_, Joined> {
        let compute = || {
            let over = self.over(time);
            Joined::new(&over, stops.map(|stop| self.face(stop)))
        };
        if self.is_half_period(time) {
            let (of, joined) = self.whatever_gaps.half_period.get_or_init(|| (stops, compute()));
            if *of == stops {
                return Cow::Borrowed(joined);
            }
        }
        Cow::Owned(compute())
    }

    /// Whether rounding alone keeps a time from half a forcing period.
    fn is_half_period(&self, time: f64) -> bool {
        let half = PI / self.omega;
        (time - half).abs() <= 4.0 * f64::EPSILON * half
    }

    /// The whole state z just after an impact.
    pub fn lifted(&self, stop: Stop, section: &SectionVector) -> DVector<f64> {
        let mut z = self.face(stop).lifted(section);
        let (sin, cos) = libm::sincos(phase(section));
        z[2 * self.n] = sin;
        z[2 * self.n + 1] = cos;
        z
    }

    /// How z changes with the forcing phase alone.
    pub fn turned(&self, z: &DVector<f64>) -> DVector<f64> {
        let mut turned = DVector::zeros(z.len());
        turned[2 * self.n] = z[2 * self.n + 1];
        turned[2 * self.n + 1] = -z[2 * self.n];
        turned
    }

    /// The mirror: P, and the stop that each stop is mapped onto.
    ///
    /// # Panics
    /// If the system has none.
    fn mirror(&self) -> &Mirror {
        self.kept.known_mirror().expect("a mirrored motion belongs to a system with a mirror")
    }

    /// P x of displacements, or P v of velocities.
    pub fn reflected(&self, values: &[f64]) -> DVector<f64> {
        let p = &self.mirror().matrix;
        DVector::from_fn(self.n, |i, _| (0..self.n).map(|j| p[(i, j)] * values[j]).sum())
    }

    /// The mirror image of (x, v).
    pub fn mirrored(&self, state: &DVector<f64>) -> DVector<f64> {
        self.mirrored_columns(&DMatrix::from_column_slice(2 * self.n, 1, state.as_slice()))
            .column(0)
            .into_owned()
    }

    /// The mirror images of columns of (x, v).
    pub fn mirrored_columns(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let p = &self.mirror().matrix;
        let mut image = columns.clone();
        for at in [0, self.n] {
            image.rows_mut(at, self.n).copy_from(&(p * columns.rows(at, self.n)));
        }
        image
    }

    /// The mirror image of an impact, at the same phase.
    pub fn mirror_image(&self, node: &Node) -> Node {
        let n = self.n;
        let z = self.face(node.stop).lifted(&node.section);
        let stop = Stop(self.mirror().stops[node.stop.index()] as u8);
        let [x, v] = [0, n].map(|at| self.reflected(z.rows(at, n).as_slice()));
        let section = self.face(stop).section(x.as_slice(), v.as_slice(), phase(&node.section));
        Node { stop, section }
    }

    /// The derivative of the mirror image with respect to the section at a stop; 2n × 2n.
    pub fn reflection(&self, stop: Stop) -> DMatrix<f64> {
        let n = self.n;
        let mirror = self.mirror();
        let image = &self.faces[mirror.stops[stop.index()]];
        let lift = &self.face(stop).lift;
        let mut reflection = DMatrix::zeros(2 * n, 2 * n);
        for (k, slot) in slots(n, image.coordinate).enumerate() {
            let (at, i) = if slot < n { (0, slot) } else { (n, slot - n) };
            for column in 0..2 * n {
                reflection[(k, column)] =
                    (0..n).map(|j| mirror.matrix[(i, j)] * lift[(at + j, column)]).sum();
            }
        }
        reflection[(2 * n - 1, 2 * n - 1)] = 1.0;
        reflection
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, System};

    #[test]
    fn what_joins_two_impacts_is_that_of_their_own_stops_and_time() {
        let system = System::new(Parameters::default()).unwrap();
        let flow = Flow::new(&system);
        let half = PI / flow.omega;
        let (a, b) = (Stop::A, Stop::B);
        let alone = |stops: [Stop; 2], time: f64| {
            let over = transition(flow.generator(), system.rate(), time);
            Joined::new(&over, stops.map(|stop| flow.face(stop)))
        };
        let differ = |one: &Joined, other: &Joined| {
            let parts = |joined: &Joined| [joined.section.clone(), joined.lifted.clone()];
            let pairs = parts(one).into_iter().zip(parts(other));
            pairs.map(|(own, other)| (own - other).amax()).fold(0.0, f64::max)
        };
        // The first two stops that are asked for are kept, the others found anew.
        for stops in [[a, b], [b, a], [a, a], [a, b]] {
            for time in [half, 0.7 * half] {
                let joined = flow.joined(stops, time);
                assert_eq!(differ(&joined, &alone(stops, time)), 0.0, "{stops:?} after {time}");
                let others = [[stops[1], stops[1]], stops].map(|other| alone(other, 0.9 * time));
                assert!(others.iter().all(|other| differ(&joined, other) > 1e-2), "the check can fail");
            }
        }
    }
}
