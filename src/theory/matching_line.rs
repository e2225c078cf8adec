//! The straight line on which the matching conditions (5) hold but for sin² τ + cos² τ = 1, for every gap at once.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::flow::Flow;
use super::section_vector::{SectionVector, phase};
use super::underdetermined::{Solutions, solved};
use crate::dynamics::Stop;
use crate::system::Plant;

/// 2n equations, of so many at most …
const EQUATIONS: usize = 2 * Plant::MOST_COORDINATES;
/// … for 2n + 1 unknowns.
const UNKNOWNS: usize = EQUATIONS + 1;

/// A place on the line; what a system has not as many unknowns for is 0. Every cell asks for some, so that none is on the heap.
pub(super) type Place = SVector<f64, UNKNOWNS>;

/// The matching conditions (5) between a stop and its image, of one flow and one restitution.
///
/// They are linear in 2n + 1 unknowns u, the section just after the impact without its phase, then sin τ and cos τ, and in
/// the gap δ: matrix · u + constant + δ growth = 0, 2n equations. The gap is in the last part alone, so that what solves them
/// is found once for all gaps: u = point + δ slope + s direction for any s. Everything is non-dimensional.
#[derive(Clone, Debug)]
pub(super) struct MatchingLine {
    /// 2n.
    size: usize,
    matrix: SMatrix<f64, EQUATIONS, UNKNOWNS>,
    constant: SVector<f64, EQUATIONS>,
    growth: SVector<f64, EQUATIONS>,
    /// At a gap of 0 the point nearest to (sin τ, cos τ) = 0 in those two.
    point: Place,
    /// How that grows with the gap.
    slope: Place,
    /// Of unit length in (sin τ, cos τ).
    direction: Place,
    /// Whether the mirror turns the orientation of the section.
    turns: bool,
}

impl MatchingLine {
    /// The line of the flow from one stop to its mirror image; none where the conditions are singular.
    pub fn of(flow: &Flow, from: Stop, to: Stop) -> Option<Self> {
        let (n, face, image) = (flow.n, flow.face(from), flow.face(to));
        let size = 2 * n;
        let joined = flow.joined([from, to], PI / flow.omega);
        let arrived = &joined.section;
        // Between two sections d·x stays on the stop, and so it does between their mirror images.
        let reflection = flow.reflection(from);
        let sections = &joined.lifted - &reflection;
        let mut matrix = DMatrix::zeros(size, size + 1);
        matrix.columns_mut(0, size - 1).copy_from(&sections.columns(0, size - 1));
        matrix.columns_mut(size - 1, 2).copy_from(&arrived.columns(size, 2));
        let constant = arrived.column(size + 2).into_owned();
        // What the contact's own coordinate does that follows from the gap.
        let mut own = DVector::zeros(size);
        own[face.coordinate] = 1.0 / face.direction[face.coordinate];
        let mirrored = flow.mirrored(&own);
        let mut due = image.section(mirrored.rows(0, n).as_slice(), mirrored.rows(n, n).as_slice(), 0.0);
        due[size - 1] = image.along(&mirrored)[0];
        let growth = arrived.columns(0, size) * own - due;
        let Solutions { points, direction } = solved(&matrix, [&-&constant, &-&growth])?;
        let direction = &direction / libm::hypot(direction[size - 1], direction[size]);
        if !direction.iter().all(|value| value.is_finite()) {
            return None;
        }
        let nearest = |k: usize| {
            let point = &points[k];
            let along = direction[size - 1] * point[size - 1] + direction[size] * point[size];
            point - &direction * along
        };
        Some(MatchingLine {
            size,
            matrix: matrix.fixed_resize(0.0),
            constant: constant.fixed_resize(0.0),
            growth: growth.fixed_resize(0.0),
            point: nearest(0).fixed_resize(0.0),
            slope: nearest(1).fixed_resize(0.0),
            direction: direction.fixed_resize(0.0),
            turns: reflection.determinant() < 0.0,
        })
    }

    /// Which of the two that [`MatchingLine::meeting`] finds has det(1 − J) > 0, J being the Jacobian of half a turn, if both
    /// reach their stops with a speed into them: det(1 − J) has the sign of −(place along the direction) · det(mirror).
    pub fn regular(&self) -> usize {
        usize::from(self.turns)
    }

    /// Its point nearest to (sin τ, cos τ) = 0 for a gap, in those two.
    pub fn at_gap(&self, gap: f64) -> Place {
        self.point + self.slope * gap
    }

