//! One turn of a trajectory over N forcing periods, with its derivative.

use nalgebra::{DMatrix, DVector};

use super::flow::Flow;
use super::follower::Follower;
use crate::analysis::INFINITELY_MANY;
use crate::dynamics::{Event, Impact, Moves, Stop};

/// One turn of a trajectory over N forcing periods, with its derivative.
pub(super) struct Turn {
    pub end: DVector<f64>,
    /// The states at the forcing periods before the end.
    strobes: Vec<DVector<f64>>,
    pub jacobian: DMatrix<f64>,
    /// The state and its derivative half a turn from the start, for odd N.
    pub half: Option<(DVector<f64>, DMatrix<f64>)>,
    pub impacts: Vec<u16>,
    pub sticking: bool,
    pub peak: f64,
    pub hardest: Option<Hardest>,
}

/// The hardest impact of a turn.
pub(super) struct Hardest {
    pub stop: Stop,
    speed: f64,
    pub section: Vec<f64>,
}

impl Turn {
    /// Follows a trajectory; none if its state is not finite, or it makes too many moves.
    pub fn from(follower: &mut dyn Follower, flow: &Flow, start: &DVector<f64>, n: u32) -> Option<Self> {
        follower.begin(start.as_slice());
        follower.carry();
        let clamping = follower.clamping();
        let clamped = |(stop, _)| if clamping.contains(&stop) { INFINITELY_MANY } else { 0 };
        let mut turn = Turn {
            end: start.clone(),
            strobes: Vec::new(),
            jacobian: follower.tangents(),
            half: None,
            impacts: flow.faces().enumerate().map(clamped).collect(),
            sticking: !clamping.is_empty(),
            peak: 0.0,
            hardest: None,
        };
        let mut moves = Moves::default();
        for period in 0..n {
            moves.pass_period();
            turn.strobes.push(follower.state());
            loop {
                let taken = follower.advance_to_event();
                moves.add();
                if moves.are_too_many() || !follower.is_finite() {
                    return None;
                }
                turn.sticking |= !taken.contact.is_free();
                match taken.event {
                    Event::Impact(impact) => turn.note(follower, flow, &impact, false),
                    Event::Caught { impact, complete_chatter, beside } => {
                        turn.sticking = true;
                        if impact.velocity_before != 0.0 {
                            turn.note(follower, flow, &impact, complete_chatter);
                        }
                        for stop in follower.stops_of(beside) {
                            turn.impacts[stop.index()] = INFINITELY_MANY;
                        }
                    }
                    Event::HalfPeriod if n % 2 == 1 && period == n / 2 => {
                        turn.half = Some((follower.state(), follower.tangents()));
                    }
                    Event::Strobe => break,
                    _ => {}
                }
            }
        }
        turn.end = follower.state();
        turn.jacobian = follower.tangents();
        Some(turn)
    }

    /// The smallest divisor of n after which the state is the same already.
    pub fn shorter(&self, n: u32, tolerance: f64) -> Option<u32> {
        let same = |m: &u32| (&self.strobes[*m as usize] - &self.strobes[0]).amax() <= tolerance;
        (1..n).filter(|m| n.is_multiple_of(*m)).find(same)
    }

    /// Counts an impact, and keeps it if it is the hardest so far; those at an earlier stop count before all others.
    fn note(&mut self, follower: &dyn Follower, flow: &Flow, impact: &Impact<f64>, complete_chatter: bool) {
        let stop = impact.stop;
        let count = &mut self.impacts[stop.index()];
        if complete_chatter {
            *count = INFINITELY_MANY;
        } else if *count < INFINITELY_MANY - 1 {
            *count += 1;
        }
        self.peak = self.peak.max(impact.velocity_before.abs());
        let speed = impact.velocity_after.abs();
        let harder = self
            .hardest
            .as_ref()
            .is_none_or(|hardest| stop < hardest.stop || (stop == hardest.stop && speed > hardest.speed));
        if harder {
            let phase = follower.phase(flow.omega);
            let section = flow.face(stop).section(follower.x(), follower.v(), phase);
            let section = section.iter().map(|value| value + 0.0).collect();
            self.hardest = Some(Hardest { stop, speed, section });
        }
    }
}
