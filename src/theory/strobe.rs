//! Periodic motions as fixed points of the strobe map: those that stick, and have no finite impact sequence, too.

use nalgebra::{Complex, Matrix4, Vector4};

use super::motion::NoMotion;
use super::multipliers::{STABLE, eigenvalues};
use crate::analysis::{INFINITELY_MANY, motion_label};
use crate::dynamics::{Contact, Event, Stop, Tangent, Trajectory, Variation};
use crate::model::{Flight, System};

/// The most Newton steps.
const MOST_STEPS: usize = 30;
/// A step is halved at most so often.
const MOST_HALVINGS: usize = 10;
/// The largest residual of a solution, for states of order one: what closing complete chatter leaves uncertain.
const SOLVED: f64 = 1e-9;
/// The largest distance from the mirror image of a motion that is called symmetric, for states of order one.
const MIRRORED: f64 = 1e-7;
/// The largest distance after a divisor of N, for states of order one, of a motion that has the divisor as its period.
const REPEATED: f64 = 1e-7;
/// Moves beyond which a trajectory is given up, per forcing period.
const MOST_MOVES: u32 = 1 << 24;

/// A periodic motion as a fixed point of Pᴺ, where P takes the state at forcing phase 0 to that one forcing period
/// later; everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct StrobeMotion {
    /// N, forcing periods in one period of the motion.
    pub n: u32,
    /// p, impacts at Ā in one period; [`INFINITELY_MANY`] with complete chatter.
    pub p: u16,
    /// q, impacts at A in one period; [`INFINITELY_MANY`] with complete chatter.
    pub q: u16,
    /// Whether x(t + Nπ/ω) = −x(t).
    pub symmetric: bool,
    /// Whether the first mass rests on a stop on the way.
    pub sticking: bool,
    /// (x1, x2, v1, v2) at forcing phase 0.
    pub state: [f64; 4],
    /// The largest |v1−| of an impact.
    pub peak: f64,
    /// The hardest impact of the period, at A if that is struck at all: the stop and (v1+, x2, v2, τ) just after it,
    /// 0 ≤ τ < 2π. None where there is no impact, the first mass being held by its stops.
    pub section: Option<(Stop, [f64; 4])>,
    /// ∂Pᴺ/∂s at the fixed point; sticking makes two of its directions vanish.
    pub jacobian: Matrix4<f64>,
    /// Minus the derivative of half of it: the half map of a symmetric motion.
    half_jacobian: Option<Matrix4<f64>>,
    /// The largest component of Pᴺ(s) − s.
    pub residual: f64,
}

impl StrobeMotion {
    /// Whether it touches a stop at all.
    pub fn has_impacts(&self) -> bool {
        self.sticking || self.p > 0 || self.q > 0
    }

    /// The fixed point of Pᴺ near a state at forcing phase 0, by Newton's method; N is reduced to the period of the motion
    /// where that is a divisor.
    ///
    /// # Errors
    /// [`NoMotion::NotConverged`] if there is none near by, or the trajectory cannot be followed.
    pub fn refine(system: &System, state: [f64; 4], n: u32) -> Result<Self, NoMotion> {
        let flight = Flight::new(system);
        let mut state = Vector4::from(state);
        let mut turn = Turn::from(&flight, state.into(), n).ok_or(NoMotion::NotConverged)?;
        for _ in 0..MOST_STEPS {
            let defect = turn.end - state;
            let step = (turn.jacobian - Matrix4::identity()).lu().solve(&defect);
            let better = step.and_then(|step| {
                (0..MOST_HALVINGS).find_map(|halvings| {
                    let trial = state - step * 0.5f64.powi(halvings as i32);
                    let trial = Vector4::from(system.between_stops(trial.into()));
                    let next = Turn::from(&flight, trial.into(), n)?;
                    ((next.end - trial).norm() < defect.norm()).then_some((trial, next))
                })
            });
            match better {
                Some(better) => (state, turn) = better,
                None => break,
            }
        }
        let residual = (turn.end - state).amax();
        let scale = 1.0 + state.amax();
        if residual.is_nan() || residual > SOLVED * scale {
            return Err(NoMotion::NotConverged);
        }
        if let Some(shorter) = turn.shorter(n, REPEATED * scale) {
            return Self::refine(system, state.into(), shorter);
        }
        let symmetric = turn.half.is_some_and(|(half, _)| (half + state).amax() <= MIRRORED * scale);
        Ok(StrobeMotion {
            n,
            p: turn.p,
            q: turn.q,
            symmetric,
            sticking: turn.sticking,
            state: state.map(|value| value + 0.0).into(),
            peak: turn.peak,
            section: turn.hardest,
            jacobian: turn.jacobian,
            half_jacobian: turn.half.filter(|_| symmetric).map(|(_, jacobian)| -jacobian),
            residual,
        })
    }

    /// P^n of a state at forcing phase 0; none if the trajectory cannot be followed.
    pub fn turned(system: &System, state: [f64; 4], n: u32) -> Option<[f64; 4]> {
        Turn::from(&Flight::new(system), state, n).map(|turn| turn.end.into())
    }

    /// N-p-q, with ∞ for infinitely many impacts.
    pub fn label(&self) -> String {
        motion_label(self.n, self.p, self.q)
    }

    /// The Floquet multipliers, largest modulus first; 0 for a direction that sticking loses.
    ///
    /// None where an impact grazes, since there is no derivative.
    pub fn multipliers(&self) -> Option<[Complex<f64>; 4]> {
        finite(&self.jacobian).and_then(eigenvalues)
    }