    /// How far a point of it is from (sin τ, cos τ) = 0 in those two.
    pub fn distance(&self, point: &Place) -> f64 {
        libm::hypot(point[self.size - 1], point[self.size])
    }

    /// The two points with sin² τ + cos² τ = 1, each as a section with τ in [−π, π]; `nearest` is the point of their gap, and
    /// not more than 1 from (sin τ, cos τ) = 0.
    pub fn meeting(&self, nearest: &Place) -> [SectionVector; 2] {
        let distance = self.distance(nearest);
        let half_chord = (1.0 - distance * distance).sqrt();
        [-half_chord, half_chord].map(|along| {
            let values = nearest + self.direction * along;
            let last = self.size - 1;
            let tau = libm::atan2(values[last], values[last + 1]);
            SectionVector::from_fn(self.size, |k, _| if k == last { tau } else { values[k] })
        })
    }

    /// The largest residual that a section leaves of the conditions with a gap.
    pub fn residual(&self, section: &SectionVector, gap: f64) -> f64 {
        let last = section.len() - 1;
        let (sin, cos) = libm::sincos(phase(section));
        let mut residual = self.constant + self.growth * gap;
        for k in 0..=self.size {
            let value = if k < last { section[k] } else { [sin, cos][k - last] };
            residual.axpy(value, &self.matrix.column(k), 1.0);
        }
        residual.amax()
    }
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::model::{Flows, System};
    use crate::theory::example::{mirrored, with_stops};
    use crate::theory::newton;
    use crate::theory::symmetric_motions;

    #[test]
    fn one_line_holds_the_motions_of_every_gap() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let (mut compared, mut families) = (0, 0);
        for plant in mirrored() {
            families += 1;
            let flows = Flows::default();
            for _ in 0..60 {
                let restitution = [0.0, 0.3, 0.8, 0.95][random.random_range(0..4)];
                let gap = random.random_range(0.0..1.5);
                let system = System::of_plant(with_stops(&plant, gap, restitution)).unwrap();
                let shares = flows.share(system.clone());
                let (Ok(alone), Ok(shared)) = (symmetric_motions(&system), symmetric_motions(&shares)) else {
                    let reasons = [&system, &shares].map(|system| symmetric_motions(system).err());
                    assert_eq!(reasons[0].is_some(), reasons[1].is_some(), "{reasons:?}");
                    continue;
                };
                for (alone, shared) in alone.iter().zip(&shared) {
                    let (section, other) = (&shared.motion.sections[0], &alone.motion.sections[0]);
                    let size = 1.0 + section.amax();
                    assert!((section - other).amax() < 1e-9 * size, "δ = {gap}: {section} for {other}");
                    // What joins two impacts is written by itself, for any motion.
                    let arcs =
                        newton::arcs(&Flow::new(&system), &shared.motion.pattern, &shared.motion.sections);
                    let left = newton::residual(&arcs).amax();
                    assert!(left < 1e-12 * size * size, "δ = {gap}, r = {restitution}: {left}");
                    assert!((left - shared.motion.residual).abs() < 1e-12 * size * size);
                    compared += 1;
                }
            }
        }
        println!("{families} families, {compared} motions");
        assert!(families >= 4 && compared > 100, "{families} families, {compared} motions");
    }

    #[test]
    fn another_restitution_or_gap_is_another_motion() {
        for plant in mirrored() {
            let line = |restitution: f64| {
                let flow = Flow::new(&System::of_plant(with_stops(&plant, 0.2, restitution)).unwrap());
                let mirror = with_stops(&plant, 0.2, restitution).mirror().unwrap();
                let from = mirror.stops.iter().enumerate().position(|(i, &image)| i != image).unwrap();
                let (from, to) = (Stop(from as u8), Stop(mirror.stops[from] as u8));
                (MatchingLine::of(&flow, from, to).unwrap(), flow.face(from).direction.norm())
            };
            let ((own, unit), (other, _)) = (line(0.8), line(0.75));
            let gap = 0.05 * unit;
            let nearest = own.at_gap(gap);
            if own.distance(&nearest) > 1.0 {
                continue;
            }
            for section in own.meeting(&nearest) {
                let size = 1.0 + section.amax();
                assert!(own.residual(&section, gap) < 1e-12 * size * size);
                assert!(other.residual(&section, gap) > 1e-4, "{}", other.residual(&section, gap));
                assert!(own.residual(&section, 1.1 * gap) > 1e-4 * unit);
            }
        }
    }
}
