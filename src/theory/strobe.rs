//! Periodic motions as fixed points of the strobe map: those that stick, and have no finite impact sequence, too.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Complex, ComplexField, DMatrix, DVector};

use super::flow::Flow;
use super::follower::{Follower, follower};
use super::label::spelled;
use super::motion::NoMotion;
use super::multipliers::{STABLE, multipliers};
use super::pattern::StopSet;
use super::turn::Turn;
use crate::analysis::{INFINITELY_MANY, Measures};
use crate::dynamics::{Event, Moves, Stop};
use crate::model::System;
use crate::system::Mooring;

/// The most Newton steps.
const MOST_STEPS: usize = 30;
/// Newton steps over half a turn from a motion that is almost symmetric.
const HALF_TURN_STEPS: usize = 4;
/// A step is halved at most so often.
const MOST_HALVINGS: usize = 10;
/// The largest residual of a solution, for states of order one: what closing complete chatter leaves uncertain.
const SOLVED: f64 = 1e-9;
/// The longest step from a solution, for states of order one, that is made whole or not at all, and is the last: a further one would
/// move the state by some 1e-11 at most.
const SHORT: f64 = 1e-10;
/// The largest distance from the mirror image of a motion that is called symmetric, for states of order one.
const MIRRORED: f64 = 1e-7;
/// The largest distance after a divisor of N, for states of order one, of a motion that has the divisor as its period.
const REPEATED: f64 = 1e-7;
/// The largest distance from its mirror image at which a motion may be a symmetric one that could not be told apart.
const BESIDE: f64 = 1e-4;

/// A periodic motion as a fixed point of Pᴺ, where P takes the state at forcing phase 0 to that one forcing period
/// later; everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct StrobeMotion {
    /// N, forcing periods in one period of the motion.
    pub n: u32,
    /// Impacts at each stop in one period, in the plant's order; [`INFINITELY_MANY`] with complete chatter.
    pub impacts: Vec<u16>,
    /// Whether x(t + Nπ/ω) = P x(t) with the mirror P of the system.
    pub symmetric: bool,
    /// How far it is from its mirror image half a turn later; none for even N and without a mirror.
    asymmetry: Option<f64>,
    /// Whether a mass rests on a stop on the way.
    pub sticking: bool,
    /// (x, v) at forcing phase 0.
    pub state: Vec<f64>,
    /// The largest |d·v−| of an impact.
    pub peak: f64,
    /// The impacts of one period but those of complete chatter that are closed.
    pub met: u32,
    /// What else is measured over one period.
    pub measures: Measures,
    /// The hardest impact of the period, at the first of the stops that are struck at all: the stop and the section just
    /// after it ((v1+, x2, v2, τ) of the paper's oscillator), its phase in [0, 2π). None where there is no impact, the
    /// masses being held by their stops.
    pub section: Option<(Stop, Vec<f64>)>,
    /// ∂Pᴺ/∂s at the fixed point, 2n × 2n; sticking makes two of its directions vanish.
    pub jacobian: DMatrix<f64>,
    /// The derivative of half of it and the mirror: the half map of a symmetric motion.
    half_jacobian: Option<DMatrix<f64>>,
    /// The largest component of Pᴺ(s) − s.
    pub residual: f64,
    among: StopSet,
    /// What holds the system where it may drift.
    mooring: Option<Arc<Mooring>>,
}

impl StrobeMotion {
    /// Whether it touches a stop at all.
    pub fn has_impacts(&self) -> bool {
        self.sticking || self.impacts.iter().any(|&count| count > 0)
    }

