//! Motion labels by brute force: follow the trajectory until its strobe states repeat.

use super::follow::{Follower, Period};

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
    /// The strobe states of one period of the motion.
    pub strobes: Vec<[f64; 4]>,
    /// The smallest distance between two of its strobe states; infinite where there is one.
    pub separation: f64,
    /// The distance of x(t + Nπ/ω) from −x(t) for odd N; infinite for even N.
    pub asymmetry: f64,
    /// The strobe states from the first one to the last one looked at.
    pub path: Vec<[f64; 4]>,
}

/// Follows a trajectory for at most `budget` forcing periods; `None` where it does not repeat by then.
pub fn settle(mut follower: Follower<f64>, budget: usize) -> Option<Settled> {
    let mut history: Vec<Period> = Vec::new();
    let mut path = Vec::new();
    for periods in 1..=budget {
        history.push(follower.next_period());
        path.push(history[history.len() - 1].strobe);
        if follower.is_exhausted() {
            return None;
        }
        if periods % WINDOW != 0 {
            continue;
        }
        history.drain(..history.len().saturating_sub(WINDOW + LONGEST_PERIOD));
        if let Some(n) = (1..=LONGEST_PERIOD).find(|&n| repeats(&history, n)) {
            return Some(describe(&history[history.len() - n..], follower, path));
        }
    }
    None
}

/// What one period of a motion is like.
fn describe(periods: &[Period], follower: Follower<f64>, path: Vec<[f64; 4]>) -> Settled {
    let strobes: Vec<[f64; 4]> = periods.iter().map(|period| period.strobe).collect();
    let pairs = (0..strobes.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let separation = pairs.map(|(i, j)| distance(&strobes[i], &strobes[j])).fold(f64::INFINITY, f64::min);
    let asymmetry = if strobes.len() % 2 == 1 { asymmetry(follower, strobes.len()) } else { f64::INFINITY };
    Settled { motion: motion(periods, asymmetry < 1e-6), strobes, separation, asymmetry, path }
}

fn distance(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
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

/// How far the state half a period of the motion later is from the negative one.
fn asymmetry(mut follower: Follower<f64>, n: usize) -> f64 {
    let start = follower.position();
    for _ in 0..n / 2 {
        follower.next_period();
    }
    follower.advance(0.5 * follower.period());
    distance(&start, &follower.position().map(|x| -x))
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
