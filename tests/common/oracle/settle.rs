//! Motion labels by brute force: follow the trajectory until its strobe states repeat.

use super::follow::{Follower, Period};
use super::plant::Plant;

/// The largest N that is looked for.
pub const LONGEST_PERIOD: usize = 32;

/// Strobe states that are the same, per component.
const SAME: f64 = 1e-10;

/// Repetition is demanded over this many forcing periods.
const WINDOW: usize = 3 * LONGEST_PERIOD;

/// The impacts at one stop in one period of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// That many.
    Finite(u32),
    /// Complete chatter.
    Infinite,
}

/// A periodic motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motion {
    /// Forcing periods in one period of the motion.
    pub n: u32,
    /// Impacts at Ā.
    pub p: Count,
    /// Impacts at A.
    pub q: Count,
    /// Whether x(t + Nπ/ω) = −x(t).
    pub symmetric: bool,
    /// Whether M1 rests on a stop for part of it.
    pub sticks: bool,
}

/// A settled trajectory.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The motion it settled on.
    pub motion: Motion,
    /// A strobe state of the motion.
    pub strobe: [f64; 4],
    /// Forcing periods until the repetition was seen.
    pub periods: usize,
}

/// Follows a trajectory for at most `budget` forcing periods; `None` where it does not repeat by then.
pub fn settle(plant: Plant, start: [f64; 4], budget: usize) -> Option<Settled> {
    let mut follower = Follower::<f64>::new(plant, start);
    let mut history: Vec<Period> = Vec::new();
    for periods in 1..=budget {
        history.push(follower.next_period());
        if periods % WINDOW != 0 {
            continue;
        }
        history.drain(..history.len().saturating_sub(WINDOW + LONGEST_PERIOD));
        if let Some(n) = (1..=LONGEST_PERIOD).find(|&n| repeats(&history, n)) {
            let symmetric = n % 2 == 1 && is_symmetric(&mut follower, n);
            let strobe = history[history.len() - 1].strobe;
            let motion = motion(&history[history.len() - n..], symmetric);
            return Some(Settled { motion, strobe, periods });
        }
    }
    None
}

fn repeats(history: &[Period], n: usize) -> bool {
    let first = history.len().saturating_sub(WINDOW);
    first >= LONGEST_PERIOD
        && (first..history.len()).all(|i| {
            let (now, then) = (&history[i], &history[i - n]);
            (now.chatters != [0, 0] || now.counts() == then.counts())
                && now.chatters == then.chatters
                && now.strobe.iter().zip(then.strobe).all(|(a, b)| (a - b).abs() < SAME * (1.0 + b.abs()))
        })
}

/// Whether half a period of the motion later the state is the negative one.
fn is_symmetric(follower: &mut Follower<f64>, n: usize) -> bool {
    let start = follower.position();
    for _ in 0..n / 2 {
        follower.next_period();
    }
    follower.advance(0.5 * follower.period());
    start.iter().zip(follower.position()).all(|(a, b)| (a + b).abs() < 1e-6 * (1.0 + a.abs()))
}

fn motion(periods: &[Period], symmetric: bool) -> Motion {
    let count = |side: usize| {
        if periods.iter().any(|period| period.chatters[side] > 0) {
            Count::Infinite
        } else {
            Count::Finite(periods.iter().map(|period| period.counts()[side]).sum())
        }
    };
    Motion {
        n: periods.len() as u32,
        p: count(0),
        q: count(1),
        symmetric,
        sticks: periods.iter().any(|period| !period.sticks.is_empty()),
    }
}