    /// The fixed point of Pᴺ near (x, v) at forcing phase 0, by Newton's method; N is reduced to the period of the motion
    /// where that is a divisor.
    ///
    /// # Errors
    /// [`NoMotion::NotConverged`] if there is none near by, or the trajectory cannot be followed; there is none of 0 periods.
    ///
    /// # Panics
    /// If the state has not 2n values.
    pub fn refine(system: &System, state: impl AsRef<[f64]>, n: u32) -> Result<Self, NoMotion> {
        if n == 0 {
            return Err(NoMotion::NotConverged);
        }
        let flow = Flow::new(system);
        let among = StopSet::of(system);
        let mut follower = follower(system);
        let mut state = DVector::from_column_slice(state.as_ref());
        let size = state.len();
        let mut turn = Turn::from(follower.as_mut(), &flow, &state, n).ok_or(NoMotion::NotConverged)?;
        for _ in 0..MOST_STEPS {
            let defect = &turn.end - &state;
            let scale = flow.unit() + state.amax();
            let Some(step) = step(&turn.jacobian, &defect, scale) else { break };
            let last = step.amax() <= SHORT * scale && defect.amax() <= SOLVED * scale;
            let better = (0..if last { 1 } else { MOST_HALVINGS }).find_map(|halvings| {
                let mut trial = &state - &step * 0.5f64.powi(halvings as i32);
                follower.bring_within(&mut trial.as_mut_slice()[..size / 2]);
                let next = Turn::from(follower.as_mut(), &flow, &trial, n)?;
                ((&next.end - &trial).norm() < defect.norm()).then_some((trial, next))
            });
            let Some(better) = better else { break };
            (state, turn) = better;
            if last {
                break;
            }
        }
        let residual = (&turn.end - &state).amax();
        let scale = flow.unit() + state.amax();
        if residual.is_nan() || residual > SOLVED * scale {
            return Err(NoMotion::NotConverged);
        }
        if let Some(shorter) = turn.shorter(n, REPEATED * scale) {
            return Self::refine(system, state.as_slice(), shorter);
        }
        let motion = Self::solved(&flow, among, n, &state, turn);
        let asymmetry = motion.asymmetry.filter(|_| !motion.symmetric);
        let beside = asymmetry.is_some_and(|asymmetry| asymmetry <= BESIDE * scale);
        let symmetric = beside.then(|| Self::symmetric_beside(follower.as_mut(), &flow, &motion));
        Ok(symmetric.flatten().filter(|motion| motion.is_stable() == Some(true)).unwrap_or(motion))
    }

    /// The motion of a turn that closes.
    fn solved(flow: &Flow, among: StopSet, n: u32, state: &DVector<f64>, turn: Turn) -> Self {
        let residual = (&turn.end - state).amax();
        let half = turn.half.filter(|_| among.has_mirror());
        let asymmetry = half.as_ref().map(|(half, _)| (half - flow.mirrored(state)).amax());
        let symmetric =
            asymmetry.is_some_and(|asymmetry| asymmetry <= MIRRORED * (flow.unit() + state.amax()));
        StrobeMotion {
            n,
            impacts: turn.impacts,
            symmetric,
            asymmetry,
            sticking: turn.sticking,
            state: state.iter().map(|value| value + 0.0).collect(),
            peak: turn.peak,
            met: turn.met,
            measures: turn.loss.measures(n, f64::from(n) * TAU / flow.omega),
            section: turn.hardest.map(|hardest| (hardest.stop, hardest.section)),
            jacobian: turn.jacobian,
            half_jacobian: half.filter(|_| symmetric).map(|(_, jacobian)| flow.mirrored_columns(&jacobian)),
            residual,
            among,
            mooring: flow.mooring.clone(),
        }
    }

    /// The symmetric motion beside one that is almost its own mirror image, by Newton's method on half a turn and the
    /// mirror.
    ///
    /// Beside a pitchfork the whole turn has a multiplier near 1, and leaves a symmetric motion a little off its mirror
    /// image. Half a turn has one near −1 there, and leaves no doubt. Of a symmetric and an unsymmetric motion so close
    /// one alone is stable.
    fn symmetric_beside(follower: &mut dyn Follower, flow: &Flow, motion: &Self) -> Option<Self> {
        let mut state = DVector::from_column_slice(&motion.state);
        let size = state.len();
        for _ in 0..HALF_TURN_STEPS {
            let (half, jacobian) = Turn::from(follower, flow, &state, motion.n)?.half?;
            let defect = flow.mirrored(&half) - &state;
            state -= step(&flow.mirrored_columns(&jacobian), &defect, flow.unit() + state.amax())?;
            follower.bring_within(&mut state.as_mut_slice()[..size / 2]);
        }
        let turn = Turn::from(follower, flow, &state, motion.n)?;
        let found = Self::solved(flow, motion.among.clone(), motion.n, &state, turn);
        (found.symmetric && found.residual <= SOLVED * (flow.unit() + state.amax())).then_some(found)
    }

