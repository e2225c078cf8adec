//! Where two branches of a diagram differ: motions that coexist.

use serde::Serialize;

use super::result::Diagram;
use crate::analysis::{Trace, Verdict};

/// How far the readings of two equal motions may be apart, as a share of the diagram's range.
const ALIKE: f64 = 2e-3;
/// How many columns in a row may agree within one range.
const GAP: usize = 1;

/// Two motions at the same parameters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Pair {
    /// What the first branch shows.
    pub first: String,
    /// What the second branch shows.
    pub second: String,
    /// In how many columns.
    pub columns: usize,
}

/// A range of the axis in which two branches differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coexistence {
    /// The least value at which they differ.
    pub from: f64,
    /// The largest.
    pub until: f64,
    /// Columns in which they differ.
    pub columns: usize,
    /// The motions, the most frequent pair first.
    pub pairs: Vec<Pair>,
}

impl Diagram {
    /// The ranges in which the falling and the rising branch differ, by rising values; none where there are not two.
    ///
    /// They differ where one is periodic, or without impact, and the other is not the same: another label or symmetry, or
    /// other readings, such as those of the mirror image. Aperiodic motions are not told apart from each other, and where
    /// a branch is unresolved nothing is said.
    pub fn coexistence(&self) -> Vec<Coexistence> {
        let [first, second] = &self.branches[..] else { return Vec::new() };
        let tolerance = ALIKE * self.range();
        let columns: Vec<(f64, &Trace, &Trace)> = {
            let mut columns: Vec<_> = (self.spec.x.values().into_iter())
                .zip(first.traces.iter().zip(&second.traces))
                .map(|(value, (a, b))| (value, a, b))
                .collect();
            columns.sort_by(|a, b| a.0.total_cmp(&b.0));
            columns
        };
        let mut ranges: Vec<(usize, Coexistence)> = Vec::new();
        for (i, (value, a, b)) in columns.into_iter().enumerate() {
            if !differ(a, b, tolerance) {
                continue;
            }
            match ranges.last_mut().filter(|(last, _)| i - *last <= GAP + 1) {
                Some((last, range)) => {
                    *last = i;
                    range.until = value;
                }
                None => {
                    let range = Coexistence { from: value, until: value, columns: 0, pairs: Vec::new() };
                    ranges.push((i, range));
                }
            }
            let (_, range) = ranges.last_mut().expect("a range was just found or begun");
            range.columns += 1;
            range.count(name(&a.verdict), name(&b.verdict));
        }
        let mut ranges: Vec<Coexistence> = ranges.into_iter().map(|(_, range)| range).collect();
        ranges.iter_mut().for_each(|range| range.pairs.sort_by_key(|pair| std::cmp::Reverse(pair.columns)));
        ranges
    }

    /// The range of all readings.
    fn range(&self) -> f64 {
        let readings =
            self.branches.iter().flat_map(|branch| &branch.traces).flat_map(|trace| &trace.readings);
        let (low, high) =
            readings.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
        (high - low).max(0.0)
    }
}

impl Coexistence {
    fn count(&mut self, first: String, second: String) {
        match self.pairs.iter_mut().find(|pair| pair.first == first && pair.second == second) {
            Some(pair) => pair.columns += 1,
            None => self.pairs.push(Pair { first, second, columns: 1 }),
        }
    }
}

/// The motion in words.
fn name(verdict: &Verdict) -> String {
    let symmetric = if verdict.symmetric { " symmetric" } else { "" };
    format!("{}{symmetric}", verdict.label())
}

fn differ(a: &Trace, b: &Trace, tolerance: f64) -> bool {
    use crate::analysis::Regime::{Failed, Inadmissible, NoImpact, Unresolved};
    let regular = |trace: &Trace| trace.verdict.regime.is_periodic() || trace.verdict.regime == NoImpact;
    let unknown = |trace: &Trace| matches!(trace.verdict.regime, Unresolved | Failed | Inadmissible);
    if unknown(a) || unknown(b) {
        return false;
    }
    match (regular(a), regular(b)) {
        (false, false) => false,
        (true, true) => name(&a.verdict) != name(&b.verdict) || apart(a, b) > tolerance,
        _ => true,
    }
}

