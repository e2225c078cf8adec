//! Which motions a branch shows along the axis: stretches of equal columns, and the windows that get a name.

use crate::analysis::{CHATTER_RUN, Trace};
use crate::figure::{Scale, Stretch, StripLabel};
use crate::plane::Axis;
use crate::render::colouring::Colouring;
use crate::render::motion::Motion;

/// Interruptions of a window that are shorter than this share of the axis do not end it.
const INTERRUPTION: f64 = 0.004;

/// Columns in a row that have something in common.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Run<K> {
    kind: K,
    first: usize,
    last: usize,
}

fn runs<K: PartialEq + Copy>(kinds: impl Iterator<Item = K>) -> Vec<Run<K>> {
    let mut runs: Vec<Run<K>> = Vec::new();
    for (i, kind) in kinds.enumerate() {
        match runs.last_mut().filter(|run| run.kind == kind) {
            Some(run) => run.last = i,
            None => runs.push(Run { kind, first: i, last: i }),
        }
    }
    runs
}

/// The places of columns on the axis: each reaches half a column to either side.
pub(super) struct Columns {
    axis: Axis,
}

impl Columns {
    /// The columns of an axis.
    pub fn of(axis: &Axis) -> Self {
        Columns { axis: *axis }
    }

    /// The scale that shows them all.
    pub fn scale(&self) -> Scale {
        Scale::of(&self.axis.steps)
    }

    fn span(&self, first: usize, last: usize) -> [f64; 2] {
        if self.axis.count == 1 {
            return self.scale().ends();
        }
        [self.axis.at(first as f64 - 0.5), self.axis.at(last as f64 + 0.5)]
    }

    /// The colours of the motions.
    pub fn stretches(&self, traces: &[Trace], paints: &Colouring) -> Vec<Stretch> {
        let motions = traces.iter().map(|trace| Motion::of(&trace.verdict));
        let stretch =
            |run: &Run<Motion>| Stretch { x: self.span(run.first, run.last), paint: paints.paint(run.kind) };
        runs(motions).iter().map(stretch).collect()
    }

    /// The names of the motions, in full and abbreviated.
    pub fn labels(&self, traces: &[Trace], mirrored: bool) -> Vec<StripLabel> {
        let gap = (INTERRUPTION * traces.len() as f64) as usize;
        let mut windows: Vec<Run<Motion>> = Vec::new();
        for run in runs(traces.iter().map(|trace| Motion::of(&trace.verdict))) {
            // A window goes on after an interruption; what interrupted it, and got a window of its own, is absorbed.
            let resumed = windows.iter().rposition(|w| w.kind == run.kind && run.first - w.last - 1 <= gap);
            match resumed {
                Some(i) => {
                    windows[i].last = run.last;
                    windows.truncate(i + 1);
                }
                None => windows.push(run),
            }
        }
        let label = |window: &Run<Motion>| {
            let verdict = &traces[window.last].verdict;
            let names =
                vec![Motion::name(verdict, mirrored).into(), Motion::short_name(verdict, mirrored).into()];
            StripLabel { x: self.span(window.first, window.last), names }
        };
        windows.iter().map(label).collect()
    }

    /// Where impacts chatter without sticking, and where the first mass sticks.
    pub fn bands(&self, traces: &[Trace]) -> [Vec<[f64; 2]>; 2] {
        let sticks = |trace: &Trace| {
            use crate::analysis::Regime::{AperiodicSticking, PeriodicSticking};
            matches!(trace.verdict.regime, PeriodicSticking | AperiodicSticking)
        };
        let chatters = |trace: &Trace| trace.rebounds >= CHATTER_RUN && !sticks(trace);
        let bands = |is: &dyn Fn(&Trace) -> bool| {
            let there = runs(traces.iter().map(is)).into_iter().filter(|run| run.kind);
            there.map(|run| self.span(run.first, run.last)).collect()
        };
        [bands(&chatters), bands(&sticks)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Regime;
    use crate::analysis::Verdict;

    fn traces(motions: &[(u16, usize)]) -> Vec<Trace> {
        let trace = |&(n, count): &(u16, usize)| {
            let verdict = Verdict::of_motion(Regime::Periodic, [n, n, n], false);
            vec![Trace { verdict, readings: Vec::new(), left_out: 0, rebounds: u32::from(n) }; count]
        };
        motions.iter().flat_map(trace).collect()
    }

    #[test]
    fn short_interruptions_do_not_end_a_window() {
        let columns = Columns::of(&"x2=0:999:1000".parse().unwrap());
        let traces = traces(&[(1, 400), (2, 1), (1, 1), (3, 1), (1, 97), (2, 500)]);
        let labels = columns.labels(&traces, true);
        let spans: Vec<[f64; 2]> = labels.iter().map(|label| label.x).collect();
        assert_eq!(spans, [[-0.5, 499.5], [499.5, 999.5]]);
        assert_eq!(columns.stretches(&traces, &Colouring::of([])).len(), 6);
    }

    #[test]
    fn a_single_column_has_a_width() {
        let columns = Columns::of(&"omega=2:2:1".parse().unwrap());
        let stretches = columns.stretches(&traces(&[(1, 1)]), &Colouring::of([]));
        let [left, right] = stretches[0].x.map(|x| columns.scale().fraction(x));
        assert_eq!((stretches.len(), left, right), (1, 0.0, 1.0));
        assert!(columns.labels(&traces(&[(1, 1)]), true)[0].x[0] < 2.0);
    }

    #[test]
    fn names_tell_symmetric_from_unsymmetric_however_short() {
        let columns = Columns::of(&"x2=0:1:2".parse().unwrap());
        let mut both = traces(&[(1, 2)]);
        both[0].verdict.symmetric = true;
        let labels = columns.labels(&both, true);
        assert!(labels[0].names.iter().all(|name| !labels[1].names.contains(name)), "{labels:?}");
    }

    #[test]
    fn chatter_is_marked() {
        let columns = Columns::of(&"omega=5:3:5".parse().unwrap());
        let [chatter, sticking] = columns.bands(&traces(&[(1, 2), (6, 2), (2, 1)]));
        assert_eq!((chatter, sticking), (vec![[4.25, 3.25]], vec![]));
    }
}
