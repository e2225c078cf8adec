//! One turn of a motion, and how it changes with each of the impacts.

use nalgebra::{DMatrix, DVector};

use crate::theory::newton::ends;
use crate::theory::{Arc, Flow, Pattern, SectionVector};

/// The Jacobian of one turn as a product over its arcs, kept in parts.
pub(super) struct Chain<'a> {
    flow: &'a Flow,
    pattern: &'a Pattern,
    sections: &'a [SectionVector],
    arcs: &'a [Arc],
    /// The product of the arcs before each one.
    before: Vec<DMatrix<f64>>,
    /// The product of each arc and those after it, with the mirror.
    from: Vec<DMatrix<f64>>,
}

impl<'a> Chain<'a> {
    /// The parts of the turn of a motion with these arcs; none where an impact grazes.
    pub fn new(
        flow: &'a Flow,
        pattern: &'a Pattern,
        sections: &'a [SectionVector],
        arcs: &'a [Arc],
    ) -> Option<Self> {
        let jacobians: Vec<DMatrix<f64>> = arcs.iter().map(Arc::jacobian).collect::<Option<_>>()?;
        let mut before = vec![DMatrix::identity(2 * flow.n, 2 * flow.n)];
        for jacobian in &jacobians {
            before.push(jacobian * &before[before.len() - 1]);
        }
        let mut from = vec![pattern.reopening_matrix(flow)];
        for jacobian in jacobians.iter().rev() {
            from.push(&from[from.len() - 1] * jacobian);
        }
        from.reverse();
        let finite = from[0].iter().all(|value| value.is_finite());
        finite.then_some(Chain { flow, pattern, sections, arcs, before, from })
    }

    /// The Jacobian.
    pub fn turn(&self) -> &DMatrix<f64> {
        &self.from[0]
    }

    /// The derivatives of a function of the Jacobian by all sections of the motion, one after the other, from those by its entries.
    pub fn by_sections(&self, by_entries: &DMatrix<f64>) -> Option<DVector<f64>> {
        let Chain { flow, pattern, sections, .. } = *self;
        let (count, size) = (sections.len(), 2 * flow.n);
        let mut all = DVector::zeros(size * count);
        for (i, arc) in self.arcs.iter().enumerate() {
            let [from, to] = ends(flow, pattern, sections, i);
            let weights = self.from[i + 1].tr_mul(by_entries) * self.before[i].transpose();
            let bending = arc.bending(flow, &from, &to, &weights)?;
            let mut own = all.rows_mut(size * i, size);
            own += bending.from;
            all[size * ((i + 1) % count) + size - 1] += bending.arrival;
        }
        Some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, System};
    use crate::theory::newton::arcs;
    use crate::theory::{settled_motion, turn_along};

    #[test]
    fn a_turn_changes_with_its_impacts_as_the_product_of_its_arcs_does() {
        // 1-1-1 symmetric, 1-1-1 unsymmetric, 2-4-4.
        for (omega, n, state) in [
            (3.7, 1, [-0.0707, 0.0067, -0.3378, 0.0198]),
            (3.5, 1, [-0.0697, 0.0138, -0.3639, 0.0164]),
            (1.63, 2, [0.0; 4]),
        ] {
            let system = System::new(Parameters { omega, delta: 0.1, ..Parameters::default() }).unwrap();
            let settled = crate::dynamics::record(&system, state, 3000, n, 1).samples[0];
            let motion = settled_motion(&system, settled.state, n).unwrap();
            let (flow, pattern, sections) = (Flow::new(&system), &motion.pattern, &motion.sections);
            let own = arcs(&flow, pattern, sections);
            let chain = Chain::new(&flow, pattern, sections, &own).unwrap();
            let whole = |sections: &[SectionVector]| {
                turn_along(&flow, pattern, &arcs(&flow, pattern, sections)).unwrap()
            };
            assert!((chain.turn() - whole(sections)).amax() < 1e-12 * chain.turn().amax());
            let weights = DMatrix::from_fn(4, 4, |i, j| (1.0 + 3.0 * i as f64 - 1.3 * j as f64).cos());
            let found = chain.by_sections(&weights).unwrap();
            for k in 0..found.len() {
                let moved = |by: f64| {
                    let mut sections = sections.clone();
                    sections[k / 4][k % 4] += by;
                    whole(&sections).dot(&weights)
                };
                let difference = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                let off = (found[k] - difference).abs() / found.amax();
                assert!(off < 1e-6, "{omega}, unknown {k}: {} {difference}", found[k]);
            }
            assert!((found[3] - found[0]).abs() > 1e-3 * found.amax(), "the check can fail");
        }
    }
}