/// How far the readings of either are from those of the other, at most.
fn apart(a: &Trace, b: &Trace) -> f64 {
    let sorted = |trace: &Trace| {
        let mut readings = trace.readings.clone();
        readings.sort_by(f64::total_cmp);
        readings
    };
    let (a, b) = (sorted(a), sorted(b));
    let farthest = |from: &[f64], to: &[f64]| from.iter().map(|&x| nearest(to, x)).fold(0.0, f64::max);
    if a.is_empty() && b.is_empty() { 0.0 } else { farthest(&a, &b).max(farthest(&b, &a)) }
}

/// The distance from a value to the nearest of sorted ones.
fn nearest(sorted: &[f64], value: f64) -> f64 {
    let at = sorted.partition_point(|&x| x < value);
    let around = [at.checked_sub(1), Some(at)].into_iter().flatten().filter_map(|i| sorted.get(i));
    around.map(|x| (x - value).abs()).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{Probe, Reading, Regime, Section};
    use crate::diagram::{Branch, DiagramSpec, Direction, Sweep};
    use crate::model::Parameters;
    use crate::plane::{Provenance, Start};

    fn trace(regime: Regime, n: u16, readings: &[f64]) -> Trace {
        let verdict = Verdict::of_motion(regime, [n; 3], n == 1);
        Trace { verdict, readings: readings.to_vec(), left_out: 0, rebounds: 0 }
    }

    fn diagram(down: Vec<Trace>, up: Vec<Trace>) -> Diagram {
        let branch = |direction, traces| Branch { direction, traces, spectrum: None };
        Diagram {
            spec: DiagramSpec {
                x: format!("omega=3:1:{}", down.len()).parse().unwrap(),
                parameters: Parameters::default().into(),
                sweep: Sweep::Both,
                start: Start::Rest,
                probe: Probe::new(Section::A, Reading::VBefore).unwrap(),
                schedule: DiagramSpec::schedule(10, 10, 4),
                capacity: 10,
                spectrum: None,
            },
            provenance: Provenance { version: "1".into(), backend: "cpu".into(), adapter: "none".into() },
            branches: vec![branch(Direction::Down, down), branch(Direction::Up, up)],
        }
    }

    #[test]
    fn ranges_say_which_motions_coexist() {
        let one = trace(Regime::Periodic, 1, &[0.4, 0.4]);
        let none = trace(Regime::NoImpact, 0, &[]);
        let chaos = trace(Regime::Chaotic, 0, &[0.1, 0.9]);
        let down = vec![one.clone(), one.clone(), none.clone(), chaos.clone(), chaos.clone()];
        let up = vec![one.clone(), none.clone(), one, chaos.clone(), trace(Regime::QuasiPeriodic, 0, &[0.5])];
        let found = diagram(down, up).coexistence();
        let pair =
            |first: &str, second: &str| Pair { first: first.into(), second: second.into(), columns: 1 };
        let pairs = vec![pair("no impact", "1-1-1 symmetric"), pair("1-1-1 symmetric", "no impact")];
        assert_eq!(found, [Coexistence { from: 2.0, until: 2.5, columns: 2, pairs }]);
    }

    #[test]
    fn mirror_images_differ_and_close_readings_do_not() {
        let of = |value: f64| trace(Regime::Periodic, 2, &[value, 1.0, 0.0]);
        assert_eq!(diagram(vec![of(0.5); 2], vec![of(0.501); 2]).coexistence(), []);
        assert_eq!(diagram(vec![of(0.5); 2], vec![of(0.51); 2]).coexistence().len(), 1);
        let unresolved = trace(Regime::Unresolved, 0, &[0.3]);
        assert_eq!(diagram(vec![of(0.5); 2], vec![unresolved; 2]).coexistence(), []);
    }
}
