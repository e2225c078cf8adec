//! How the Jacobian of an arc changes with the impacts that it joins.

use nalgebra::{DMatrix, DVector};

use super::flow::Flow;
use super::matching::{Arc, departure};
use super::section_vector::Node;

/// The derivatives of Σ wᵢⱼ Jᵢⱼ, with J the [Jacobian](Arc::jacobian) of an arc and weights w.
#[derive(Clone, Debug)]
pub(crate) struct Bending {
    /// By the section at departure.
    pub from: DVector<f64>,
    /// By the phase of arrival; nothing else of the section there has a share in J.
    pub arrival: f64,
}

impl Arc {
    /// How the weighted sum of the entries of its Jacobian changes; none where the next impact is a grazing one.
    ///
    /// J = A + a·s with A = ∂R/∂u, a = ∂R/∂φ′ and s = −A_last/a_last, its last row being s itself. A and a are made of flight
    /// over (φ′ − φ)/ω and of z at departure, which is linear in u but for the phase: z changes with that as the forcing's
    /// phasor turns, and flight over a longer time is flight of z′ = G z.
    pub fn bending(&self, flow: &Flow, from: &Node, to: &Node, weights: &DMatrix<f64>) -> Option<Bending> {
        let last = self.residual.len() - 1;
        let shift = self.shift()?;
        // The weights of A's entries and of a's: those of J's, what comes with s, and what s itself comes to.
        let mut of_from = weights.clone();
        of_from.row_mut(last).fill(0.0);
        let mut of_arriving = &of_from * shift.transpose();
        let of_shift = (self.arriving.transpose() * &of_from + weights.row(last)) / self.approach();
        of_arriving[last] -= of_shift.dot(&shift);
        of_from.row_mut(last).copy_from(&-of_shift);
        // A's last column is what turning the phasor does, less a.
        let of_turning = of_from.column(last).into_owned();
        let of_arriving = of_arriving - &of_turning;

        let (start, _) = departure(flow, from, to);
        let turned = flow.turned(&start);
        let longer = &self.section * flow.generator() / flow.omega;
        // Its last column is 0.
        let lifted = &longer * &flow.face(from.stop).lift;
        let turning = &longer * &turned;
        let arrival = of_from.dot(&lifted)
            + of_turning.dot(&turning)
            + of_arriving.dot(&(&longer * (flow.generator() * &start) / flow.omega));
        let mut by_section = lifted.tr_mul(&of_arriving);
        by_section[last] =
            of_turning.dot(&(&self.section * flow.turned(&turned))) + of_arriving.dot(&turning) - arrival;
        Some(Bending { from: by_section, arrival })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Stop;
    use crate::model::{Parameters, System};
    use crate::theory::example::chain;
    use crate::theory::section_vector::SectionVector;

    /// Two impacts that no motion joins, so that nothing about them is special.
    fn impacts(system: &System) -> [Node; 2] {
        let last = 2 * system.coordinates() - 1;
        let section = |phase: f64| {
            SectionVector::from_fn(last + 1, |j, _| match j {
                j if j == last => phase,
                j => 0.3 * (1.7 * j as f64 + phase).cos(),
            })
        };
        [(Stop::B, 0.4), (Stop::A, 2.9)].map(|(stop, phase)| Node { stop, section: section(phase) })
    }

    #[test]
    fn it_is_that_of_finite_differences() {
        for system in [System::new(Parameters::default()).unwrap(), chain()] {
            let flow = Flow::new(&system);
            let [from, to] = impacts(&system);
            let size = from.section.len();
            let weights = DMatrix::from_fn(size, size, |i, j| (1.0 + 2.0 * i as f64 - 0.7 * j as f64).sin());
            let sum =
                |from: &Node, to: &Node| Arc::between(&flow, from, to).jacobian().unwrap().dot(&weights);
            let h = 1e-6;
            let differences = |change: &dyn Fn(f64) -> f64| (change(h) - change(-h)) / (2.0 * h);
            let moved = |node: &Node, j: usize, by: f64| {
                let mut node = node.clone();
                node.section[j] += by;
                node
            };
            let Bending { from: found, arrival } =
                Arc::between(&flow, &from, &to).bending(&flow, &from, &to, &weights).unwrap();
            let scale = found.amax().max(arrival.abs());
            for j in 0..size {
                let difference = differences(&|by| sum(&moved(&from, j, by), &to));
                assert!((found[j] - difference).abs() < 1e-7 * scale, "{j}: {} {difference}", found[j]);
                let arriving = differences(&|by| sum(&from, &moved(&to, j, by)));
                let expected = if j == size - 1 { arrival } else { 0.0 };
                assert!((arriving - expected).abs() < 1e-7 * scale, "{j}: {expected} {arriving}");
            }
            assert!((found[size - 1] + arrival).abs() > 1e-3 * scale, "the check can fail");
        }
    }
}
