//! Which motions a diagram shows along the top, their paints, and the key to them.

use std::cmp::Reverse;
use std::collections::HashMap;

use crate::analysis::Verdict;
use crate::diagram::Diagram;
use crate::figure::{KeyEntry, Sample};
use crate::render::colouring::Colouring;
use crate::render::colours::SHARED;
use crate::render::motion::Motion;

/// Periodic motions that get an entry of their own: so many at most, each in at least this share of the columns unless
/// there are few.
const MOST: usize = 12;
const RARE: f64 = 0.002;
const FEW: usize = 6;

/// The motions of a diagram, those of most columns first.
pub(super) struct Motions {
    /// Those with an entry of their own, and a verdict that has the name.
    named: Vec<(Motion, Verdict)>,
    /// Whether there is a mirror, so that motions may be unsymmetric.
    mirrored: bool,
    /// How many others there are.
    others: usize,
    /// What they are filled with.
    pub paints: Colouring,
}

impl Motions {
    /// The motions of all branches.
    pub fn of(diagram: &Diagram) -> Self {
        let mut columns: HashMap<Motion, (usize, Verdict)> = HashMap::new();
        let traces = diagram.branches.iter().flat_map(|branch| &branch.traces);
        for trace in traces {
            columns.entry(Motion::of(&trace.verdict)).or_insert((0, trace.verdict)).0 += 1;
        }
        let all: usize = columns.values().map(|(count, _)| count).sum();
        let mut order: Vec<(Motion, (usize, Verdict))> = columns.into_iter().collect();
        order.sort_by_key(|&(motion, (count, _))| (Reverse(count), motion));
        let mut periodic = 0;
        let matters = |(motion, (count, _)): &&(Motion, (usize, Verdict))| {
            let listed = periodic < FEW || periodic < MOST && *count as f64 >= RARE * all as f64;
            periodic += usize::from(motion.regime.is_periodic() && listed);
            listed || !motion.regime.is_periodic()
        };
        let candidates: Vec<(Motion, Verdict)> =
            order.iter().filter(matters).map(|&(motion, (_, verdict))| (motion, verdict)).collect();
        let paints = Colouring::of(candidates.iter().map(|&(motion, _)| motion));
        let named: Vec<_> =
            candidates.into_iter().filter(|&(motion, _)| paints.own(motion).is_some()).collect();
        Motions { others: order.len() - named.len(), mirrored: diagram.has_mirror(), named, paints }
    }

    /// What the paints stand for.
    pub fn key(&self) -> Vec<KeyEntry> {
        let entry = |paint, name: String| KeyEntry { sample: Sample::Fill(paint), name: name.into() };
        let named = self.named.iter();
        let mut key: Vec<KeyEntry> = named
            .map(|(motion, verdict)| entry(self.paints.paint(*motion), Motion::name(verdict, self.mirrored)))
            .collect();
        if self.others > 0 {
            let plural = if self.others == 1 { "" } else { "s" };
            key.push(entry(SHARED, format!("other periodic ({} motion{plural})", self.others)));
        }
        key
    }
}