    /// Eigenvalues of the half map of a symmetric motion, largest modulus first: N/2 forcing periods, then the mirror.
    pub fn half_multipliers(&self) -> Option<[Complex<f64>; 4]> {
        self.half_jacobian.as_ref().and_then(finite).and_then(eigenvalues)
    }

    /// The largest Lyapunov exponent per forcing period: that of the largest multiplier, −∞ where all are 0.
    pub fn exponent(&self) -> Option<f64> {
        Some(self.multipliers()?[0].norm().ln() / f64::from(self.n))
    }

    /// Whether all Floquet multipliers lie within the unit circle; none where there are none.
    pub fn is_stable(&self) -> Option<bool> {
        Some(self.multipliers()?.iter().all(|value| value.norm() < STABLE))
    }
}

fn finite(matrix: &Matrix4<f64>) -> Option<&Matrix4<f64>> {
    matrix.iter().all(|value| value.is_finite()).then_some(matrix)
}

/// One turn of a trajectory over N forcing periods, with its derivative.
struct Turn {
    end: Vector4<f64>,
    /// The states at the forcing periods before the end.
    strobes: Vec<Vector4<f64>>,
    jacobian: Matrix4<f64>,
    /// The state and its derivative half a turn from the start, for odd N.
    half: Option<(Vector4<f64>, Matrix4<f64>)>,
    p: u16,
    q: u16,
    sticking: bool,
    peak: f64,
    hardest: Option<(Stop, [f64; 4])>,
}

impl Turn {
    /// Follows a trajectory; none if its state is not finite, or it makes too many moves.
    fn from(flight: &Flight<f64>, start: [f64; 4], n: u32) -> Option<Self> {
        let mut trajectory = Trajectory::new(flight, start);
        let mut frame = unit_frame();
        let clamped = trajectory.contact == Contact::Clamped;
        if clamped {
            frame = frame.caught();
        }
        let mut turn = Turn {
            end: Vector4::from(start),
            strobes: Vec::new(),
            jacobian: Matrix4::identity(),
            half: None,
            p: if clamped { INFINITELY_MANY } else { 0 },
            q: if clamped { INFINITELY_MANY } else { 0 },
            sticking: clamped,
            peak: 0.0,
            hardest: None,
        };
        for period in 0..n {
            let mut moves = 0;
            turn.strobes.push(trajectory.point.state().into());
            loop {
                let taken = trajectory.advance_to_event(flight, &mut frame);
                moves += 1;
                if moves > MOST_MOVES || !trajectory.point.state().iter().all(|value| value.is_finite()) {
                    return None;
                }
                turn.sticking |= taken.free == 0.0;
                match taken.event {
                    Event::Impact(impact) => {
                        turn.count(impact.stop, false);
                        turn.harden(flight, &trajectory, impact.stop, impact.velocity_after);
                        turn.peak = turn.peak.max(impact.velocity_before.abs());
                    }
                    Event::Caught { impact, complete_chatter } => {
                        turn.sticking = true;
                        if impact.velocity_before != 0.0 {
                            turn.count(impact.stop, complete_chatter);
                            turn.harden(flight, &trajectory, impact.stop, impact.velocity_after);
                            turn.peak = turn.peak.max(impact.velocity_before.abs());
                        }
                    }
                    Event::HalfPeriod if n % 2 == 1 && period == n / 2 => {
                        turn.half = Some((trajectory.point.state().into(), columns(&frame)));
                    }
                    Event::Strobe => break,
                    _ => {}
                }
            }
        }
        turn.end = trajectory.point.state().into();
        turn.jacobian = columns(&frame);
        Some(turn)
    }

    /// The smallest divisor of n after which the state is the same already.
    fn shorter(&self, n: u32, tolerance: f64) -> Option<u32> {
        let same = |m: &u32| (self.strobes[*m as usize] - self.strobes[0]).amax() <= tolerance;
        (1..n).filter(|m| n.is_multiple_of(*m)).find(same)
    }

    fn count(&mut self, stop: Stop, complete_chatter: bool) {
        let count = match stop {
            Stop::A => &mut self.q,
            Stop::B => &mut self.p,
        };
        *count = if complete_chatter {
            INFINITELY_MANY
        } else if *count < INFINITELY_MANY - 1 {
            *count + 1
        } else {
            *count
        };
    }

    /// Keeps an impact if it is the hardest so far; those at A count before all others.
    fn harden(&mut self, flight: &Flight<f64>, trajectory: &Trajectory<f64>, stop: Stop, velocity: f64) {
        let before = match &self.hardest {
            Some((Stop::A, _)) if stop == Stop::B => return,
            Some((other, section)) if *other == stop => section[0].abs(),
            _ => -1.0,
        };
        if velocity.abs() > before {
            let elapsed = f64::from(trajectory.step) * flight.h + trajectory.offset;
            let phase = super::admissible::wrapped(flight.omega * elapsed);
            let point = trajectory.point;
            self.hardest = Some((stop, [velocity + 0.0, point.x2, point.v2, phase]));
        }
    }
}

/// The unit vectors of (x1, x2, v1, v2).
fn unit_frame() -> [Tangent<f64>; 4] {
    std::array::from_fn(|j| {
        let at = |i: usize| if i == j { 1.0 } else { 0.0 };
        Tangent { x1: at(0), x2: at(1), v1: at(2), v2: at(3) }
    })
}

/// The matrix whose columns are the tangent vectors.
fn columns(frame: &[Tangent<f64>; 4]) -> Matrix4<f64> {
    Matrix4::from_columns(&frame.map(|t| Vector4::new(t.x1, t.x2, t.v1, t.v2)))
}
