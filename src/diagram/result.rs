//! A computed diagram.

use super::spec::DiagramSpec;
use super::sweep::Direction;
use crate::analysis::Trace;
use crate::plane::Provenance;

/// The columns of a diagram that were computed in one sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// How they follow each other.
    pub direction: Direction,
    /// One trace per column, in the order in which the axis is written.
    pub traces: Vec<Trace>,
    /// The 2n Lyapunov exponents of every column in the unit that was asked for, largest first, −∞ for a direction that is
    /// lost; NaN where there are none.
    pub spectrum: Option<Vec<Vec<f64>>>,
}

/// A computed bifurcation diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// What was asked.
    pub spec: DiagramSpec,
    /// What computed it.
    pub provenance: Provenance,
    /// One branch, or the falling and the rising one.
    pub branches: Vec<Branch>,
}

impl Diagram {
    /// A diagram without a column, as it is before it is computed: what its figure needs room for at least.
    pub fn blank(spec: &DiagramSpec) -> Self {
        let of = |&direction| Branch {
            direction,
            traces: Vec::new(),
            spectrum: spec.spectrum.map(|_| Vec::new()),
        };
        Diagram {
            spec: spec.clone(),
            provenance: Provenance::default(),
            branches: spec.sweep.branches().iter().map(of).collect(),
        }
    }

    /// The configuration text that files carry: the specification and its provenance, as JSON.
    pub fn config(&self) -> String {
        self.provenance.configuration(&self.spec).to_string()
    }

    /// Whether systems of the diagram have a mirror: that in the middle, or one of a motion that is symmetric.
    pub fn has_mirror(&self) -> bool {
        let middle = self.spec.parameters_at(self.spec.x.count / 2);
        let mut traces = self.branches.iter().flat_map(|branch| &branch.traces);
        middle.has_mirror() || traces.any(|trace| trace.verdict.symmetric)
    }

    /// Readings that were left out for want of room, over all columns.
    pub fn left_out(&self) -> u64 {
        self.branches.iter().flat_map(|branch| &branch.traces).map(|trace| u64::from(trace.left_out)).sum()
    }
}
