//! One turn of a motion with one of its impacts moved.

use nalgebra::DMatrix;

use crate::theory::newton::arc;
use crate::theory::{Arc, Flow, Pattern, SectionVector};

/// The Jacobian of one turn as a product over its arcs, kept in parts: moving one impact changes two arcs alone.
pub(super) struct Chain<'a> {
    flow: &'a Flow,
    pattern: &'a Pattern,
    sections: Vec<SectionVector>,
    /// The product of the arcs before each one.
    before: Vec<DMatrix<f64>>,
    /// The product of each arc and those after it, with the mirror.
    from: Vec<DMatrix<f64>>,
    /// The product of all arcs but the first and the last.
    between: DMatrix<f64>,
}

impl<'a> Chain<'a> {
    /// The parts of the turn of a motion with its arcs; none where an impact grazes.
    pub fn new(
        flow: &'a Flow,
        pattern: &'a Pattern,
        sections: Vec<SectionVector>,
        arcs: &[Arc],
    ) -> Option<Self> {
        let jacobians: Vec<DMatrix<f64>> = arcs.iter().map(Arc::jacobian).collect::<Option<_>>()?;
        let count = jacobians.len();
        let identity = DMatrix::identity(2 * flow.n, 2 * flow.n);
        let mut before = vec![identity.clone()];
        for jacobian in &jacobians {
            before.push(jacobian * &before[before.len() - 1]);
        }
        let mut from = vec![pattern.reopening_matrix(flow); count + 1];
        for i in (0..count).rev() {
            from[i] = &from[i + 1] * &jacobians[i];
        }
        let inner = jacobians.get(1..count.saturating_sub(1)).unwrap_or_default();
        let between = inner.iter().fold(identity, |product, jacobian| jacobian * product);
        Some(Chain { flow, pattern, sections, before, from, between })
    }

    /// The Jacobian of the turn with the `i`-th impact somewhere else; none where an impact grazes then.
    pub fn turn_with(&mut self, i: usize, section: SectionVector) -> Option<DMatrix<f64>> {
        let own = std::mem::replace(&mut self.sections[i], section);
        let turned = self.turned(i);
        self.sections[i] = own;
        turned.filter(|map| map.iter().all(|value| value.is_finite()))
    }

    fn turned(&self, i: usize) -> Option<DMatrix<f64>> {
        let count = self.sections.len();
        let jacobian = |i: usize| arc(self.flow, self.pattern, &self.sections, i).jacobian();
        Some(match i {
            0 if count == 1 => &self.from[1] * jacobian(0)?,
            0 => &self.from[count] * jacobian(count - 1)? * &self.between * jacobian(0)?,
            _ => &self.from[i + 1] * jacobian(i)? * jacobian(i - 1)? * &self.before[i - 1],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, System};
    use crate::theory::newton::arcs;
    use crate::theory::{settled_motion, turn_along};

    #[test]
    fn a_moved_impact_changes_the_turn_as_a_whole_product_does() {
        // 1-1-1 symmetric, 1-1-1 unsymmetric, 2-4-4.
        for (omega, n, state) in [
            (3.7, 1, [-0.0707, 0.0067, -0.3378, 0.0198]),
            (3.5, 1, [-0.0697, 0.0138, -0.3639, 0.0164]),
            (1.63, 2, [0.0; 4]),
        ] {
            let system = System::new(Parameters { omega, delta: 0.1, ..Parameters::default() }).unwrap();
            let settled = crate::dynamics::record(&system, state, 3000, n, 1).samples[0];
            let motion = settled_motion(&system, settled.state, n).unwrap();
            let flow = Flow::new(&system);
            let pattern = &motion.pattern;
            let own = arcs(&flow, pattern, &motion.sections);
            let mut chain = Chain::new(&flow, pattern, motion.sections.clone(), &own).unwrap();
            for i in 0..motion.sections.len() {
                let moved = &motion.sections[i] + SectionVector::from_row_slice(&[1e-3, -2e-3, 1e-3, 3e-3]);
                let mut sections = motion.sections.clone();
                sections[i] = moved.clone();
                let whole = turn_along(&flow, pattern, &arcs(&flow, pattern, &sections)).unwrap();
                let unmoved = turn_along(&flow, pattern, &own).unwrap();
                let parts = chain.turn_with(i, moved).unwrap();
                assert!((parts - &whole).amax() < 1e-11 * whole.amax(), "{omega}, impact {i}");
                assert!((unmoved - &whole).amax() > 1e-4 * whole.amax(), "the check can fail");
            }
        }
    }
}
