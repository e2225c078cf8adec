//! What the impacts of trajectories side by side came to.

use super::along::is_normal;
use super::crossing::Crossing;
use super::striking::energy_taken;
use crate::model::vector::MOST;
use crate::model::{Flight, Lanes, Mask, Real};

/// Impacts from free flight to free flight, counted since they were last taken, and what has been summed up of them.
///
/// Nothing is added where nothing happened, rather than the old kept: what is stored where a mask holds takes some processors
/// ten times as long as what is stored everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Tally<L> {
    /// Impacts at the upper and the lower end of each normal.
    pub impacts: [[L; 2]; MOST],
    /// The largest |d·v−|.
    pub fastest: L,
    /// Σ ½ m ((d·v−)² − (d·v+)²) with m = 1/(dᵀM⁻¹d), where a tangent is carried along.
    pub energy: L,
    /// Moves since the last strobe: impacts, and those that were made one by one before.
    pub moves: L,
    /// Strobes passed unseen since impacts were last taken.
    pub strobes: L,
}

impl<L: Lanes> Tally<L> {
    /// Nothing in any lane.
    pub fn none(zero: L) -> Self {
        Tally { impacts: [[zero; 2]; MOST], fastest: zero, energy: zero, moves: zero, strobes: zero }
    }

    /// Counts the impacts of some lanes, and sums up what they take where that is observed.
    #[inline(always)]
    pub fn count<const N: usize>(
        &mut self,
        flight: &Flight<L, N>,
        struck: L::Mask,
        observed: L::Mask,
        met: &Crossing<L, N>,
    ) {
        let before = met.impact.velocity;
        let (zero, one) = (before.all(0.0), before.all(1.0));
        let mut mass = flight.normals[0].mass;
        for (k, [upper, lower]) in self.impacts.iter_mut().enumerate().take(met.after.count) {
            let own = is_normal(met.normal, k);
            let here = struck.and(own);
            *upper = *upper + L::select(here.and(met.upper), one, zero);
            *lower = *lower + L::select(here.and(met.upper.not()), one, zero);
            mass = L::select(own, flight.normals[k].mass, mass);
        }
        self.moves = self.moves + L::select(struck, one, zero);
        self.fastest = L::select(struck, before.magnitude(), zero).larger(self.fastest);
        let taken = energy_taken(mass, before, met.rebound);
        self.energy = self.energy + L::select(struck.and(observed), taken, zero);
    }

    /// Goes on in a lane from what was summed up before.
    #[inline(always)]
    pub fn begin(&mut self, lane: usize, fastest: L::Real, energy: L::Real, moves: L::Real) {
        self.fastest.renew_lane(lane, fastest);
        self.energy.renew_lane(lane, energy);
        self.moves.renew_lane(lane, moves);
    }

    /// What a lane came to; its impacts, moves and strobes are counted anew from here.
    #[inline(always)]
    pub fn take(&mut self, lane: usize, normals: usize) -> Tally<L::Real> {
        let zero = L::Real::of(0.0);
        let mut taken = Tally {
            impacts: [[zero; 2]; MOST],
            fastest: self.fastest.lane(lane),
            energy: self.energy.lane(lane),
            moves: self.moves.lane(lane),
            strobes: self.strobes.lane(lane),
        };
        self.moves.renew_lane(lane, zero);
        self.strobes.renew_lane(lane, zero);
        for (all, own) in self.impacts.iter_mut().zip(&mut taken.impacts).take(normals) {
            for (all, own) in all.iter_mut().zip(own) {
                *own = all.lane(lane);
                all.renew_lane(lane, zero);
            }
        }
        taken
    }
}