    /// P^n of (x, v) at forcing phase 0; none if the trajectory cannot be followed.
    pub fn turned(system: &System, state: impl AsRef<[f64]>, n: u32) -> Option<Vec<f64>> {
        let mut follower = follower(system);
        follower.begin(state.as_ref());
        let mut moves = Moves::default();
        for _ in 0..n {
            moves.pass_period();
            while follower.next_event(&mut moves)?.event != Event::Strobe {}
        }
        Some(follower.state().as_slice().to_vec())
    }

    /// p: impacts at Ā, the paper's second stop, in one period; 0 where there is no second stop.
    pub fn p(&self) -> u16 {
        self.impacts.get(Stop::B.index()).copied().unwrap_or(0)
    }

    /// q: impacts at A, the first stop, in one period.
    pub fn q(&self) -> u16 {
        self.impacts[Stop::A.index()]
    }

    /// Impacts at each stop in one period, in the order of labels.
    pub fn counts(&self) -> Vec<u16> {
        self.among.in_label_order(&self.impacts)
    }

    /// N and the impacts at each stop (N-p-q of the paper's oscillator), with ∞ for infinitely many.
    pub fn label(&self) -> String {
        let number = |count: u16| match count {
            INFINITELY_MANY => "∞".to_owned(),
            count => count.to_string(),
        };
        spelled(self.n, self.counts().into_iter().map(number))
    }

    /// The Floquet multipliers, largest modulus first; 0 for a direction that sticking loses. None is of a drift.
    ///
    /// None where an impact grazes, since there is no derivative.
    pub fn multipliers(&self) -> Option<Vec<Complex<f64>>> {
        self.multipliers_of(&self.jacobian, f64::from(self.n))
    }

    /// Eigenvalues of the half map of a symmetric motion, largest modulus first: N/2 forcing periods, then the mirror.
    pub fn half_multipliers(&self) -> Option<Vec<Complex<f64>>> {
        self.multipliers_of(self.half_jacobian.as_ref()?, 0.5 * f64::from(self.n))
    }

    fn multipliers_of(&self, map: &DMatrix<f64>, periods: f64) -> Option<Vec<Complex<f64>>> {
        multipliers(finite(map)?, periods, self.mooring.as_deref())
    }

    /// The largest Lyapunov exponent per forcing period: that of the largest multiplier, −∞ where all are 0.
    pub fn exponent(&self) -> Option<f64> {
        Some(libm::log(self.multipliers()?[0].modulus()) / f64::from(self.n))
    }

    /// Whether all Floquet multipliers lie within the unit circle; none where there are none.
    pub fn is_stable(&self) -> Option<bool> {
        Some(self.multipliers()?.iter().all(|value| value.modulus() < STABLE))
    }
}

/// The step of Newton's method to the fixed point of a map, from the map's Jacobian and what it adds to the state. None where it leads
/// to nothing near by, however often it is halved: where a motion may drift, no fixed point is alone.
fn step(jacobian: &DMatrix<f64>, defect: &DVector<f64>, scale: f64) -> Option<DVector<f64>> {
    let size = defect.len();
    let step = (jacobian - DMatrix::identity(size, size)).lu().solve(defect)?;
    (step.amax() <= scale * 2f64.powi(MOST_HALVINGS as i32)).then_some(step)
}

fn finite(matrix: &DMatrix<f64>) -> Option<&DMatrix<f64>> {
    matrix.iter().all(|value| value.is_finite()).then_some(matrix)
}
