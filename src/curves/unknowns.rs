//! The unknowns of a continuation: a motion's sections, in units of what is of order one, and the parameters that vary, scaled to a
//! plane's sides.

use nalgebra::{DMatrix, DVector};

use crate::figure::Spacing;
use crate::model::{Parameter, Setting, System};
use crate::theory::newton::{arcs, arcs_with_gaps, is_ordered, joints, residual, residual_alone};
use crate::theory::{Arc, Flow, Pattern, SectionVector, StopSet, magnified, unit_about};

/// A parameter and the range of it that counts as length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub parameter: Parameter,
    pub first: f64,
    pub last: f64,
    pub spacing: Spacing,
}

impl Span {
    /// The value at a share of the way from its first end to its last.
    pub fn value(&self, share: f64) -> f64 {
        self.spacing.at(self.first, self.last, share)
    }

    /// Where a value stands on it, 0 at its first end and 1 at its last.
    pub fn share(&self, value: f64) -> f64 {
        self.spacing.share(self.first, self.last, value)
    }
}

/// What a vector of unknowns stands for: 2n for each impact, then `extra` ones, then one for each parameter.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    pub pattern: Pattern,
    pub fixed: Setting,
    pub extra: usize,
    pub spans: Vec<Span>,
    /// The system of the fixed parameters, if there is one: others that differ in gaps and restitutions alone have their flow from it.
    like: Option<System>,
    /// The displacement, and the velocity, that count as one: what is of order one where the path begins.
    pub unit: f64,
}

/// A flow, and the arcs of some sections in it.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub flow: &'a Flow,
    pub arcs: &'a [Arc],
}

impl Unknowns {
    /// Those of a motion near some parameters, where it has some sections.
    pub fn new(
        pattern: Pattern,
        sections: &[SectionVector],
        fixed: Setting,
        extra: usize,
        spans: Vec<Span>,
    ) -> Self {
        let like = System::new(fixed).ok();
        let unit = unit_about(like.as_ref().map_or(1.0, System::unit), sections);
        Unknowns { pattern, fixed, extra, spans, like, unit }
    }

    /// 2n, the components of a section.
    pub fn size(&self) -> usize {
        2 * self.fixed.family().n()
    }

    /// Where the sections end.
    pub fn sections_end(&self) -> usize {
        self.size() * self.pattern.stops.len()
    }

    /// Where the parameters begin.
    pub fn parameters_at(&self) -> usize {
        self.sections_end() + self.extra
    }

    /// The vector of a motion.
    pub fn pack(&self, sections: &[SectionVector], extra: &[f64], parameters: &Setting) -> DVector<f64> {
        let shares = self.shares(parameters);
        let scaled = |section: &SectionVector| Vec::from(magnified(section, 1.0 / self.unit).data);
        let values = sections.iter().flat_map(scaled);
        DVector::from_iterator(
            self.parameters_at() + self.spans.len(),
            values.chain(extra.iter().copied()).chain(shares.iter().copied()),
        )
    }

    /// Where parameters stand on the spans.
    pub fn shares(&self, parameters: &Setting) -> DVector<f64> {
        let share = |span: &Span| span.share(parameters.get(span.parameter));
        DVector::from_iterator(self.spans.len(), self.spans.iter().map(share))
    }

    /// The parameters.
    pub fn parameters(&self, y: &DVector<f64>) -> Setting {
        self.spans
            .iter()
            .zip(y.iter().skip(self.parameters_at()))
            .fold(self.fixed, |parameters, (span, &share)| parameters.with(span.parameter, span.value(share)))
    }

    /// The system; none where its parameters are outside their physical range, or a mirrored motion has no mirror.
    pub fn system(&self, y: &DVector<f64>) -> Option<System> {
        let mirrored = |system: &System| !self.pattern.mirrored || StopSet::of(system) == self.pattern.among;
        let parameters = self.parameters(y);
        let neighbour = self.like.as_ref().and_then(|like| like.neighbour(&parameters));
        let system = neighbour.or_else(|| System::new(parameters).ok());
        system.filter(|system| !system.is_clamped() && mirrored(system))
    }

    /// The sections.
    pub fn sections(&self, y: &DVector<f64>) -> Vec<SectionVector> {
        let size = self.size();
        let of = |i: usize| magnified(&y.rows(size * i, size).into_owned(), self.unit);
        (0..self.pattern.stops.len()).map(of).collect()
    }

    /// The flow of the system there; see [`Unknowns::system`].
    pub fn flow(&self, y: &DVector<f64>) -> Option<Flow> {
        Some(Flow::new(&self.system(y)?))
    }

    /// The arcs of a motion, from what is known of the same sections at other parameters.
    pub fn arcs(&self, flow: &Flow, sections: &[SectionVector], known: Option<Known<'_>>) -> Vec<Arc> {
        self.known_arcs(flow, sections, known).unwrap_or_else(|| arcs(flow, &self.pattern, sections))
    }

    /// Residuals of the matching equations, likewise.
    pub fn residual(
        &self,
        flow: &Flow,
        sections: &[SectionVector],
        known: Option<Known<'_>>,
    ) -> DVector<f64> {
        let known = self.known_arcs(flow, sections, known);
        known.map_or_else(|| residual_alone(flow, &self.pattern, sections), |arcs| residual(&arcs))
    }

    /// The arcs, where gaps alone are others.
    fn known_arcs(
        &self,
        flow: &Flow,
        sections: &[SectionVector],
        known: Option<Known<'_>>,
    ) -> Option<Vec<Arc>> {
        let known = known.filter(|known| flow.is_but_for_gaps(known.flow))?;
        Some(arcs_with_gaps(flow, &self.pattern, sections, known.arcs))
    }

    /// Residuals, where the motion that leaves them is one.
    pub fn matched(&self, sections: &[SectionVector], residual: DVector<f64>) -> Option<DVector<f64>> {
        (is_ordered(&self.pattern, sections) && residual.amax().is_finite()).then(|| residual / self.unit)
    }

    /// The derivatives of the residuals of each arc by the section at its beginning, and by the next one.
    pub fn joints(&self, flow: &Flow, arcs: &[Arc]) -> Vec<[DMatrix<f64>; 2]> {
        let of_arc = |blocks: [DMatrix<f64>; 2]| blocks.map(|block| self.by_sections(block));
        joints(flow, arcs, &self.pattern).into_iter().map(of_arc).collect()
    }

    /// Displacements and velocities that are left, as residuals.
    pub fn left(&self, lengths: DVector<f64>) -> DVector<f64> {
        lengths / self.unit
    }

    /// Derivatives of displacements and velocities by sections, some of them beside each other, as those of residuals by unknowns: a
    /// phase is the same in any unit.
    pub fn by_sections(&self, mut lengths: DMatrix<f64>) -> DMatrix<f64> {
        for phase in (self.size() - 1..lengths.ncols()).step_by(self.size()) {
            lengths.column_mut(phase).unscale_mut(self.unit);
        }
        lengths
    }
}
