//! The motions that a map shows and that have no curve.

use strum::VariantArray;

use super::branch::{Event, Followed};
use super::curve::CurveMotion;
use super::regions::Shown;
use super::seeds::MOST_IMPACTS;

/// A periodic motion that a map shows and that no computed curve bounds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Which motion; of a motion and its mirror image that of which there are more cells.
    pub motion: CurveMotion,
    /// How many cells show it or its mirror image.
    pub cells: usize,
    /// Why it has no curve.
    pub why: Why,
}

/// Why a motion has no curve, in the order in which it is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, VariantArray)]
pub enum Why {
    /// Nothing that ends it was met within the plane, or not before it was given up.
    Unbounded,
    /// No cell's trajectory leads Newton's method to it.
    Unsolved,
    /// Too few cells show it.
    Few,
    /// It has more impacts than are followed.
    ManyImpacts,
    /// It rests on a stop, or its rebounds accumulate: it has no finite sequence of impacts.
    Sticks,
    /// Its N is larger than was asked for.
    LongPeriod,
}

impl Why {
    /// Why, in words.
    pub fn words(self) -> String {
        match self {
            Why::Unbounded => {
                "nothing that ends them was met on this plane, or not in so many steps".to_owned()
            }
            Why::Unsolved => "no cell leads Newton's method to them".to_owned(),
            Why::Few => "too few cells show them".to_owned(),
            Why::ManyImpacts => format!("more than {MOST_IMPACTS} impacts in a period"),
            Why::Sticks => "sticking".to_owned(),
            Why::LongPeriod => "N above the largest that was asked for".to_owned(),
        }
    }

    /// Why a motion is not even looked for, if it is not.
    pub(super) fn not_sought(shown: &Shown, max_period: u32, fewest: usize) -> Option<Why> {
        let CurveMotion { n, .. } = shown.motion;
        let reasons = [
            (Why::LongPeriod, n > max_period),
            (Why::Sticks, shown.sticks),
            (Why::ManyImpacts, shown.motion.count() > MOST_IMPACTS),
            (Why::Few, shown.cells() < fewest),
        ];
        reasons.into_iter().find_map(|(why, holds)| holds.then_some(why))
    }
}

impl LeftOut {
    /// The motion's label, with ∞ for infinitely many impacts, and the symmetry where it could be either.
    pub fn name(&self) -> String {
        let symmetry = match (self.motion.could_be_symmetric(), self.motion.symmetric) {
            (true, true) => " symmetric",
            (true, false) => " unsymmetric",
            (false, _) => "",
        };
        format!("{}{symmetry}", self.motion.label())
    }
}

/// Those of the motions that a map shows for which nothing was found that bounds them.
pub(super) fn left_out(
    shown: &[Shown],
    sought: &[Result<Followed, Why>],
    bounds: impl Fn(&Event) -> bool,
) -> Vec<LeftOut> {
    let mut found: Vec<LeftOut> = shown
        .iter()
        .zip(sought)
        .filter_map(|(shown, sought)| {
            let why = match sought {
                Err(why) => *why,
                Ok(met) if !met.events.iter().chain(&met.births).any(&bounds) => Why::Unbounded,
                Ok(_) => return None,
            };
            Some(LeftOut { motion: shown.motion.clone(), cells: shown.cells(), why })
        })
        .collect();
    found.sort_by_key(|motion| std::cmp::Reverse(motion.cells));
    found
}
